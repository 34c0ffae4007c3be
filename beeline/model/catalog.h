#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {

/// What a built-in arm is, and where its numbers come from.
struct BuiltInArm {
  std::string name;    ///< such as `panda`, for built_in()
  std::string maker;   ///< who makes or has described it
  std::string model;   ///< the maker's name of it
  std::string source;  ///< the document of its lengths and limits
  std::string note;  ///< zero, signs and couplings that differ from the controller's; may be empty
  /// What descriptions for ROS call the joints, in the arm's order: a list for each description. A
  /// trajectory with these names is one of the arm: see matched_to().
  std::vector<std::vector<std::string>> joint_names;
};

/// Returns the built-in arms by name: the arms of Dellaert, *Serial Link Manipulators* (rrr,
/// section 1.5; rp, exercise of section 1.3; gantry, exercise of section 1.7), and arms on the
/// market. Each is a file of beeline/model/arms/, which read_arm_json() reads too.
const std::vector<BuiltInArm>& built_in_arms();
std::vector<std::string> built_in_names();

/// Returns the built-in arm; its tool is the flange. Joint limits are those that the source gives.
/// Throws Error for an unknown name, suggesting the nearest one.
Arm built_in(std::string_view name);

}  // namespace beeline
