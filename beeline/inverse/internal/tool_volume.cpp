#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <beeline/inverse/internal/tool_volume.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/mask.h>
#include <beeline/model/internal/mimic_joints.h>
#include <beeline/model/internal/ranges.h>

namespace beeline::internal {
namespace {

constexpr double rounding = 1e-12;  // more than the rounding error of a length, relative

/// A point of an axis of rotation.
struct AxisPoint {
  Vector3 axis, point;

  /// Moves the point along the axis to where the sum of its distances from two points is least:
  /// rotated about the axis into a plane with it, on opposite sides, they are connected by a
  /// straight line.
  void move_between(const Vector3& a, const Vector3& b) {
    const double along_a = axis.dot(a - point), along_b = axis.dot(b - point);
    const double from_a = axis.cross(a - point).norm(), from_b = axis.cross(b - point).norm();
    const double apart = from_a + from_b;
    const double along = apart > 0 ? (along_a * from_b + along_b * from_a) / apart : along_a;
    point += along * axis;
  }
};

/// Moves the points along their axes so that the path from the first one over the others to the
/// tool is short, and returns its length. Neighbours are fixed to one link, so their distance is
/// constant and the length is a bound for any choice of the points.
double shortest_path(std::vector<AxisPoint>& axes, const Vector3& tool) {
  constexpr int rounds = 30;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = axes.size(); i-- > 0;) {
      const Vector3& next = i + 1 < axes.size() ? axes[i + 1].point : tool;
      axes[i].move_between(i > 0 ? axes[i - 1].point : next, next);
    }
  }
  double length = 0;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    length += ((i + 1 < axes.size() ? axes[i + 1].point : tool) - axes[i].point).norm();
  }
  return length;
}

/// `slides`: the sum of the lengths by which the ball is swept.
Arm::Reach rounded_outwards(Arm::Reach ball, double slides) {
  ball.radius += 4 * rounding * (ball.radius + ball.centre.norm() + slides);
  return ball;
}

}  // namespace

Arm::Reach ball_of_tool(const Arm& arm) {
  Arm::Reach ball{.radius = std::numeric_limits<double>::infinity()};
  const std::vector<Pose> world_T_link = link_poses(arm, Configuration::Zero(arm.dof()));
  std::vector<AxisPoint> axes;
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    if (arm.couplings()[i].ratio == 0) continue;
    if (kind(arm.joints()[i]) != JointKind::revolute) return ball;
    const Twist screw = adjoint(world_T_link[i + 1], arm.joints()[i].screw);
    const Vector3 axis = screw.tail<3>();
    axes.push_back({axis, axis.cross(screw.head<3>())});
  }
  const Vector3 tool = forward_kinematics(arm, Configuration::Zero(arm.dof())).translation();
  ball.radius = shortest_path(axes, tool) * (1 + rounding);
  ball.centre = axes.empty() ? tool : axes.front().point;
  return ball;
}

ToolVolume::ToolVolume(const Arm& arm) {
  const std::vector<Joint>& joints = arm.joints();
  Pose base_T_link = arm.base();
  std::size_t first = 0;  // joint behind the slides
  if (!has_mimic_joints(arm)) {
    while (first + 1 < joints.size() && add_slide(joints[first], base_T_link)) ++first;
  }
  const auto behind = joints.begin() + static_cast<std::ptrdiff_t>(first);
  const Arm rest =
      first == 0 ? arm : Arm(arm.name(), {behind, joints.end()}, arm.tool(), base_T_link);
  double size = 0;
  for (const Slide& slide : slides_) {
    if (std::isfinite(slide.half_range)) size += slide.half_range;
  }
  ball_ = rounded_outwards(ball_of_tool(rest), size);
  limited_ball_ = rounded_outwards(rest.reach(), size);
  if (ball_.radius < limited_ball_.radius) limited_ball_ = ball_;
}

/// Adds the joint and moves the link to the middle of its range. Returns false for a joint that is
/// not prismatic or not at right angles to the slides before it, or leads beyond the largest base.
bool ToolVolume::add_slide(const Joint& joint, Pose& base_T_link) {
  if (kind(joint) != JointKind::prismatic || slide_count_ == slides_.size()) return false;
  const Pose link = base_T_link * joint.offset;
  const Vector3 axis = (link.linear() * joint.screw.head<3>()).normalized();
  for (const Slide& before : slides_) {
    if (std::abs(axis.dot(before.axis)) > rounding) return false;
  }
  const double range = joint.limits.upper - joint.limits.lower;
  const bool limited = std::isfinite(range);
  Pose moved = link;
  if (limited) moved.translation() += (joint.limits.lower + range / 2) * axis;
  if (moved.translation().cwiseAbs().maxCoeff() > max_length) return false;
  base_T_link = moved;
  slides_[slide_count_++] = {axis, limited ? range / 2 : Limits::none};
  return true;
}

bool ToolVolume::excludes(const Pose& world_T_tool, const Task& task, double tolerance,
                          bool ignore_limits) const {
  const bool all_rows = task.positions() == 3;
  if (!all_rows && task.frame == Frame::tool) return false;
  const Arm::Reach& ball = ignore_limits ? ball_ : limited_ball_;
  Vector3 offset = world_T_tool.translation() - ball.centre;
  double radius = ball.radius + tolerance + 4 * rounding * offset.norm();
  if (!all_rows) offset = masked_position(task, offset);
  for (std::size_t i = 0; i < slide_count_; ++i) {
    const Vector3& axis = slides_[i].axis;
    const double half_range = ignore_limits ? Limits::none : slides_[i].half_range;
    const Vector3 seen = all_rows ? axis : masked_position(task, axis);
    if (all_rows || (seen - axis).norm() <= rounding) {
      offset -= std::clamp(offset.dot(axis), -half_range, half_range) * axis;
    } else if (!seen.isZero(0)) {
      radius += half_range * seen.norm();  // seen at an angle, or nearly along it
    }
  }
  return offset.norm() > radius;
}

}  // namespace beeline::internal
