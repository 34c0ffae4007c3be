#pragma once

#include <optional>

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// A value that shows that a recording is not in radians or metres.
struct UnitEvidence {
  int coordinate = 0;
  double value = 0;  ///< the largest, as it was recorded
};

/// Returns the evidence that the angles of a recording, matched_to() the arm by this joint map, are
/// in degrees: as radians one exceeds its limits by more than a revolution, and as degrees none
/// exceeds them by more than 0.05 rad. Joints without two limits, which may turn often, and angles
/// whose unit the joint map gives do not count.
std::optional<UnitEvidence> evidence_of_degrees(const Arm& arm, const Trajectory& recording,
                                                const JointMap& joint_map);

/// The same for the positions of prismatic joints and millimetres.
std::optional<UnitEvidence> evidence_of_millimetres(const Arm& arm, const Trajectory& recording,
                                                    const JointMap& joint_map);

/// Multiplies the angles whose unit the joint map does not give, and their rates, by pi / 180.
void read_as_degrees(const Arm& arm, const JointMap& joint_map, Trajectory& recording);

/// The mean time between samples, seconds, if the joints move so slowly that times of a thousandth
/// are likely: a second or more, with less than 1 / 500 of each velocity limit, known or assumed.
/// None otherwise.
std::optional<double> evidence_of_milliseconds(const Arm& arm, const Trajectory& recording);

}  // namespace beeline::internal
