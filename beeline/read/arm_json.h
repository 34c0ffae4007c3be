#pragma once

#include <string>
#include <string_view>

#include <beeline/model/arm.h>

namespace beeline {

/// An arm as JSON; docs/arm.schema.json is the whole grammar. Metres, radians, seconds.
///     {"name": "my arm", "base": POSE, "tool": POSE,     base and tool may be left out
///      "joints": [{"name", "type", "origin": POSE, "axis", "point", "pitch" or "screw",
///                  "limits": {"lower", "upper", "velocity", "acceleration", "jerk"},
///                  "mimic": {"joint", "multiplier", "offset"}, "link"}, ...]}
/// or, in place of "joints", one of
///      "joint_string": "RRP:1,0.5,0.2"
///      "dh": {"convention": "standard" or "modified",
///             "rows": [{"name", "type", "a", "alpha", "d", "theta", "limits"}, ...]}
/// Throws FileError for anything else, naming line and place: `joints[2].limits.lower`.
Arm read_arm_json(const std::string& path);
Arm arm_from_json(std::string_view text, const std::string& path);

/// The arm by its joints: read back it is the same arm, to the last bit.
/// Throws Error for a name that check_name refuses.
std::string arm_to_json(const Arm& arm);

}  // namespace beeline
