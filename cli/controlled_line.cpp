#include "controlled_line.h"

#include <beeline/kinematics/forward.h>

namespace beeline::command {

LineReport line_by_control(const Arm& arm, const Configuration& start,
                           const std::vector<Pose>& waypoints, const CartesianOptions& options) {
  ControlledMotion motion = control_in_lines(arm, start, waypoints, options);
  LineReport report;
  report.planned = false;
  report.status = motion.status;
  report.reason = motion.reason;
  report.trajectory = std::move(motion.trajectory);
  report.steps = motion.steps;
  report.overshoot = motion.overshoot;
  report.limits = motion.limits;
  report.start_jump = motion.start_jump;
  if (report.status == MotionStatus::reached) {
    const Task task = options.task.value_or(default_task(arm));
    std::vector<Pose> poses = waypoints;
    poses.insert(poses.begin(), forward_kinematics(arm, start));
    const ToolPath path = lines_through(poses);
    const auto path_parameters =
        path_parameters_along(arm, report.trajectory.positions, path, motion.arrivals, task);
    report.path = {path, path_parameters, task, std::nullopt, waypoints};
    report.deviation = path_deviation(arm, report.trajectory, path_parameters, path, task);
  }
  return report;
}

}  // namespace beeline::command
