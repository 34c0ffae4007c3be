#pragma once

#include <string>
#include <string_view>

#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {

/// Arms as JSON; docs/arm.schema.json is the complete grammar. Metres, radians, seconds.
///     {"name": "my arm", "base": POSE, "tool": POSE,     base and tool are optional,
///      "controller_base": POSE, "flange": POSE,           so are the ControllerFrames,
///      "controller_base_assumed", "flange_assumed",       which count as stated unless true
///      "maker", "model", "source", "note",                and these texts
///      "joint_names": [["name", ...], ...],               other descriptions' names, not kept
///      "joints": [{"name", "type", "origin": POSE, "axis", "point", "pitch" or "screw",
///                  "limits": {"lower", "upper", "velocity", "acceleration", "jerk"},
///                  "mimic": {"joint", "multiplier", "offset"}, "link"}, ...]}
/// or, instead of "joints", one of
///      "joint_string": "RRP:1,0.5,0.2"
///      "dh": {"convention": "standard" or "modified", "degrees": true or false,
///             "rows": [{"name", "type", "a", "alpha", "d", "theta", "limits"}, ...]}
/// "degrees": alpha, theta and the limits of revolute rows are in degrees, as in makers' tables.
/// Throws FileError for anything else; it names the line and the value: `joints[2].limits.lower`.
Arm read_arm_json(const std::string& path);
/// The same from a text; `path` names it in messages.
Arm arm_from_json(std::string_view text, const std::string& path);

/// Returns the arm as JSON, described by its joints; it reads back exactly.
/// Throws Error for a name that is empty, longer than 1000 bytes, not UTF-8, or that contains
/// control characters.
std::string arm_to_json(const Arm& arm);

/// Writes arm_to_json() to a file. Throws FileError when the file cannot be written.
void write_arm_json(const std::string& path, const Arm& arm);

}  // namespace beeline
