#pragma once

#include <string>

#include <beeline/inverse/inverse_kinematics.h>

namespace beeline {

/// How a motion ended. Every status but `reached` comes with a reason of one sentence.
enum class MotionStatus {
  reached,      ///< the goal, within tolerance
  unreachable,  ///< no configuration of the arm reaches a pose on the way
  not_found,  ///< no configuration was found for a pose on the way; that none exists is not proved
  outside_limits,  ///< a joint would have to leave its limits
  singular,        ///< the arm cannot move on continuously: it would have to jump to another branch
  not_converged,   ///< the controller did not arrive: gain too large or too small, or stuck
};
std::string name(MotionStatus status);

/// What a pose on the way makes of the motion, when inverse kinematics finds no solution for it.
MotionStatus status_of(InverseStatus status);

}  // namespace beeline
