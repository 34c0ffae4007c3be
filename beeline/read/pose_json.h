#pragma once

#include <string>

#include <beeline/pose/se3.h>
#include <beeline/read/json.h>

namespace beeline {

/// A pose in JSON: {"xyz": [x, y, z], "rpy": [roll, pitch, yaw]} in metres and radians, either left
/// out when zero; {"xyz", "quaternion": {"qw", "qx", "qy", "qz"}}; or {"matrix": four rows of
/// four}. Throws FileError naming the place.
Pose pose_from_json(const JsonDocument& document, const Json& json);

/// On one line, by xyz and rpy where these read back exactly, else by the matrix.
std::string pose_to_json(const Pose& pose);

}  // namespace beeline
