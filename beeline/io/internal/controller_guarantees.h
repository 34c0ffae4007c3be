#pragma once

#include <beeline/io/trajectory_file.h>

namespace beeline::internal {

/// What verify() shows of a trajectory in a file for a controller, as far as the form carries it.
struct ControllerGuarantees {
  /// Why the file is refused: a limit of the arm that its motion exceeds; none if it is not.
  Reason refusal = {};
  std::string proof = {};                    ///< ControllerFile::proof
  std::vector<std::string> not_proved = {};  ///< ControllerFile::not_proved
};

/// Returns the guarantees of the samples of a file, which begin at time 0, of the given trajectory.
/// Joints play the samples of ros2 as the columns mean, so that the limits of position, velocity,
/// acceleration and jerk that verify() proves hold on the controller; other forms carry the
/// positions of the samples.
ControllerGuarantees guarantees_of(const Arm& arm, const Trajectory& given,
                                   const Trajectory& samples, ControllerForm form, bool resampled,
                                   const ControllerFileOptions& options);

}  // namespace beeline::internal
