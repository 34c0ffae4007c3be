#pragma once

#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/model/joint.h>

namespace beeline {

/// A joint type: its letter in joint strings, its name in JSON, and whether it has several degrees
/// of freedom.
struct JointType {
  char letter;
  std::string name;
  bool composite;
};

/// All joint types. To add one, add a row to the table in composite.cpp.
const std::vector<JointType>& joint_types();

/// Expands a joint type (Dellaert, *Serial Link Manipulators*, Figures 1.1 and 1.2) into
/// one-degree-of-freedom joints with coincident frames, in this order:
///   R  revolute: rotation about z
///   P  prismatic: translation along x, the link's direction
///   H  helical: rotation about z with translation along z, `pitch` metres per radian
///   S  spherical: rotations about z, y, x
///   U  universal: rotations about z, y
///   C  cylindrical: rotation about z, translation along z
///   E  planar: translations along x and y, rotation about z
/// A single joint has the name `name`; several are named after their axes, `name_z` for a rotation
/// and `name_slide_x` for a translation. Throws Error for another letter.
std::vector<Joint> composite_joint(char letter, const std::string& name, double pitch = 0);

/// A planar link (section 1.4 of the chapter): `joint`, rotated by `angle` (rad) about z, then
/// `length` metres along x to the link frame.
Joint planar_link(Joint joint, double length, double angle = 0);

}  // namespace beeline
