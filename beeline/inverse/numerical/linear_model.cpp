#include <beeline/inverse/numerical/levenberg_marquardt_lanes.h>
#include <beeline/inverse/numerical/linear_model.h>
#include <beeline/kinematics/internal/mask.h>

namespace beeline::internal {

NumericalGoal numerical_goal(const Arm& arm, const Pose& world_T_tool, const Task& task,
                             const Bounds& bounds, const Configuration& start,
                             const NumericalOptions& options) {
  check_configuration(arm, start);
  check_lane_options(world_T_tool,
                     {.tolerance = options.tolerance, .max_iterations = options.max_iterations});
  check_task(arm, task, bounds);
  NumericalGoal goal{arm, world_T_tool, task, bounds, unit_of_length(arm), {}};
  goal.units.resize(arm.dof());
  for (int k = 0; k < arm.dof(); ++k) {
    goal.units[k] = kind(arm.joint_of(k)) == JointKind::prismatic ? goal.length : 1;
  }
  return goal;
}

void linearise(const NumericalGoal& goal, const Configuration& q, LinearModel& at) {
  const bool tool_axes = goal.task.frame == Frame::tool;
  const Pose world_T_tool = jacobian(goal.arm, q, at.columns, goal.task.frame);
  Twist error = pose_error(goal.world_T_tool, world_T_tool, goal.task.frame);
  const auto& rows = goal.task.rows;
  const auto partly = [&](std::size_t first) {
    return !(rows[first] && rows[first + 1] && rows[first + 2]);
  };
  // The plain Jacobian suffices with all three rows, because its error vanishes with the task's
  // error. With some rows, the free part of the error stays large and contributes to the derivative
  // of the other rows.
  if (tool_axes && partly(0)) {
    at.columns.topRows<3>() -= hat(error.head<3>()) * at.columns.bottomRows<3>();
  }
  if (partly(3)) {
    const Vector3 rotation = error.tail<3>();
    at.columns.bottomRows<3>() =
        so3_left_jacobian_inverse(tool_axes ? rotation : -rotation) * at.columns.bottomRows<3>();
  }
  error = masked(goal.task, error);
  mask_rows(goal.task, at.columns);
  at.deviation = {error.head<3>().norm(), error.tail<3>().norm()};
  error.head<3>() /= goal.length;
  at.columns.topRows<3>() /= goal.length;
  at.columns.array().rowwise() *= goal.units.transpose().array();
  at.error = error;
  at.cost = error.squaredNorm();
}

}  // namespace beeline::internal
