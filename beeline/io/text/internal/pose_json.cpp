#include <array>
#include <cmath>
#include <numbers>

#include <beeline/error.h>
#include <beeline/io/text/internal/json_write.h>
#include <beeline/io/text/internal/pose_json.h>
#include <beeline/io/text/internal/rounded.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {
namespace {

Pose matrix_from_json(const JsonDocument& document, const Json& json) {
  const Json::Items& rows = document.items(json);
  if (rows.size() != 4) document.refuse(json, "must be four rows of four numbers");
  Pose pose = Pose::Identity();
  for (int i = 0; i < 4; ++i) {
    const std::vector<double> row = document.numbers(rows[i], 4);
    for (int j = 0; j < 4; ++j) pose.matrix()(i, j) = row[j];
  }
  const std::string fault = rigid_motion_fault(pose);
  if (!fault.empty()) document.refuse(json, fault);
  return checked_pose(pose);
}

Rotation quaternion_from_json(const JsonDocument& document, const Json& json) {
  document.check_keys(json, {"qw", "qx", "qy", "qz"});
  const auto part = [&](const char* key) { return document.number(document.need(json, key)); };
  const double qw = part("qw"), qx = part("qx"), qy = part("qy"), qz = part("qz");
  try {
    return rotation_from_quaternion(qw, qx, qy, qz);
  } catch (const Error& error) {
    document.refuse(json, std::string("is not a rotation: ") + error.what());
  }
}

/// Roll, pitch and yaw. Close to gimbal lock, where roll_pitch_yaw() returns roll 0, roll is such
/// that the rotation is exact to rounding.
Vector3 exact_rpy(const Rotation& r) {
  constexpr double rounding = 1e-15;
  RollPitchYaw rpy = roll_pitch_yaw(r);
  if ((rotation(rpy) - r).cwiseAbs().maxCoeff() > rounding) {
    rpy.roll = std::atan2(r(2, 1), r(2, 2));
    const Vector3 y = std::cos(rpy.roll) * r.col(1) - std::sin(rpy.roll) * r.col(2);
    rpy.yaw = std::atan2(-y.x(), y.y());
  }
  return {rpy.roll, rpy.pitch, rpy.yaw};
}

}  // namespace

ShortRpy short_rpy(const Rotation& wanted) {
  const Vector3 found = exact_rpy(wanted);
  for (const int digits : readable_digits) {
    const Vector3 rpy = rounded(found, digits);
    if (rotation(RollPitchYaw{rpy.x(), rpy.y(), rpy.z()}) == wanted) return {rpy, true};
  }
  constexpr double rounding = 1e-15;  // rad
  return {rounded((found.array().abs() < rounding).select(Vector3::Zero(), found), 17), false};
}

Vector3 vector_from_json(const JsonDocument& document, const Json& json) {
  const std::vector<double> values = document.numbers(json, 3);
  return {values[0], values[1], values[2]};
}

Pose pose_from_json(const JsonDocument& document, const Json& json) {
  document.check_keys(json, {"xyz", "rpy", "quaternion", "matrix"});
  const Json* xyz = document.find(json, "xyz");
  const Json* rpy = document.find(json, "rpy");
  const Json* quaternion = document.find(json, "quaternion");
  const Json* matrix = document.find(json, "matrix");
  if (matrix != nullptr) {
    if (xyz != nullptr || rpy != nullptr || quaternion != nullptr) {
      document.refuse(json, "has a matrix and another key; a matrix must be the only key");
    }
    return matrix_from_json(document, *matrix);
  }
  if (rpy != nullptr && quaternion != nullptr) {
    document.refuse(json, "has both rpy and quaternion; give one of them");
  }
  Pose pose = Pose::Identity();
  if (xyz != nullptr) pose.translation() = vector_from_json(document, *xyz);
  if (quaternion != nullptr) pose.linear() = quaternion_from_json(document, *quaternion);
  if (rpy != nullptr) {
    const Vector3 angles = vector_from_json(document, *rpy);
    pose.linear() = rotation(RollPitchYaw{angles.x(), angles.y(), angles.z()});
  }
  return pose;
}

Pose shape_pose_from_json(const JsonDocument& document, const Json& json) {
  const Pose pose = pose_from_json(document, json);
  constexpr double most = 4 * std::numbers::pi;
  if (const Json* rpy = document.find(json, "rpy")) {
    const double largest = vector_from_json(document, *rpy).cwiseAbs().maxCoeff();
    if (largest > most) {
      document.refuse(*rpy, "has an angle of " + number(largest) + " rad; at most " + number(most) +
                                ", two revolutions, are accepted: it is in radians");
    }
  }
  return pose;
}

std::string pose_to_json(const Pose& pose) {
  const Vector3 position = pose.translation();
  const std::string xyz = "{\"xyz\": " + json_numbers(position.data(), 3);
  if (pose.linear().isIdentity(0)) return xyz + "}";
  const ShortRpy rpy = short_rpy(pose.linear());
  if (rpy.exact) return xyz + ", \"rpy\": " + json_numbers(rpy.value.data(), 3) + "}";
  std::string text = "{\"matrix\": [";
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector4d row = pose.matrix().row(i);
    text += (i == 0 ? "" : ", ") + json_numbers(row.data(), 4);
  }
  return text + "]}";
}

}  // namespace beeline::internal
