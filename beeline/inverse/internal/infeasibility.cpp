#include <algorithm>
#include <cmath>
#include <vector>

#include <beeline/error.h>
#include <beeline/inverse/internal/infeasibility.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/mask.h>
#include <beeline/math/minimum_norm.h>

namespace beeline::internal {
namespace {

/// Max sine of the angle between axes that count as parallel: a few roundings of a product of
/// rotations. Its effect over the length of the arm is added to the tolerance, so that
/// infeasibility remains proved.
constexpr double parallel = 1e-12;

bool rows(const Task& task, std::size_t first) {
  return task.rows[first] && task.rows[first + 1] && task.rows[first + 2];
}

/// Returns the screws of the joints that can move, in the world at q = 0.
std::vector<Twist> screws(const Arm& arm) {
  const std::vector<Pose> world_T_link = link_poses(arm, Configuration::Zero(arm.dof()));
  std::vector<Twist> all;
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    if (arm.couplings()[i].ratio == 0) continue;
    all.push_back(adjoint(world_T_link[i + 1], arm.joints()[i].screw));
  }
  return all;
}

bool rotates(const Twist& screw) { return !screw.tail<3>().isZero(0); }

/// Checks the invariants of an arm whose joint axes are all parallel to `axis`. No joint changes
/// the tilt relative to the axis, and none changes the height unless one moves along the axis.
std::optional<Infeasibility> against_parallel_axes(const Arm& arm, const Vector3& axis,
                                                   const std::vector<Twist>& motions,
                                                   const Pose& goal, const Task& task,
                                                   double tolerance) {
  const Pose at_zero = forward_kinematics(arm, Configuration::Zero(arm.dof()));
  const Vector3 constant = at_zero.linear().transpose() * axis;  // the axis in the tool's frame
  const Vector3 local = task.frame == Frame::tool ? constant : axis;
  const bool about_z = local.head<2>().norm() < parallel;
  const Vector3 requested = goal.linear().transpose() * axis;
  const double tilt = std::atan2(constant.cross(requested).norm(), constant.dot(requested));
  const double skew = 2 * parallel * static_cast<double>(motions.size());
  if (tilt > tolerance + skew && (rows(task, 3) || (about_z && task.rows[3] && task.rows[4]))) {
    return Infeasibility{tilt,
                         true,
                         {ReasonCode::tilted_off_axes,
                          {{ReasonField::angle, tilt}, {ReasonField::arm, arm.name()}}}};
  }
  const bool moves_along = std::any_of(
      motions.begin(), motions.end(),
      [&axis](const Twist& motion) { return std::abs(motion.head<3>().dot(axis)) > parallel; });
  const double off = std::abs(axis.dot(goal.translation() - at_zero.translation()));
  const double offset = (goal.translation() - at_zero.translation()).norm();
  const double size = std::isfinite(arm.reach().radius) ? arm.reach().radius : offset;
  if (!moves_along && off > tolerance + skew * size &&
      (rows(task, 0) || (about_z && task.rows[2]))) {
    return Infeasibility{
        off,
        false,
        {ReasonCode::off_plane, {{ReasonField::distance, off}, {ReasonField::arm, arm.name()}}}};
  }
  return std::nullopt;
}

/// Checks the invariants of an arm of prismatic joints: the orientation is constant, and the
/// position is linear in q.
std::optional<Infeasibility> against_slides(const Arm& arm, const std::vector<Twist>& motions,
                                            const Pose& goal, const Task& task, double tolerance) {
  const Pose at_zero = forward_kinematics(arm, Configuration::Zero(arm.dof()));
  const double orientation = task_deviation(task, goal, at_zero).orientation;
  if (orientation > tolerance) {
    return Infeasibility{orientation,
                         true,
                         {ReasonCode::fixed_orientation,
                          {{ReasonField::angle, orientation}, {ReasonField::arm, arm.name()}}}};
  }
  const Rotation axes =
      task.frame == Frame::tool ? Rotation(at_zero.linear().transpose()) : Rotation::Identity();
  Eigen::Matrix3Xd directions(3, motions.size());
  for (std::size_t i = 0; i < motions.size(); ++i) {
    directions.col(static_cast<Eigen::Index>(i)) = axes * motions[i].head<3>();
  }
  const Vector3 offset = masked_position(task, axes * (goal.translation() - at_zero.translation()));
  for (int i = 0; i < 3; ++i) {
    if (!task.rows[i]) directions.row(i).setZero();
  }
  // Prismatic joints at an angle below 2 `parallel` span a line: the ratio of singular values is
  // the tangent of half the angle.
  const double off =
      (directions * minimum_norm_solution(directions, offset, parallel).x - offset).norm();
  if (off <= tolerance) return std::nullopt;
  return Infeasibility{
      off,
      false,
      {ReasonCode::off_slides, {{ReasonField::distance, off}, {ReasonField::arm, arm.name()}}}};
}

}  // namespace

std::optional<Infeasibility> invariant_violation(const Arm& arm, const Pose& world_T_tool,
                                                 const Task& task, double tolerance) {
  const std::vector<Twist> motions = screws(arm);
  const auto first = std::find_if(motions.begin(), motions.end(), rotates);
  if (first == motions.end()) {
    return against_slides(arm, motions, world_T_tool, task, tolerance);
  }
  const Vector3 axis = first->tail<3>();
  for (const Twist& motion : motions) {
    if (axis.cross(motion.tail<3>()).norm() > parallel) return std::nullopt;
  }
  return against_parallel_axes(arm, axis, motions, world_T_tool, task, tolerance);
}

}  // namespace beeline::internal
