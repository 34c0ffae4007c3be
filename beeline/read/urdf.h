#pragma once

#include <string>
#include <string_view>

#include <beeline/model/arm.h>
#include <beeline/read/arm.h>

namespace beeline {

/// The chain from `ends.base` to `ends.tip` of a URDF file, with the base link's frame as world.
///   - revolute, continuous and prismatic joints move, fixed ones go into their neighbours' offsets
///     and the last ones into the tool; other types are refused within the chain only
///   - <axis> missing: 1 0 0; <limit> missing: none; effort and soft limits are not read
///   - a velocity limit that is missing, zero (what exporters write for one that nobody gave) or
///     below is not known
///   - a joint that mimics one that does not move on this chain is a coordinate of its own
///   - frames are the file's: each joint moves the child link, whose name goes to Joint::link
/// Throws FileError for what parse_urdf refuses; a link with two parents, a circle, several roots
/// or tips and none chosen; a tip that is unknown, not below the base, or reached without a moving
/// joint; on the chain an axis without length, limits the wrong way round, or a joint that mimics
/// one which the file does not have.
Arm read_urdf(const std::string& path, const ChainEnds& ends = {});
Arm arm_from_urdf(std::string_view text, const std::string& path, const ChainEnds& ends = {});

}  // namespace beeline
