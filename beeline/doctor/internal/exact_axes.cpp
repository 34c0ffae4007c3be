#include <algorithm>
#include <cmath>

#include <beeline/doctor/internal/exact_axes.h>
#include <beeline/doctor/internal/link_table.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {
namespace {

constexpr double max_angle = 2e-3;     // rad: 1.57 for pi/2 is 8e-4 off, 3.14 for pi 1.6e-3
constexpr double max_distance = 5e-5;  // metres

/// The direction made exactly parallel or perpendicular to the one before.
Vector3 exact_direction(const Vector3& before, const Vector3& direction) {
  const double cosine = before.dot(direction);
  if (std::abs(cosine) < std::sin(max_angle)) return (direction - cosine * before).normalized();
  if (before.cross(direction).norm() < std::sin(max_angle)) return cosine < 0 ? -before : before;
  return direction;
}

/// Where the common normal of two axes meets the first one; the vector from there to the second.
struct Normal {
  Vector3 foot, vector;
};
Normal common_normal(const JointLine& a, const JointLine& b) {
  const Vector3 cross = a.direction.cross(b.direction);
  const Vector3 between = b.point - a.point;
  const double along = between.cross(b.direction).dot(cross) / cross.squaredNorm();
  return {a.point + along * a.direction, between.dot(cross) / cross.squaredNorm() * cross};
}

}  // namespace

ExactAxes with_exact_axes(const Arm& arm) {
  const std::vector<JointLine> given = joint_lines(arm);
  std::vector<JointLine> lines = given;
  double angle = 0, distance = 0;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    JointLine& line = lines[i];
    const JointLine& before = lines[i - 1];
    line.direction = exact_direction(before.direction, given[i].direction);
    const double turned = given[i].direction.cross(line.direction).norm();
    if (turned > 1e-10) angle = std::max(angle, turned);
    if (line.kind == JointKind::prismatic || before.kind == JointKind::prismatic) continue;
    if (before.direction.cross(line.direction).norm() < 1e-3) continue;
    Normal normal = common_normal(before, line);
    if (normal.vector.norm() > max_distance) continue;
    if (normal.vector.norm() > 1e-10) distance = std::max(distance, normal.vector.norm());
    line.point -= normal.vector;
    if (i < 2 || lines[i - 2].direction.cross(before.direction).norm() < 1e-3) continue;
    const Normal earlier = common_normal(lines[i - 2], before);
    if (earlier.vector.norm() > 1e-9) continue;
    const Vector3 apart = earlier.foot + earlier.vector - normal.foot;  // along the axis before
    if (apart.norm() > max_distance) continue;
    if (apart.norm() > 1e-10) distance = std::max(distance, apart.norm());
    line.point += apart;
  }
  const Pose tool = forward_kinematics(arm, Configuration::Zero(arm.dof()));
  return {arm_along(lines, tool, arm), angle, distance};
}

}  // namespace beeline::internal
