#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/formula/internal/dimensions.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {
namespace {

/// Returns yaw, pitch and roll for a pitch of 90 degrees up to rounding; roll is then 0.
std::vector<AxisRotation> gimbal_locked(const Rotation& r) {
  const double yaw = std::atan2(-r(0, 1), r(1, 1));
  return {{2, yaw}, {1, std::copysign(std::numbers::pi / 2, -r(2, 0))}};
}

std::vector<AxisRotation> euler_rotations(const Rotation& r, int first, int middle, int last) {
  const Vector3 angles = r.eulerAngles(first, middle, last);
  return {{first, angles[0]}, {middle, angles[1]}, {last, angles[2]}};
}

/// Replaces angles near exact ones by them, and omits zeros.
std::vector<AxisRotation> snapped(const std::vector<AxisRotation>& rotations, double tolerance) {
  std::vector<AxisRotation> result;
  for (AxisRotation rotation : rotations) {
    const std::optional<int> exact = multiple_of_15_degrees(rotation.angle, tolerance);
    if (exact) rotation.angle = *exact * std::numbers::pi / 12;
    if (!exact || *exact % 24 != 0) result.push_back(rotation);
  }
  return result;
}

int cost(const std::vector<AxisRotation>& rotations, int before, int after, double tolerance) {
  int sum = 0;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    const bool exact = multiple_of_15_degrees(rotations[i].angle, tolerance).has_value();
    const bool joins_neighbour = (i == 0 && rotations[i].axis == before) ||
                                 (i + 1 == rotations.size() && rotations[i].axis == after);
    sum += exact ? 1 : joins_neighbour ? 10 : 100;
  }
  return sum;
}

}  // namespace

Rotation product(const std::vector<AxisRotation>& rotations) {
  Rotation result = Rotation::Identity();
  for (const AxisRotation& rotation : rotations) {
    result = result * Eigen::AngleAxisd(rotation.angle, Vector3::Unit(rotation.axis));
  }
  return result;
}

std::optional<int> multiple_of_15_degrees(double angle, double tolerance) {
  const double step = std::numbers::pi / 12;
  const double multiple = std::round(angle / step);
  if (!(std::abs(angle - multiple * step) <= tolerance)) return std::nullopt;
  return static_cast<int>(multiple);
}

std::optional<DhRow> planar_row(const Joint& joint, double tolerance, double unit) {
  if (kind(joint) == JointKind::revolute) {
    const std::optional<DhRow> row = dh_row(joint, DhConvention::standard, tolerance, unit);
    const bool flat = row && std::abs(row->alpha) <= tolerance && row->d == 0;
    return flat ? row : std::nullopt;
  }
  if (kind(joint) != JointKind::prismatic) return std::nullopt;
  DhRow row{.kind = JointKind::prismatic};
  const Vector3 t = joint.offset.translation();
  row.theta = std::atan2(joint.offset.linear()(1, 0), joint.offset.linear()(0, 0));
  row.a = t.x() * std::cos(row.theta) + t.y() * std::sin(row.theta);
  Joint link;
  link.offset = make_pose(row.a * Vector3(std::cos(row.theta), std::sin(row.theta), 0),
                          product({{2, row.theta}}));
  link.screw = translation_screw(Vector3::UnitX());
  if (!same_joint(joint, link, tolerance, unit)) return std::nullopt;
  return row;
}

std::vector<AxisRotation> axis_rotations(const Rotation& rotation, int before, int after,
                                         double tolerance) {
  const RollPitchYaw rpy = roll_pitch_yaw(rotation);
  std::vector<std::vector<AxisRotation>> candidates{gimbal_locked(rotation),
                                                    {{2, rpy.yaw}, {1, rpy.pitch}, {0, rpy.roll}}};
  for (int middle = 0; middle < 3; ++middle) {
    if (middle == before || middle == after) continue;
    candidates.push_back(euler_rotations(rotation, before, middle, after));
  }
  std::vector<AxisRotation> best = candidates[1];
  int least = 1000;
  for (const std::vector<AxisRotation>& candidate : candidates) {
    const std::vector<AxisRotation> rotations = snapped(candidate, tolerance);
    const double difference = (product(rotations) - rotation).cwiseAbs().maxCoeff();
    const int candidate_cost = cost(rotations, before, after, tolerance);
    if (difference > 3 * tolerance + 1e-14 || candidate_cost >= least) continue;
    best = rotations;
    least = candidate_cost;
  }
  return best;
}

}  // namespace beeline::internal
