#pragma once

#include <beeline/draw/figure.h>

namespace beeline::internal {

/// Draws a joint of the type P, R, S, C, H or E between two parts of links, with arrows along and
/// about its axes: without rulers, at any scale.
Panel joint_picture(char type, const std::string& caption);

/// Draws a revolute or prismatic joint that connects two links, with the second link in another
/// position, faded; Figure 1.1 of Dellaert, *Serial Link Manipulators*.
Panel linked_joint(JointKind kind, const std::string& caption);

}  // namespace beeline::internal
