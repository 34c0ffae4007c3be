#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/draw/arm_figure.h>
#include <beeline/draw/internal/annotation.h>
#include <beeline/draw/internal/joint_charts.h>
#include <beeline/draw/internal/text.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/pose/se2.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {

double jacobian_arrow_scale(const Arm& arm, const ConfigurationRef& q) {
  const double fastest = jacobian(arm, q).topRows<3>().colwise().norm().maxCoeff();
  const double size = skeleton(arm, q).size();
  return fastest > 1e-9 * size && size > 0 ? 0.4 * size / fastest : 1;
}

void add_jacobian_arrows(Drawing& drawing, const Arm& arm, const ConfigurationRef& q, double scale,
                         bool levers) {
  const Jacobian columns = jacobian(arm, q);
  const Skeleton bones = skeleton(arm, q);
  for (std::size_t i = 0; levers && i < bones.joints.size(); ++i) {
    if (bones.joints[i].kind == JointKind::prismatic) continue;
    const Colour colour = distinct_colour(arm.couplings()[i].coordinate);
    drawing.add(Layer::mark, Polyline{{bones.joints[i].centre, bones.tool}, colour, 0.8, {4, 3}});
  }
  std::vector<int> order;
  for (int k = 0; k < arm.dof(); ++k) {
    if (columns.col(k).head<3>().norm() >= 1e-12) order.push_back(k);
  }
  const auto length = [&](int k) { return columns.col(k).head<3>().norm(); };
  // Long arrows come first; equal lengths keep the order of the joints, independent of rounding.
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return length(a) > length(b) * (1 + 1e-9); });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const int k = order[i];
    const Vector3 velocity = columns.col(k).head<3>();
    const auto over = std::count_if(order.begin() + static_cast<std::ptrdiff_t>(i) + 1, order.end(),
                                    [&](int other) {
                                      const Vector3 v = columns.col(other).head<3>();
                                      return v.dot(velocity) > 0.998 * v.norm() * velocity.norm();
                                    });
    // An arrow below others is wider, so that it shows beside them.
    Polyline arrow{{bones.tool, bones.tool + scale * velocity},
                   distinct_colour(k),
                   2.2 + 2.4 * static_cast<double>(over)};
    arrow.outline = 0.7;
    arrow.rim = paper_white;
    arrow.arrow = true;
    arrow.dashes = joint_curve("", k).dashes;
    drawing.add(Layer::mark, arrow);
    constexpr std::size_t max_labels = 8;  // more labels would overlap
    if (i >= max_labels) continue;
    drawing.add(Layer::note, Label{arrow.points.back(), "J" + subscript(k + 1), arrow.colour, 9,
                                   velocity.x(), velocity.y()});
  }
}

void add_joint_angles(Drawing& drawing, const Arm& arm, const ConfigurationRef& q, double radius) {
  const Skeleton bones = skeleton(arm, q);
  double before = to_plane(arm.base()).theta;
  for (std::size_t i = 0; i < bones.joints.size(); ++i) {
    const SkeletonJoint& joint = bones.joints[i];
    const Vector3 next = i + 1 < bones.joints.size() ? bones.joints[i + 1].centre : bones.tool;
    const Vector3 link = next - joint.centre;
    if (joint.kind != JointKind::revolute || link.isZero(0)) continue;
    const double after = std::atan2(link.y(), link.x());
    const double angle = angle_difference(after, before);
    const auto at = [&](double heading, double distance) {
      return Vector3(joint.centre + distance * Vector3(std::cos(heading), std::sin(heading), 0));
    };
    if (std::abs(angle) > std::numbers::pi / 180) {
      drawing.add(
          Layer::trail,
          Polyline{{joint.centre, at(before, 1.55 * radius)}, construction_grey, 0.8, {3, 2.5}});
      Polyline arc{{}, ink, 1};
      constexpr int steps = 40;
      for (int k = 0; k <= steps; ++k) arc.points.push_back(at(before + angle * k / steps, radius));
      arc.arrow = true;
      drawing.add(Layer::mark, arc);
      const double middle = before + angle / 2;
      drawing.add(Layer::note, Label{at(middle, radius), "θ" + subscript(static_cast<int>(i) + 1),
                                     ink, 9.5, std::cos(middle), std::sin(middle)});
    }
    before = after;
  }
}

std::string angles_text(const ConfigurationRef& q) {
  std::string text;
  for (int k = 0; k < q.size(); ++k) {
    text += (k == 0 ? "θ" : ", θ") + subscript(k + 1) + " = " + degrees_text(q[k]);
  }
  return text;
}

std::string tool_text(const Arm& arm, const ConfigurationRef& q) {
  const Pose tool = forward_kinematics(arm, q);
  const Vector3 p = tool.translation();
  const double size = p.norm();
  const int decimals =
      size > 1e-6 ? std::clamp(static_cast<int>(std::floor(3 - std::log10(size))), 0, 9) : 2;
  if (arm.planar()) {
    return "(" + fixed(p.x(), decimals) + ", " + fixed(p.y(), decimals) + ", " +
           degrees_text(to_plane(tool).theta) + ")";
  }
  return "(" + fixed(p.x(), decimals) + ", " + fixed(p.y(), decimals) + ", " +
         fixed(p.z(), decimals) + ") m";
}

}  // namespace beeline::internal
