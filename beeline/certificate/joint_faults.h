#pragma once

#include <iosfwd>
#include <optional>
#include <string>

#include <beeline/budget.h>
#include <beeline/error.h>
#include <beeline/reason.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// The faults that verify() finds in a trajectory.
enum class Fault {
  none,
  limits,       ///< a joint exceeds its position limits, at a sample or between two
  flip,         ///< a joint rotates by pi or more between two samples
  deviation,    ///< the tool leaves the path, at a sample or possibly between two
  backwards,    ///< the tool moves back on the path, at a sample or possibly between two
  not_through,  ///< a waypoint is not reached
  velocity,     ///< a velocity limit is exceeded between two samples
  acceleration,
  jerk,
  moving,      ///< a joint moves at the start, the end or a waypoint at which a program stops
  dwell,       ///< the arm does not rest long enough at a waypoint of a program
  tool_speed,  ///< the tool is faster than a move of a program allows
};
std::string name(Fault fault);
std::ostream& operator<<(std::ostream& out, Fault fault);  ///< name(fault)

/// The ends of a trajectory at which the joints may move; at the others they start from rest, or
/// come to rest.
struct MovingEnds {
  bool start = false, end = false;
};

struct JointFault {
  Fault kind = Fault::none;
  std::size_t sample = 0;  ///< the fault is at this sample, or between it and the next
  Reason reason = {};      ///< joint, value, limit
};

/// Returns the first fault in time of a trajectory's joints, whose columns are in the arm's order:
/// limits, flip, velocity, acceleration, jerk or moving; see verify() for their meaning.
/// Derivatives may exceed their limits by a millionth, or by the fraction `limit_tolerance` if that
/// is more, and by what the rounding of times to doubles makes of them after hours, at most a ten
/// thousandth. Nothing where the budget ends it before.
/// Throws Error when the trajectory does not fit the arm.
std::optional<JointFault> first_joint_fault(const Arm& arm, const Trajectory& trajectory,
                                            const MovingEnds& moving = {},
                                            const Budget& budget = {}, double limit_tolerance = 0);

namespace internal {

/// Throws Error unless a limit tolerance is from 0 to 0.1.
void check_limit_tolerance(double limit_tolerance);

}  // namespace internal

}  // namespace beeline
