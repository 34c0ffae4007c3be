#pragma once

#include <string_view>

#include <beeline/model/arm.h>

namespace beeline {

/// Joint strings name an arm by its joints: `LETTERS[:ITEM,ITEM,...]`, one item for each letter.
///   letters  R P H S C E U, as in composite_joint
///   item     `length[@bend][pPITCH]`: metres along x to the next joint; a fixed turn about z
///   before
///            the joint, in degrees; metres of travel per turn, for H only
/// Left out, all lengths are 1 (but 0 for P, whose slide is its length) and pitches 1.
///   RRR:3.5,3.5,2   the chapter's arm       PP:0,0@90   slides at right angles
///   RHS:1,0.2p0.05,0   with a screw of 5 cm per turn and a spherical wrist
/// The joints are joint1, joint2, ... by letter; composites add their axes (joint3_z).

/// Whether `text` means to be a joint string: these letters alone, or capitals before a colon.
bool is_joint_string(std::string_view text);

/// The arm, named by its string. Throws Error for an unknown letter, a wrong count of items, an
/// item that cannot be read, or more than `max_joints` letters.
Arm arm_from_joint_string(std::string_view text);

}  // namespace beeline
