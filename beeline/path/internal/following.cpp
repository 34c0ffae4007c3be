#include <beeline/kinematics/internal/mask.h>
#include <beeline/path/internal/following.h>
#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/path/tool_path.h>
#include <beeline/pose/internal/rotation_rates.h>

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

/// Whether one or two rotations are free, about which the error may be large.
bool partly_rotates(const Task& task) {
  return task.orientations() == 1 || task.orientations() == 2;
}

/// The rotation by which the tool is off the path's orientation, and its derivatives, all in world
/// axes: log(R_t R_p^T) = r rotates with w_t - exp(r) w_p. In tool axes it is the negative of -r,
/// which rotates with the negative of w_t - w_p.
void set_rotation_rates(const Task& task, const PoseMotion& tool, const PoseMotion& path,
                        ErrorRates& error) {
  const Rotation path_R_tool = tool.pose.linear() * path.pose.linear().transpose();
  const Vector3 r = so3_log(path_R_tool);
  const Vector3 w = tool.velocity.tail<3>(), alpha = tool.acceleration.tail<3>();
  const Vector3 w_p = path.velocity.tail<3>(), alpha_p = path.acceleration.tail<3>();
  if (task.frame == Frame::tool) {
    const Vector3 relative = w - w_p;
    const RotationRates rates =
        rotation_vector_rates(-r, {-relative, -(alpha - alpha_p - w.cross(relative))});
    error.first.tail<3>() = -rates.velocity;
    error.second.tail<3>() = -rates.acceleration;
    return;
  }
  const Vector3 turned = path_R_tool * w_p, relative = w - turned;
  const RotationRates rates =
      rotation_vector_rates(r, {relative, alpha - relative.cross(turned) - path_R_tool * alpha_p});
  error.first.tail<3>() = rates.velocity;
  error.second.tail<3>() = rates.acceleration;
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
  const PoseMotion still{path.pose, Twist::Zero(), Twist::Zero()};
  const Twist behind = rows(error_rates(task, tool, still).first);
  const Twist along = partly_rotates(task)
                          ? Twist(behind - rows(error_rates(task, tool, path).first))
                          : rows(path.velocity);
  const double square = along.squaredNorm();
  if (!(square > at_rest)) return {};
  const double first = along.dot(behind) / square;
  const ErrorRates error = error_rates(task, tool, motion_along(segment, s, {first, 0}));
  return {first, along.dot(rows(error.second)) / square};
}

ErrorRates error_rates(const Task& task, const PoseMotion& tool, const PoseMotion& path) {
  ErrorRates error{tool.velocity - path.velocity, tool.acceleration - path.acceleration};
  const Vector3 w = tool.velocity.tail<3>(), alpha = tool.acceleration.tail<3>();
  if (task.frame != Frame::tool) {
    error.second.tail<3>() -= w.cross(Vector3(path.velocity.tail<3>()));
    if (partly_rotates(task)) set_rotation_rates(task, tool, path, error);
    return error;
  }
  const Vector3 offset = tool.pose.translation() - path.pose.translation();
  error.first.head<3>() -= w.cross(offset);
  error.second.head<3>() -=
      alpha.cross(offset) + w.cross(w.cross(offset)) + 2 * w.cross(Vector3(error.first.head<3>()));
  error.second.tail<3>() -= w.cross(Vector3(error.first.tail<3>()));
  if (partly_rotates(task)) set_rotation_rates(task, tool, path, error);
  return error;
}

Eigen::Matrix<double, Eigen::Dynamic, 6> error_jacobian(const Task& task, const Pose& tool,
                                                        const Pose& path) {
  const bool tool_axes = task.frame == Frame::tool;
  Eigen::Matrix<double, 6, 6> all = Eigen::Matrix<double, 6, 6>::Identity();
  if (partly_rotates(task)) {
    const Vector3 r = so3_log(tool.linear() * path.linear().transpose());
    all.bottomRightCorner<3, 3>() = so3_left_jacobian_inverse(tool_axes ? Vector3(-r) : r);
  }
  if (tool_axes) {
    const Rotation tool_R_world = tool.linear().transpose();
    all.topRightCorner<3, 3>() = hat(tool.translation() - path.translation());
    all.topRows<3>() = tool_R_world * all.topRows<3>();
    all.bottomRows<3>() = tool_R_world * all.bottomRows<3>();
  }
  return selected_rows(task, all);
}

PoseMotion motion_along(const Segment& segment, double s, const ParameterRates& rates) {
  const PoseMotion motion = motion_at(segment, s);
  return {motion.pose, rates.first * motion.velocity,
          rates.first * rates.first * motion.acceleration + rates.second * motion.velocity};
}

}  // namespace beeline::internal
