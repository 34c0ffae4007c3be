#pragma once

#include <string_view>

#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {

// A joint string describes an arm by its joints: `LETTERS[:ITEM,ITEM,...]`, one item per letter.
//   letters  R P H S C E U, as in composite_joint()
//   item     `length[@angle][pPITCH]`: metres along x to the next joint; a fixed rotation about z
//            before the joint, in degrees; metres of travel per revolution, for H only
// Default lengths are 1 m (0 for P, where the coordinate is the length), default pitches 1 m.
//   RRR:3.5,3.5,2   the arm of Dellaert, Serial Link Manipulators
//   PP:0,0@90       two prismatic joints at right angles
//   RHS:1,0.2p0.05,0   with a screw of 5 cm per revolution and a spherical wrist
// The joints are called joint1, joint2, ... by letter; composite joints append their axes
// (joint3_z).

/// Whether `text` has the form of a joint string: only these letters, or capitals before a colon.
bool is_joint_string(std::string_view text);

/// Returns the arm, whose name is the joint string. Throws Error for an unknown letter, a wrong
/// number of items, an item that cannot be parsed, or more than 100 letters.
Arm arm_from_joint_string(std::string_view text);

}  // namespace beeline
