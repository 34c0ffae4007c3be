#pragma once

#include <string>

#include <beeline/model/arm.h>

namespace beeline::internal {

// The accepted ranges of an arm's numbers. They are far beyond any arm that is built, and so narrow
// that squares and products of lengths, angles and rates keep the accuracy that searches rely on.

/// Joints of an arm, mimic joints included.
constexpr std::size_t max_joints = 100;
/// Coordinates of offsets, base and tool, moments of screws, in metres; pitches, in metres per
/// radian.
constexpr double max_length = 1e6;
/// Multiplier and offset of a mimic joint relative to the joint that leads it in the end.
constexpr double max_mimic = 1e6;

/// Each throws Error for what is out of range; the message names the culprit and the range.
void check_count(std::size_t joints, const std::string& arm);
void check_limits(const Limits& limits, const std::string& what);
void check_joint(Joint& joint, std::size_t index);  ///< makes its offset a rigid motion
void check_coupling(const Arm::JointCoupling& coupling, const std::string& joint);
Pose checked_placement(const Pose& pose, const std::string& what);

}  // namespace beeline::internal
