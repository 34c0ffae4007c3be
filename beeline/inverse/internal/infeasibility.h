#pragma once

#include <optional>

#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// A proof from the arm's geometry that no configuration reaches a pose.
struct Infeasibility {
  double missing = 0;           ///< least error of any configuration: metres, or radians
  bool of_orientation = false;  ///< whether `missing` is an angle
  Reason reason;
};

/// Whether the pose violates an invariant of the tool's motion. If all axes are parallel, the
/// invariants are the tilt relative to the axes and, if no joint moves along them, the height. If
/// all joints are prismatic, they are the orientation and the components of the position outside
/// the span of the directions.
std::optional<Infeasibility> invariant_violation(const Arm& arm, const Pose& world_T_tool,
                                                 const Task& task, double tolerance);

}  // namespace beeline::internal
