#pragma once

#include <optional>
#include <string>

#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// What is wrong with a trajectory, told by verify().
enum class Fault {
  none,
  limits,       ///< a joint outside its position limits, at a sample or between
  flip,         ///< a joint that turns by half a turn or more between two samples
  deviation,    ///< the tool off the line, at a sample or, as far as can be proved, between
  not_through,  ///< a waypoint that is not reached
  velocity,     ///< faster than the limit between two samples
  acceleration,
  jerk,
};
std::string name(Fault fault);

struct JointFault {
  Fault kind = Fault::none;
  std::size_t sample = 0;  ///< at it, or between it and the next
  std::string reason;
};

/// A derivative of a coordinate as the positions of `order` + 1 samples from k on tell it: their
/// divided difference times order!, which is a mean of that derivative (weighed by a B-spline) of
/// any smooth motion through them; less what it may have lost by rounding. Not negative; 0 where
/// there are too few samples. The order is 1, 2 or 3.
double mean_derivative(const Trajectory& trajectory, std::size_t k, int coordinate, int order);

/// By what factor a motion has to last longer to keep the arm's limits of velocity (1 where it is
/// not known), acceleration and, if asked, jerk by its positions; 1 where it does.
double slowdown_for_limits(const Arm& arm, const Trajectory& trajectory, bool keep_jerk);

/// The first time at which a trajectory, its joints in the arm's order, leaves the arm's limits or
/// turns a joint by half a turn or more in one step. See verify().
std::optional<JointFault> first_joint_fault(const Arm& arm, const Trajectory& trajectory);

}  // namespace beeline
