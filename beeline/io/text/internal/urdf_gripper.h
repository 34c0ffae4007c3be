#pragma once

#include <beeline/io/text/internal/urdf_file.h>

namespace beeline::internal {

/// Whether the joint moves a finger of a gripper, by its name or its child link's: URDF has no
/// other sign of it. A joint such as gripper_roll turns the whole gripper.
bool moves_finger(const UrdfFile::Joint& joint);

}  // namespace beeline::internal
