#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/model/arm.h>

namespace beeline {

/// The built-in arms. Dimensions in metres and radians; the sources stand beside each in the .cpp.
///   rrr      the chapter's planar arm, links 3.5, 3.5, 2 (section 1.5)
///   rp       planar: a link of 1, then a slide along it (exercise of section 1.3)
///   gantry   planar: two slides at right angles (exercise of section 1.7)
///   puma560, ur5, ur5e   standard DH;   panda, iiwa14   modified DH
///   scara    RRRP, standard DH;         stanford        RRPRRR, standard DH
std::vector<std::string> built_in_names();

/// What an arm is, in one line, for lists.
std::string built_in_summary(std::string_view name);

/// Throws Error for an unknown name, with the nearest known one.
Arm built_in(std::string_view name);

/// The chapter's link (section 1.4): `joint` turned by `bend` against the frame before it, then a
/// link of `length` along x at whose far end the link frame sits.
Joint planar_link(Joint joint, double length, double bend = 0);

}  // namespace beeline
