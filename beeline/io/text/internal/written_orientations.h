#pragma once

#include <string>
#include <vector>

#include <beeline/io/text/json.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {

/// The roll, pitch and yaw of a pose in an arm file.
struct WrittenOrientation {
  std::string joint;              ///< whose origin it is; empty if it is another pose
  std::string key;                ///< of the pose: `base`
  Vector3 rpy = Vector3::Zero();  ///< rad
  int line = 0;
};

/// Returns the orientations of all poses of an arm file that are given by roll, pitch and yaw.
std::vector<WrittenOrientation> written_orientations(const JsonDocument& document);

}  // namespace beeline::internal
