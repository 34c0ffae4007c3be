#pragma once

#include <string>
#include <vector>

#include <beeline/io/text/json.h>
#include <beeline/io/text/pose_list.h>
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

/// An angle of a Denavit-Hartenberg table in an arm file.
struct WrittenDhAngle {
  std::size_t row = 0;
  std::string key;   ///< `alpha` or `theta`
  double angle = 0;  ///< in the unit of the table
  int line = 0;
};

/// Returns the unit of the angles of the Denavit-Hartenberg table, radians if there is none.
AngleUnit unit_of_dh(const JsonDocument& document);

/// Returns the angles of the Denavit-Hartenberg table in the order of its rows; none without one.
std::vector<WrittenDhAngle> written_dh_angles(const JsonDocument& document);

}  // namespace beeline::internal
