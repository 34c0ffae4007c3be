#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {

/// The names of the built-in arms. The arms of Dellaert, *Serial Link Manipulators*:
///   rrr      planar, links of 3.5, 3.5 and 2 m (section 1.5)
///   rp       planar, a link of 1 m and a prismatic joint along it (exercise of section 1.3)
///   gantry   planar, two prismatic joints at right angles (exercise of section 1.7)
/// and industrial arms, whose sources catalog.cpp cites:
///   puma560, ur5, ur5e, scara (RRRP), stanford (RRPRRR)   standard DH
///   panda, iiwa14                                          modified DH
std::vector<std::string> built_in_names();

/// A description of the arm in one line. Throws Error for an unknown name.
std::string built_in_summary(std::string_view name);

/// Returns the built-in arm. Throws Error for an unknown name, suggesting the nearest one.
Arm built_in(std::string_view name);

/// A planar link (section 1.4 of the chapter): `joint`, rotated by `angle` (rad) about z, then
/// `length` metres along x to the link frame.
Joint planar_link(Joint joint, double length, double angle = 0);

}  // namespace beeline
