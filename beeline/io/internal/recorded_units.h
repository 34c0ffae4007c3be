#pragma once

#include <optional>
#include <string_view>

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

/// Whether the recording has angles whose unit the joint map does not give, and that, as degrees,
/// exceed no limits by more than 0.05 rad.
bool may_be_in_degrees(const Arm& arm, const Trajectory& recording, const JointMap& joint_map);

/// Returns the evidence that the values of joints without two limits, such as 170 and -95, are in
/// degrees: one is more than two revolutions as radians, all are at most one as degrees, and as
/// radians the joint either stays beyond a revolution or, if there are times, exceeds its velocity
/// limit, known or assumed, which it keeps as degrees. None if the values of a joint with limits
/// are out of range in degrees. It is weaker than the evidence of limits: spindles turn often.
std::optional<UnitEvidence> evidence_of_revolutions(const Arm& arm, const Trajectory& recording,
                                                    const JointMap& joint_map, bool has_times);

/// The same as evidence_of_degrees() for the positions of prismatic joints and millimetres.
std::optional<UnitEvidence> evidence_of_millimetres(const Arm& arm, const Trajectory& recording,
                                                    const JointMap& joint_map);

/// The mean time between samples, seconds, if the joints move so slowly that times of a thousandth
/// are likely: a second or more, with less than 1 / 500 of each velocity limit, known or assumed.
/// None otherwise.
std::optional<double> evidence_of_milliseconds(const Arm& arm, const Trajectory& recording);

/// Returns the word of a text, which is the rest of a column's name, that states another quantity
/// than a position, or another unit than Beeline's; empty if there is none. A word has letters
/// only.
std::string_view other_quantity_in(std::string_view text);

}  // namespace beeline::internal
