#include <beeline/kinematics/internal/mask.h>
#include <beeline/path/internal/following.h>
#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/path/tool_path.h>

namespace beeline::internal {
namespace {

/// The components that determine the parameter of a segment, with rotations in metres.
Twist weighted(const Segment& segment, const Task& task, const Rotation& world_R_tool,
               Twist twist) {
  twist = masked(task, in_task_axes(task, world_R_tool, twist));
  twist.tail<3>() *= metres_per_radian;
  const auto* line = std::get_if<Line>(&segment);
  if (line == nullptr) return twist;
  const LineExtent extent = extent_of(*line, task);
  if (extent.by_position()) twist.tail<3>().setZero();
  if (extent.by_rotation()) twist.head<3>().setZero();
  return twist;
}

}  // namespace

Twist in_task_axes(const Task& task, const Rotation& world_R_tool, Twist twist) {
  if (task.frame == Frame::tool) {
    twist << world_R_tool.transpose() * twist.head<3>(), world_R_tool.transpose() * twist.tail<3>();
  }
  return twist;
}

ParameterRates following(const Segment& segment, double s, const Task& task,
                         const PoseMotion& tool) {
  constexpr double at_rest = 1e-24;  // squared metres
  const PoseMotion path = motion_at(segment, s);
  const auto rows = [&](const Twist& twist) {
    return weighted(segment, task, tool.pose.linear(), twist);
  };
  const Twist along = rows(path.velocity);
  const double square = along.squaredNorm();
  if (!(square > at_rest)) return {};
  const PoseMotion still{path.pose, Twist::Zero(), Twist::Zero()};
  const double first = along.dot(rows(error_rates(task, tool, still).first)) / square;
  const ErrorRates error = error_rates(task, tool, motion_along(segment, s, {first, 0}));
  return {first, along.dot(rows(error.second)) / square};
}

ErrorRates error_rates(const Task& task, const PoseMotion& tool, const PoseMotion& path) {
  ErrorRates error{tool.velocity - path.velocity, tool.acceleration - path.acceleration};
  const Vector3 w = tool.velocity.tail<3>(), alpha = tool.acceleration.tail<3>();
  if (task.frame != Frame::tool) {
    error.second.tail<3>() -= w.cross(Vector3(path.velocity.tail<3>()));
    return error;
  }
  const Vector3 offset = tool.pose.translation() - path.pose.translation();
  error.first.head<3>() -= w.cross(offset);
  error.second.head<3>() -=
      alpha.cross(offset) + w.cross(w.cross(offset)) + 2 * w.cross(Vector3(error.first.head<3>()));
  error.second.tail<3>() -= w.cross(Vector3(error.first.tail<3>()));
  return error;
}

PoseMotion motion_along(const Segment& segment, double s, const ParameterRates& rates) {
  const PoseMotion motion = motion_at(segment, s);
  return {motion.pose, rates.first * motion.velocity,
          rates.first * rates.first * motion.acceleration + rates.second * motion.velocity};
}

}  // namespace beeline::internal
