#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/draw/arm_scene.h>
#include <beeline/draw/skeleton.h>
#include <beeline/draw/text.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/pose/angle.h>
#include <beeline/pose/se2.h>

namespace beeline {
namespace {

constexpr double link_width = 8;
constexpr double symbol_step = 13;  // how far symbols of one place are set apart

/// Sizes shrink where there are many joints.
double size_for(std::size_t joints) {
  return std::clamp(std::sqrt(10.0 / static_cast<double>(joints)), 0.15, 1.0);
}

double span(const Skeleton& bones) {
  double farthest = 0;
  for (const Vector3& p : bones.line()) farthest = std::max(farthest, (p - bones.base).norm());
  return farthest;
}

/// Joints whose axes meet in one place (a shoulder, a wrist) are shown side by side: the first is
/// moved back along its axis, towards the base, or the last one forward.
std::vector<double> symbol_shifts(const Skeleton& bones) {
  std::vector<double> shifts(bones.joints.size(), 0);
  const double same = 1e-6 * span(bones) + 1e-300;
  for (std::size_t first = 0; first < bones.joints.size();) {
    std::size_t last = first;
    while (last + 1 < bones.joints.size() &&
           (bones.joints[last + 1].centre - bones.joints[first].centre).norm() <= same) {
      ++last;
    }
    const std::size_t count = last - first + 1;
    const bool at_base = (bones.joints[first].centre - bones.base).norm() <= same;
    if (count > 2 || (count == 2 && at_base)) shifts[first] = -symbol_step;
    if (count > 2 || (count == 2 && !at_base)) {
      const SkeletonJoint& joint = bones.joints[last];
      const double way = joint.direction.dot(joint.leave - joint.enter);
      shifts[last] = way < 0 ? -symbol_step : symbol_step;
    }
    first = last + 1;
  }
  return shifts;
}

class ArmPainter {
 public:
  ArmPainter(Scene& scene, const Skeleton& bones, bool planar, bool is_faded)
      : scene_(scene),
        bones_(bones),
        planar_(planar),
        size_(size_for(bones.joints.size())),
        layer_(is_faded ? Layer::ghost : Layer::body),
        steel_(is_faded ? faded(steel) : steel),
        ink_(is_faded ? faded(ink) : ink) {}

  void draw(const Vector3& up) {
    const std::vector<double> shifts = symbol_shifts(bones_);
    if (!planar_ && layer_ == Layer::body) shadow();
    const bool joint_at_base =
        (bones_.joints.front().centre - bones_.base).norm() <= 1e-6 * span(bones_);
    const double plate = joint_at_base && !planar_ ? size_ * (std::min(shifts[0], 0.0) - 6) : 0;
    scene_.add(layer_ == Layer::body ? Layer::ground : layer_,
               BaseSymbol{bones_.base, up, planar_, plate, size_, ink_});
    links();
    for (std::size_t i = 0; i < bones_.joints.size(); ++i) {
      const SkeletonJoint& joint = bones_.joints[i];
      scene_.add(layer_, JointSymbol{joint.kind, joint.centre, joint.direction, size_ * shifts[i],
                                     size_ * 6.5, paper_white, ink_});
    }
  }

 private:
  void bar(std::vector<Vector3> points, double width) {
    scene_.add(layer_, Polyline{std::move(points), steel_, size_ * width, {}, size_ * 1.1, ink_});
  }

  void links() {
    std::vector<Vector3> points{bones_.base};
    for (const SkeletonJoint& joint : bones_.joints) {
      points.push_back(joint.enter);
      if (joint.kind != JointKind::prismatic) points.push_back(joint.centre);
      bar(points, link_width);
      points = {joint.leave};
      if (joint.kind == JointKind::prismatic) {
        bar({joint.enter, joint.leave}, link_width / 2);
      } else {
        points.insert(points.begin(), joint.centre);
      }
    }
    points.push_back(bones_.tool);
    bar(points, link_width);
  }

  void shadow() {
    if (!scene_.floor) return;
    Polyline line{bones_.line(), {0.90, 0.91, 0.92}, size_ * link_width};
    for (Vector3& p : line.points) p.z() = *scene_.floor;
    scene_.add(Layer::ground, line);
  }

