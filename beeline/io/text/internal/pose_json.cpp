#include <array>

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

/// Finds the roll, pitch and yaw with the fewest digits that give exactly this rotation; returns
/// false when no digits do.
bool find_rpy(const Rotation& wanted, Vector3& rpy) {
  const RollPitchYaw exact_rpy = roll_pitch_yaw(wanted);
  const Vector3 found(exact_rpy.roll, exact_rpy.pitch, exact_rpy.yaw);
  for (const int digits : readable_digits) {
    rpy = rounded(found, digits);
    if (rotation(RollPitchYaw{rpy.x(), rpy.y(), rpy.z()}) == wanted) return true;
  }
  return false;
}

}  // namespace

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

std::string pose_to_json(const Pose& pose) {
  const Vector3 position = pose.translation();
  const std::string xyz = "{\"xyz\": " + json_numbers(position.data(), 3);
  if (pose.linear().isIdentity(0)) return xyz + "}";
  Vector3 rpy;
  if (find_rpy(pose.linear(), rpy)) return xyz + ", \"rpy\": " + json_numbers(rpy.data(), 3) + "}";
  std::string text = "{\"matrix\": [";
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector4d row = pose.matrix().row(i);
    text += (i == 0 ? "" : ", ") + json_numbers(row.data(), 4);
  }
  return text + "]}";
}

}  // namespace beeline::internal
