#include <cmath>
#include <ostream>

#include <beeline/error.h>
#include <beeline/pose/orientation.h>

namespace beeline {

Rotation rotation(const RollPitchYaw& rpy) {
  return (Eigen::AngleAxisd(rpy.yaw, Vector3::UnitZ()) *
          Eigen::AngleAxisd(rpy.pitch, Vector3::UnitY()) *
          Eigen::AngleAxisd(rpy.roll, Vector3::UnitX()))
      .toRotationMatrix();
}

RollPitchYaw roll_pitch_yaw(const Rotation& r) {
  const double cos_pitch = std::hypot(r(0, 0), r(1, 0));
  const double pitch = std::atan2(-r(2, 0), cos_pitch);
  const double roll = cos_pitch < 1e-12 ? 0 : std::atan2(r(2, 1), r(2, 2));
  // Yaw comes from the y axis of Rz(yaw) Ry(pitch), not from the x axis: near gimbal lock it then
  // compensates the rounding error of roll.
  const Vector3 y = std::cos(roll) * r.col(1) - std::sin(roll) * r.col(2);
  return {roll, pitch, std::atan2(-y.x(), y.y())};
}

Rotation rotation_from_quaternion(double qw, double qx, double qy, double qz) {
  const Eigen::Quaterniond q(qw, qx, qy, qz);
  const double length = q.norm();
  if (!(std::abs(length - 1) <= 1e-3)) {
    throw Error("quaternion qw,qx,qy,qz = " + number(qw) + "," + number(qx) + "," + number(qy) +
                "," + number(qz) + " has length " + number(length) + "; it must be 1");
  }
  return q.normalized().toRotationMatrix();
}

Quaternion quaternion(const Rotation& rotation) {
  const Eigen::Quaterniond q = Eigen::Quaterniond(rotation).normalized();
  const double sign = q.w() < 0 ? -1 : 1;
  return {sign * q.w(), sign * q.x(), sign * q.y(), sign * q.z()};
}

std::ostream& operator<<(std::ostream& out, const Pose& pose) {
  const auto shown = [](double value) { return number(std::abs(value) < 1e-12 ? 0 : value); };
  const Vector3 p = pose.translation();
  const RollPitchYaw rpy = roll_pitch_yaw(pose.linear());
  return out << "x " << shown(p.x()) << ", y " << shown(p.y()) << ", z " << shown(p.z())
             << " m, roll " << shown(rpy.roll) << ", pitch " << shown(rpy.pitch) << ", yaw "
             << shown(rpy.yaw) << " rad";
}

Pose make_pose(const Vector3& position, const Rotation& rotation) {
  Pose pose = Pose::Identity();
  pose.translation() = position;
  pose.linear() = rotation;
  return pose;
}

}  // namespace beeline
