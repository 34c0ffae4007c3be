#pragma once

#include <iosfwd>
#include <string>

#include <beeline/inverse/inverse_kinematics.h>

namespace beeline {

/// The outcome of a motion. Every status except `reached` has a reason of one sentence.
enum class MotionStatus {
  reached,           ///< the goal is reached, within tolerance
  unreachable,       ///< no configuration reaches a pose of the path: by geometry or search, see
                     ///< InverseStatus
  not_found,         ///< no configuration was found for a pose of the path; one may exist
  outside_limits,    ///< a joint would have to leave its limits
  singular,          ///< at a singularity, where only a jump to another branch would lead on
  not_proved,        ///< the deviation between samples is not proved to be within tolerance
  too_many_samples,  ///< the tolerance needs more than the option max_samples
  not_converged,     ///< a feedback controller did not converge to the goal, see ControlledMotion
  time_limit,        ///< the budget's time ended the search
  cancelled,         ///< Budget::cancelled ended it
  work_limit,        ///< Budget::max_work ended it
};
std::string name(MotionStatus status);
std::ostream& operator<<(std::ostream& out, MotionStatus status);  ///< name(status)

/// Returns the status of a motion through a pose for which inverse kinematics has this status.
MotionStatus motion_status(InverseStatus status);

}  // namespace beeline
