#pragma once

#include <beeline/draw/figure.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

/// Figures 1.1 to 1.5 of Dellaert, *Serial Link Manipulators*, which explain joints, frames and
/// transformations. `arm` is the chapter's arm of three links.
Figure figure_1_1(const Arm& arm);
Figure figure_1_2(const Arm& arm);
Figure figure_1_3(const Arm& arm);
Figure figure_1_4(const Arm& arm);
Figure figure_1_5(const Arm& arm);

/// Draws a joint of the type P, R, S, C, H or E between two parts of links, with arrows along and
/// about its axes: without rulers, at any scale.
Panel joint_picture(char type, const std::string& caption);

/// Draws a revolute or prismatic joint that connects two links, with the second link in another
/// position, faded; Figure 1.1 of Dellaert, *Serial Link Manipulators*.
Panel linked_joint(JointKind kind, const std::string& caption);

}  // namespace beeline::internal
