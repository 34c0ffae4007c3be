#pragma once

#include <beeline/kinematics/task.h>
#include <beeline/path/segment.h>

namespace beeline::internal {

/// Transforms a twist from world axes to the axes of the task's frame.
Twist in_task_axes(const Task& task, const Rotation& world_R_tool, Twist twist);

/// First and second derivative of a segment parameter.
struct ParameterRates {
  double first = 0, second = 0;
};

/// Returns the rates with which the segment's pose at s best follows the tool's motion: least
/// squares of the difference of the velocities, then of the accelerations, in the rows of the task,
/// rotations weighted by metres_per_radian. For a line only the position or only the rotation is
/// used (nearest_on_line.h). The rates are zero if the segment is at rest in these rows.
ParameterRates following(const Segment& segment, double s, const Task& task,
                         const PoseMotion& tool);

/// The difference between the tool's motion and the path's motion, in world axes. Its rows of a
/// task are the first and second derivatives of the rows of the tool's error. Rows in tool axes
/// rotate with the tool: they refer to the point of the tool at the path's origin, and motion in
/// free rows has Coriolis terms. If one or two rotations are free, the error is a rotation vector
/// of any length: its derivatives are not the angular velocity.
struct ErrorRates {
  Twist first, second;
};
ErrorRates error_rates(const Task& task, const PoseMotion& tool, const PoseMotion& path);

/// The derivative of the rows of the tool's error, in the axes of the task's frame, with respect to
/// the tool's velocity in world axes.
Eigen::Matrix<double, Eigen::Dynamic, 6> error_jacobian(const Task& task, const Pose& tool,
                                                        const Pose& path);

/// The motion of the segment's pose at s, with respect to the variable of these rates of s.
PoseMotion motion_along(const Segment& segment, double s, const ParameterRates& rates);

}  // namespace beeline::internal
