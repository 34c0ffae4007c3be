#include <cmath>
#include <ostream>

#include <beeline/error.h>
#include <beeline/pose/se3.h>

namespace beeline {
namespace {

/// The largest element of |R R^T - I|.
double orthonormality_error(const Rotation& r) {
  return (r * r.transpose() - Rotation::Identity()).cwiseAbs().maxCoeff();
}

/// Whether a matrix with this orthonormality error is a rotation.
bool is_rotation(const Rotation& r, double error) {
  constexpr double rounding_of_text = 1e-6;
  return error <= rounding_of_text && r.determinant() > 0;
}

/// Returns the fault of a pose whose rotation has this orthonormality error; nullptr if there is
/// none.
const char* fault_of(const Pose& pose, double error) {
  constexpr double farthest = 1e100;
  if (!pose.matrix().allFinite()) return "has a number that is not finite";
  if (pose.translation().cwiseAbs().maxCoeff() > farthest) return "has a length above 1e100 m";
  if (!is_rotation(pose.linear(), error)) {
    return "is not a rigid motion: its rotation must be orthonormal and right-handed";
  }
  if (pose.matrix().row(3) != Eigen::RowVector4d(0, 0, 0, 1)) {
    return "is not a rigid motion: its last row must be 0 0 0 1";
  }
  return nullptr;
}

}  // namespace

std::string rigid_motion_fault(const Pose& pose) {
  const double error = orthonormality_error(pose.linear());
  const char* fault = fault_of(pose, error);
  if (fault == nullptr) return "";
  if (!pose.matrix().allFinite() || is_rotation(pose.linear(), error)) return fault;
  return fault + ("; R R^T differs from the identity by " + number(error) +
                  ", the determinant is " + number(pose.linear().determinant()));
}

Pose checked_pose(const Pose& pose, const char* what) {
  constexpr double exact = 1e-14;
  const double error = orthonormality_error(pose.linear());
  if (fault_of(pose, error) != nullptr) throw Error(what + (" " + rigid_motion_fault(pose)));
  if (error <= exact) return pose;
  Pose rigid = pose;
  rigid.linear() = Eigen::Quaterniond(pose.linear()).normalized().toRotationMatrix();
  return rigid;
}

Pose checked_pose(const Pose& pose, const std::string& what) {
  return checked_pose(pose, what.c_str());
}

Pose se3_exp(const Twist& twist) {
  const Vector3 w = twist.tail<3>();
  Pose pose = Pose::Identity();
  pose.linear() = so3_exp(w);
  pose.translation() = so3_left_jacobian(w) * twist.head<3>();
  return pose;
}

Twist se3_log(const Pose& pose) {
  const Vector3 w = so3_log(pose.linear());
  Twist twist;
  twist << so3_left_jacobian_inverse(w) * pose.translation(), w;
  return twist;
}

Matrix6 adjoint(const Pose& pose) {
  Matrix6 matrix;
  matrix << pose.linear(), hat(pose.translation()) * pose.linear(), Eigen::Matrix3d::Zero(),
      pose.linear();
  return matrix;
}

Twist adjoint(const Pose& pose, const Twist& twist) {
  Twist moved;
  moved.tail<3>() = pose.linear() * twist.tail<3>();
  moved.head<3>() = pose.linear() * twist.head<3>() + pose.translation().cross(moved.tail<3>());
  return moved;
}

Pose interpolate(const Pose& from, const Pose& to, double s) {
  const Twist difference = pose_difference(to, from);
  Pose pose = Pose::Identity();
  pose.translation() = from.translation() + s * difference.head<3>();
  pose.linear() = so3_exp(s * difference.tail<3>()) * from.linear();
  return pose;
}

Twist pose_difference(const Pose& to, const Pose& from) {
  Twist difference;
  difference << to.translation() - from.translation(),
      so3_log(to.linear() * from.linear().transpose());
  return difference;
}

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

void internal::aligns_eigen_as_the_library(CompiledAlignment) {}

}  // namespace beeline
