#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {

/// The limits that a file has for the joints of an arm.
struct JointLimits {
  std::map<std::string, LimitOverrides> joints;  ///< by joint name, for with_limits()
  /// What the file says that is not applied: one sentence each, with the file's name.
  std::vector<std::string> notes;
};

/// Reads limits of the arm's joints from a file, .json or YAML, in SI units:
///   - MoveIt's joint_limits.yaml: max_velocity, max_acceleration, max_jerk, min_position and
///     max_position of each joint below the key joint_limits, which may be nested, as in
///     `/**: ros__parameters:`. `has_velocity_limits: false` states that no limit is known; numbers
///     with the tag !degrees are in degrees, as in the files of Universal Robots. A limit
///     bounds both directions, so it is the lower of max_velocity and |min_velocity|, and of
///     max_acceleration, |min_acceleration| and |max_deceleration|. A joint NAME of the file that
///     the arm does not have is its NAME_joint; where the file has all joints of the arm with one
///     prefix, such as `panda_`, it is left out. The files of Franka's robots are read too:
///     `joint1: limit: {lower, upper, velocity}`. Notes name the file's other joints and its
///     default scaling factors, which are not applied.
///   - JSON: {"joint1": {"lower", "upper", "velocity", "acceleration", "jerk"}, ...}; all optional.
/// Throws FileError for anything else, with the line: a file without any joint of the arm, an
/// unknown key, a number that is not finite, in quotes or out of range, lower above upper.
JointLimits read_joint_limits(const std::string& path, const Arm& arm);
/// The same from a text, which is JSON if `path` ends in .json or, without .yaml and .yml, if the
/// text begins with a brace.
JointLimits joint_limits_from_text(std::string_view text, const std::string& path, const Arm& arm);

}  // namespace beeline