  Scene& scene_;
  const Skeleton& bones_;
  bool planar_;
  double size_;
  Layer layer_;
  Colour steel_, ink_;
};

void add_frames(Scene& scene, const std::vector<Pose>& links, bool planar) {
  for (std::size_t i = 0; i < links.size(); ++i) {
    scene.add(Layer::mark, FrameTriad{links[i], planar ? 30.0 : 22.0});
    Label label{links[i].translation(), "{" + std::to_string(i) + "}"};
    label.right = 0.3;
    label.up = -1;
    scene.add(Layer::note, label);
  }
}

}  // namespace

void add_arm(Scene& scene, const Arm& arm, const ConfigurationRef& q, const ArmStyle& style) {
  const Skeleton bones = skeleton(arm, q);
  const std::vector<Pose> links = link_poses(arm, q);
  if (!arm.planar() && !scene.floor) scene.floor = bones.base.z();
  ArmPainter(scene, bones, arm.planar(), style.faded).draw(arm.base().linear().col(2));
  if (style.frames) add_frames(scene, links, arm.planar());
  if (style.tool && !style.faded) scene.add(Layer::mark, FrameTriad{links.back() * arm.tool()});
}

void add_trail(Scene& scene, const std::vector<Vector3>& points, std::size_t most_dots) {
  if (points.empty()) return;
  const std::size_t gaps = std::max<std::size_t>(most_dots, 2) - 1;
  const std::size_t stride = std::max<std::size_t>(1, (points.size() - 1 + gaps - 1) / gaps);
  Polyline line{{}, amber, 0.8};
  Dots dots{{}, amber, 3};
  for (std::size_t i = 0; i < points.size(); i += stride) {
    dots.points.push_back(points[i]);
    line.points.push_back(points[i]);
    const std::size_t end = std::min(i + stride, points.size() - 1);
    const auto away = [&](const Vector3& p) {
      const Vector3 chord = points[end] - points[i];
      const double t = chord.isZero(0) ? 0 : chord.dot(p - points[i]) / chord.squaredNorm();
      return (p - points[i] - std::clamp(t, 0.0, 1.0) * chord).squaredNorm();
    };
    const auto first = points.begin() + static_cast<std::ptrdiff_t>(i);
    const auto last = points.begin() + static_cast<std::ptrdiff_t>(end);
    const auto extreme = std::max_element(
        first, last, [&](const Vector3& a, const Vector3& b) { return away(a) < away(b); });
    if (extreme != last && extreme != first) line.points.push_back(*extreme);
  }
  if ((points.size() - 1) % stride != 0) {
    dots.points.push_back(points.back());
    line.points.push_back(points.back());
  }
  scene.add(Layer::trail, line);
  scene.add(Layer::trail, dots);
}

double jacobian_arrow_scale(const Arm& arm, const ConfigurationRef& q) {
  const double fastest = jacobian(arm, q).topRows<3>().colwise().norm().maxCoeff();
  const double size = span(skeleton(arm, q));
  return fastest > 1e-9 * size && size > 0 ? 0.4 * size / fastest : 1;
}

void add_jacobian_arrows(Scene& scene, const Arm& arm, const ConfigurationRef& q, double scale,
                         bool levers) {
  const Jacobian columns = jacobian(arm, q);
  const Skeleton bones = skeleton(arm, q);
  for (std::size_t i = 0; levers && i < bones.joints.size(); ++i) {
    if (bones.joints[i].kind == JointKind::prismatic) continue;
    const Colour colour = faded(distinct_colour(arm.drives()[i].coordinate));
    scene.add(Layer::mark, Polyline{{bones.joints[i].centre, bones.tool}, colour, 0.9, {4, 3}});
  }
  for (int k = 0; k < arm.dof(); ++k) {
    const Vector3 velocity = columns.col(k).head<3>();
    if (velocity.norm() < 1e-12) continue;
    Polyline arrow{{bones.tool, bones.tool + scale * velocity}, distinct_colour(k), 2.2};
    arrow.arrow = true;
    scene.add(Layer::mark, arrow);
  }
}

void add_poses(Scene& scene, const std::vector<Pose>& poses,
               const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vector3 at = poses[i].translation();
    scene.add(Layer::mark, Dots{{at}, amber, 9});
    scene.add(Layer::mark, Dots{{at}, paper_white, 6});
    scene.add(Layer::mark, FrameTriad{poses[i], 20});
    if (i >= names.size() || names[i].empty()) continue;
    scene.add(Layer::note, Label{at, names[i], amber});
  }
}

void add_joint_angles(Scene& scene, const Arm& arm, const ConfigurationRef& q, double radius) {
  const Skeleton bones = skeleton(arm, q);
  double before = to_plane(arm.base()).theta;
  for (std::size_t i = 0; i < bones.joints.size(); ++i) {
    const SkeletonJoint& joint = bones.joints[i];
    const Vector3 next = i + 1 < bones.joints.size() ? bones.joints[i + 1].centre : bones.tool;
    const Vector3 link = next - joint.centre;
    if (joint.kind != JointKind::revolute || link.isZero(0)) continue;
    const double after = std::atan2(link.y(), link.x());
    const double turn = angle_difference(after, before);
    const auto at = [&](double heading, double distance) {
      return Vector3(joint.centre + distance * Vector3(std::cos(heading), std::sin(heading), 0));
    };
    if (std::abs(turn) > std::numbers::pi / 180) {
      const Colour grey{0.45, 0.47, 0.5};
      scene.add(Layer::trail,
                Polyline{{joint.centre, at(before, 1.55 * radius)}, grey, 0.8, {3, 2.5}});
      Polyline arc{{}, ink, 1};
      constexpr int steps = 40;
      for (int k = 0; k <= steps; ++k) arc.points.push_back(at(before + turn * k / steps, radius));
      arc.arrow = true;
      scene.add(Layer::mark, arc);
      const double middle = before + turn / 2;
      scene.add(Layer::note, Label{at(middle, radius), "θ" + subscript(static_cast<int>(i) + 1),
                                   ink, 9.5, std::cos(middle), std::sin(middle)});
    }
    before = after;
  }
}

std::vector<Vector3> tool_positions(const Arm& arm, const std::vector<Configuration>& motion) {
  std::vector<Vector3> points;
  points.reserve(motion.size());
  for (const Configuration& q : motion) {
    points.push_back(forward_kinematics(arm, q).translation());
  }
  return points;
}

}  // namespace beeline
