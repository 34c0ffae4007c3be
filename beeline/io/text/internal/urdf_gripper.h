#pragma once

#include <cstddef>
#include <vector>

#include <beeline/io/text/internal/urdf_file.h>

namespace beeline::internal {

/// Whether the joint moves a finger of a gripper, by its name or its child link's. A joint such as
/// gripper_roll turns the whole gripper.
bool moves_finger(const UrdfFile::Joint& joint);

/// Finds the joints that move fingers by the structure of a tree, whatever their names: below one
/// link, the palm, two or more branches move, and all of their joints follow one of them or another
/// joint; or each branch has one joint, and these are prismatic with the same finite range.
/// `links` are all links, each after its parent; `child_joints` are the joints below each link and
/// `child_link` is the link below each joint: indices into the file. Takes time in proportion to
/// the file.
std::vector<bool> fingers_by_structure(const UrdfFile& file, const std::vector<std::size_t>& links,
                                       const std::vector<std::vector<std::size_t>>& child_joints,
                                       const std::vector<std::size_t>& child_link);

}  // namespace beeline::internal
