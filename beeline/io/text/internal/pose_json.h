#pragma once

#include <string>

#include <beeline/io/text/json.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {

/// Reads a pose: {"xyz": [x, y, z], "rpy": [roll, pitch, yaw]} in metres and radians, where a
/// missing key means zeros; {"xyz", "quaternion": {"qw", "qx", "qy", "qz"}}; or {"matrix": four
/// rows of four numbers}. Throws FileError that names the value.
Pose pose_from_json(const JsonDocument& document, const Json& json);

/// The same of a shape or a point cloud, of which no warning says that an angle is large: refuses
/// angles beyond two revolutions, which are in degrees.
Pose shape_pose_from_json(const JsonDocument& document, const Json& json);

/// Writes a pose on one line: by xyz and rpy when these read back exactly, otherwise by its matrix.
std::string pose_to_json(const Pose& pose);

/// Roll, pitch and yaw of a rotation with the fewest digits that give exactly this rotation or, if
/// none do, the rotation to rounding.
struct ShortRpy {
  Vector3 value;
  bool exact;
};
ShortRpy short_rpy(const Rotation& wanted);

Vector3 vector_from_json(const JsonDocument& document, const Json& json);

}  // namespace beeline::internal
