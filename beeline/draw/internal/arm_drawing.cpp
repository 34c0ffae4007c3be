#include <algorithm>
#include <cmath>

#include <beeline/draw/arm_figure.h>
#include <beeline/draw/internal/arm_drawing.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {
namespace {

constexpr double link_width = 8;
constexpr double symbol_step = 13;  // points between the symbols of joints at one point

/// Returns a factor on symbol sizes that decreases with the number of joints.
double size_for(std::size_t joints) {
  return std::clamp(std::sqrt(10.0 / static_cast<double>(joints)), 0.15, 1.0);
}

/// Returns the shift of each joint symbol along its axis, in points. Joints whose axes meet in one
/// point (a shoulder, a wrist) are drawn side by side: the first moves back along its axis, towards
/// the base, or the last one forward.
std::vector<double> symbol_shifts(const Skeleton& bones) {
  std::vector<double> shifts(bones.joints.size(), 0);
  const double same = 1e-6 * bones.size() + 1e-300;
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
      const double along = joint.direction.dot(joint.leave - joint.enter);
      shifts[last] = along < -same ? -symbol_step : symbol_step;
    }
    first = last + 1;
  }
  return shifts;
}

class ArmPainter {
 public:
  ArmPainter(Drawing& drawing, const Skeleton& bones, bool planar, const ArmStyle& style)
      : drawing_(drawing),
        bones_(bones),
        planar_(planar),
        size_((style.thin ? 0.5 : 1) * size_for(bones.joints.size())),
        layer_(style.faded ? Layer::ghost : Layer::body),
        steel_(style.faded ? faded(steel) : steel),
        ink_(style.faded ? faded(ink) : ink) {}

  void draw(const Vector3& up) {
    const std::vector<double> shifts = symbol_shifts(bones_);
    if (!planar_ && layer_ == Layer::body) shadow();
    if (layer_ == Layer::body) foot(up, shifts.front());
    links();
    for (std::size_t i = 0; i < bones_.joints.size(); ++i) {
      const SkeletonJoint& joint = bones_.joints[i];
      drawing_.add(layer_, JointSymbol{joint.kind, joint.centre, joint.direction, size_ * shifts[i],
                                       size_ * 6.5, paper_white, ink_});
    }
  }

 private:
  void foot(const Vector3& up, double first_shift) {
    const Vector3& first = bones_.joints.front().centre;
    const bool below = !planar_ && (first - bones_.base).norm() <= 1e-6 * bones_.size();
    const double shift = below ? size_ * (std::min(first_shift, 0.0) - 6) : 0;
    drawing_.add(Layer::base, BaseSymbol{bones_.base, up, planar_, shift, size_, ink_});
  }

  bool has_length(const std::vector<Vector3>& points) const {
    const double same = 1e-6 * bones_.size();
    return std::any_of(points.begin(), points.end(),
                       [&](const Vector3& p) { return (p - points.front()).norm() > same; });
  }

  void bar(std::vector<Vector3> points, double width) {
    drawing_.add(layer_, Polyline{std::move(points), steel_, size_ * width, {}, size_ * 1.1, ink_});
  }

  void links() {
    std::vector<Vector3> points{bones_.base};
    for (const SkeletonJoint& joint : bones_.joints) {
      points.push_back(joint.enter);
      if (joint.kind != JointKind::prismatic) points.push_back(joint.centre);
      if (has_length(points)) bar(points, link_width);
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
    if (!drawing_.floor) return;
    Polyline line{bones_.line(), {0.90, 0.91, 0.92}, size_ * link_width};
    for (Vector3& p : line.points) p.z() = *drawing_.floor;
    drawing_.add(Layer::ground, line);
  }

  Drawing& drawing_;
  const Skeleton& bones_;
  bool planar_;
  double size_;
  Layer layer_;
  Colour steel_, ink_;
};

/// Adds the triad of each frame. If frames are at one place, each is drawn over the previous one,
/// shorter and thicker, and they have one label.
void add_frames(Drawing& drawing, const std::vector<Pose>& links, bool planar, double size) {
  constexpr std::size_t max_labels = 40;  // more labels cannot be read
  const double length = size_for(links.size()) * (planar ? 30 : 22), same = 1e-6 * size + 1e-300;
  std::vector<bool> drawn(links.size(), false);
  for (std::size_t first = 0; first < links.size(); ++first) {
    if (drawn[first]) continue;
    std::vector<std::size_t> here;
    for (std::size_t i = first; i < links.size(); ++i) {
      if ((links[i].translation() - links[first].translation()).norm() > same) continue;
      here.push_back(i);
      drawn[i] = true;
    }
    std::string text;
    for (std::size_t rank = 0; rank < here.size(); ++rank) {
      const double part = 1 - static_cast<double>(rank) / static_cast<double>(here.size());
      FrameTriad triad{links[here[rank]], length * (here.size() == 1 ? 1 : 0.35 + 0.95 * part)};
      triad.width *= 2 - part;
      drawing.add(Layer::mark, triad);
      text += (rank == 0 ? "{" : " {") + std::to_string(here[rank]) + "}";
    }
    if (links.size() > max_labels) continue;
    Label label{links[first].translation(), text};
    label.right = 0.3;
    label.up = -1;
    drawing.add(Layer::note, label);
  }
}

}  // namespace

void add_arm(Drawing& drawing, const Arm& arm, const ConfigurationRef& q, const ArmStyle& style) {
  const Skeleton bones = skeleton(arm, q);
  const std::vector<Pose> links = link_poses(arm, q);
  if (!arm.planar() && !drawing.floor) drawing.floor = bones.base.z();
  ArmPainter(drawing, bones, arm.planar(), style).draw(arm.base().linear().col(2));
  if (style.frames) add_frames(drawing, links, arm.planar(), bones.size());
  const bool named = style.frames && arm.tool().isApprox(Pose::Identity());
  if (style.tool && !style.faded && !named)
    drawing.add(Layer::mark, FrameTriad{links.back() * arm.tool()});
}

}  // namespace beeline::internal
