#pragma once

#include <string>
#include <vector>

#include <beeline/model/joint.h>

namespace beeline {

/// The joints that a letter of the chapter's Figures 1.1 and 1.2 stands for, as one-degree-of-
/// freedom joints at one place, to be actuated in this order:
///   R  rotation about z              P  slide along x (the link's direction)
///   H  rotation about z with travel along z, `pitch` metres per radian
///   S  spherical: rotations about z, y, x      U  universal: rotations about z, y
///   C  cylindrical: rotation about z, slide along z
///   E  planar: slides along x and y, rotation about z
/// One joint is called `name`; several are `name_z`, `name_y`, ... by axis, a slide `name_slide_x`.
/// Throws Error for another letter, naming these.
std::vector<Joint> composite_joint(char letter, const std::string& name, double pitch = 0);

}  // namespace beeline
