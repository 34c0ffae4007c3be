#pragma once

#include <beeline/kinematics/task.h>
#include <beeline/planning/program.h>

namespace beeline::internal {

/// The largest difference of a coordinate, as a fraction of a tolerance: of its position for
/// prismatic joints, else of its orientation.
double joint_distance(const Arm& arm, const ConfigurationRef& a, const ConfigurationRef& b,
                      const Deviation& tolerance);

/// The distance of configurations from the waypoint of a move, as a fraction of a tolerance: the
/// distance of the tool from its pose and, for a waypoint with joint values, of the joints from
/// these.
class WaypointDistance {
 public:
  /// Keeps references to the arm and the move.
  WaypointDistance(const Arm& arm, const Move& move, const Task& task, const Deviation& tolerance);

  double operator()(const ConfigurationRef& q) const;

 private:
  const Arm& arm_;
  const Move& move_;
  Task task_;
  Deviation tolerance_;
  Pose pose_;
};

}  // namespace beeline::internal
