#include <cmath>

#include <beeline/internal/enum_names.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/pose/se3.h>

namespace beeline {
namespace {

constexpr internal::EnumNames<OrientationCoordinates> coordinate_names(
    "orientation coordinates", "rpy quaternion rotation-vector");

/// The matrix that maps the angular velocity in the world's axes to roll', pitch', yaw'.
Eigen::Matrix3d rates_of(const RollPitchYaw& rpy) {
  constexpr double singular = 1e-12;  // cosine of the pitch
  const double cp = std::cos(rpy.pitch), sp = std::sin(rpy.pitch);
  const double cy = std::cos(rpy.yaw), sy = std::sin(rpy.yaw);
  if (std::abs(cp) < singular) {
    throw Error(
        "at a pitch of +-90 degrees roll and yaw have no derivatives; take the quaternion or the "
        "rotation vector");
  }
  Eigen::Matrix3d rates;
  rates << cy / cp, sy / cp, 0,  //
      -sy, cy, 0,                //
      cy * sp / cp, sy * sp / cp, 1;
  return rates;
}

/// The matrix that maps the angular velocity in the world's axes to qw', qx', qy', qz'.
Eigen::Matrix<double, 4, 3> rates_of(const Quaternion& q) {
  Eigen::Matrix<double, 4, 3> rates;
  rates << -q.qx, -q.qy, -q.qz,  //
      q.qw, q.qz, -q.qy,         //
      -q.qz, q.qw, q.qx,         //
      q.qy, -q.qx, q.qw;
  return rates / 2;
}

}  // namespace

std::string name(OrientationCoordinates value) { return coordinate_names.of(value); }

std::vector<std::string> orientation_coordinates_names() { return coordinate_names.all(); }

OrientationCoordinates orientation_coordinates_named(std::string_view name) {
  return coordinate_names.named(name);
}

std::vector<std::string> row_names(OrientationCoordinates coordinates) {
  switch (coordinates) {
    case OrientationCoordinates::roll_pitch_yaw:
      return {"x", "y", "z", "roll", "pitch", "yaw"};
    case OrientationCoordinates::quaternion:
      return {"x", "y", "z", "qw", "qx", "qy", "qz"};
    case OrientationCoordinates::rotation_vector:
      return {"x", "y", "z", "rx", "ry", "rz"};
  }
  return {};
}

Eigen::MatrixXd analytical_jacobian(const Arm& arm, const ConfigurationRef& q,
                                    OrientationCoordinates coordinates) {
  Jacobian columns(6, arm.dof());
  const Rotation orientation = jacobian(arm, q, columns).linear();
  const auto with = [&](const auto& rates) {
    Eigen::MatrixXd rows(3 + rates.rows(), arm.dof());
    rows << columns.topRows<3>(), rates * columns.bottomRows<3>();
    return rows;
  };
  switch (coordinates) {
    case OrientationCoordinates::roll_pitch_yaw:
      return with(rates_of(roll_pitch_yaw(orientation)));
    case OrientationCoordinates::quaternion:
      return with(rates_of(quaternion(orientation)));
    case OrientationCoordinates::rotation_vector:
      return with(so3_left_jacobian_inverse(so3_log(orientation)));
  }
  return {};
}

}  // namespace beeline
