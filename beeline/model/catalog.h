#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {

/// A built-in arm and the source of its numbers.
struct BuiltInArm {
  std::string name;    ///< name for built_in(), such as `panda`
  std::string maker;   ///< the maker, or the author of the description
  std::string model;   ///< the maker's name of the arm
  std::string source;  ///< document that gives the lengths and limits
  std::string note;  ///< zero, signs and couplings that differ from the controller's; may be empty
  /// Where the meshes are from that the shapes of the links contain; empty: it has no shapes.
  std::string shapes_source;
  /// Names of the joints in descriptions for ROS, in the arm's order, one list for each
  /// description. A trajectory with these names belongs to the arm: see matched_to().
  std::vector<std::vector<std::string>> joint_names;
};

/// Returns the built-in arms by name: the arms of Dellaert, *Serial Link Manipulators* (rrr,
/// section 1.5; rp, exercise of section 1.3; gantry, exercise of section 1.7), and arms on the
/// market. Each is a file of beeline/model/arms/, which read_arm_json() reads too.
const std::vector<BuiltInArm>& built_in_arms();
std::vector<std::string> built_in_names();

/// Returns the built-in arm; its tool is the flange or the frame that the note names. The source
/// gives its joint limits. Throws Error for an unknown name, suggesting the nearest one.
Arm built_in(std::string_view name);

/// Returns the lists of names of the joints that have a coordinate: the arm's own names and, for a
/// built-in arm, BuiltInArm::joint_names.
std::vector<std::vector<std::string>> joint_namings(const Arm& arm);

/// Returns the coordinate of the joint that one of joint_namings() calls so; none for another name.
std::optional<int> coordinate_called(const Arm& arm, std::string_view joint);

}  // namespace beeline
