#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>
#include <beeline/kinematics/jacobian.h>

namespace beeline {

/// Coordinates of the tool's orientation in the world.
enum class OrientationCoordinates {
  roll_pitch_yaw,   ///< roll, pitch, yaw of RollPitchYaw, rad
  quaternion,       ///< qw, qx, qy, qz of Quaternion, qw >= 0
  rotation_vector,  ///< rx, ry, rz of so3_log(), rad
};
std::string name(OrientationCoordinates coordinates);  ///< rpy, quaternion, rotation-vector
std::vector<std::string> orientation_coordinates_names();

/// Throws Error listing the names for another name.
OrientationCoordinates orientation_coordinates_named(std::string_view name);

/// The rows of analytical_jacobian(): x, y, z, and those of the orientation.
std::vector<std::string> row_names(OrientationCoordinates coordinates);

/// Returns the analytical Jacobian, 6 x dof, or 7 x dof for quaternions: the derivatives of the
/// position of the tool's origin (metres) and of the coordinates of its orientation, both in the
/// world, with respect to q (Siciliano, Sciavicco, Villani, Oriolo, *Robotics*, 2009, section 3.6).
///
/// Throws Error where the coordinates have no derivatives: for roll_pitch_yaw at a pitch of +-90
/// degrees, and as jacobian() does. The rotation vector jumps at an angle of pi, the quaternion at
/// qw = 0; there, the derivatives are those on one side.
Eigen::MatrixXd analytical_jacobian(const Arm& arm, const ConfigurationRef& q,
                                    OrientationCoordinates coordinates);

}  // namespace beeline
