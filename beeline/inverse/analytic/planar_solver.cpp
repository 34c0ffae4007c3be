#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/inverse/analytic/planar_solver.h>
#include <beeline/kinematics/forward.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {
namespace {

using Complex = std::complex<double>;

Complex in_plane(const Vector3& v) { return {v.x(), v.y()}; }

/// Returns the angle of the rotation about z that leaves the smallest remaining rotation
/// (swing-twist decomposition). For a tilted pose it is the heading with zero task_error().
double heading(const Rotation& rotation) {
  const Quaternion q = quaternion(rotation);
  return 2 * std::atan2(q.qz, q.qw);
}

/// Whether the position in the plane counts alone, with or without its height.
bool is_position(const Task& task) {
  return task == Task::position() || task == Task{{true, true, false, false, false, false}};
}

/// Returns the arm's joints as motions of the world's xy plane at q = 0.
std::vector<PlanarJoint> planar_joints(const Arm& arm, const Configuration& seed) {
  const std::vector<Pose> world_T_link = link_poses(arm, Configuration::Zero(arm.dof()));
  std::vector<PlanarJoint> joints;
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    const Twist screw = adjoint(world_T_link[i + 1], arm.joints()[i].screw);
    PlanarJoint joint;
    joint.revolute = kind(arm.joints()[i]) != JointKind::prismatic;
    joint.preferred = seed[static_cast<Eigen::Index>(i)];
    joint.axis = in_plane(screw.head<3>());
    if (joint.revolute) {
      joint.sign = screw[5] < 0 ? -1 : 1;
      joint.axis *= Complex(0, joint.sign);  // the fixed point: v + i w axis = 0
    }
    joints.push_back(joint);
  }
  return joints;
}

/// Returns the candidates with their errors.
std::vector<PlanarSolution> candidates_near(const Arm& arm, const Pose& world_T_tool,
                                            const Task& task, const Configuration& seed) {
  std::vector<PlanarJoint> joints = planar_joints(arm, seed);
  const Pose at_zero = forward_kinematics(arm, Configuration::Zero(arm.dof()));
  const Complex from = in_plane(at_zero.translation()), to = in_plane(world_T_tool.translation());
  double angle = heading(world_T_tool.linear()) - heading(at_zero.linear());
  if (is_position(task)) {
    // A virtual revolute joint at the tool's origin reaches any orientation.
    joints.push_back({.revolute = true, .sign = 1, .axis = from});
    angle = 0;
  }
  const Complex rotation = std::polar(1.0, angle);
  std::vector<PlanarSolution> solutions;
  for (PlanarCandidate& candidate : planar_candidates(joints, rotation, to - rotation * from)) {
    candidate.q.conservativeResize(arm.dof());
    const Pose reached = forward_kinematics(arm, candidate.q);
    solutions.push_back(
        {candidate.q, candidate.continuum, task_deviation(task, world_T_tool, reached)});
  }
  return solutions;
}

}  // namespace

bool has_planar_closed_form(const Arm& arm, const Task& task) {
  const bool mimics = static_cast<std::size_t>(arm.dof()) != arm.joints().size();
  if (!arm.planar() || mimics) return false;
  return (task == Task::planar() && arm.dof() <= 3) || (is_position(task) && arm.dof() <= 2);
}

std::vector<PlanarSolution> nearest_planar_solutions(const Arm& arm, const Pose& world_T_tool,
                                                     const Task& task, const Configuration& seed,
                                                     double tolerance) {
  if (!has_planar_closed_form(arm, task)) {
    throw Error("arm " + arm.name() + " has no planar closed form for the task " + name(task) +
                "; it takes a planar arm of one to three joints (position: one or two)");
  }
  check_configuration(arm, seed);
  if (!world_T_tool.matrix().allFinite()) throw Error("the pose has an entry that is not finite");
  // An arm counts as planar when its axes are parallel to 1e-9, which over long links can leave an
  // error above the tolerance.
  const double near = 1000 * tolerance;
  const auto reaches = [near](const PlanarSolution& solution) {
    return std::max(solution.error.position, solution.error.orientation) <= near;
  };
  std::vector<PlanarSolution> near_seed = candidates_near(arm, world_T_tool, task, seed);
  if (std::any_of(near_seed.begin(), near_seed.end(), reaches)) return near_seed;
  // Angles near a distant seed have fewer digits. A pose counts as out of reach only if it is also
  // out of reach with angles near zero.
  return candidates_near(arm, world_T_tool, task, Configuration::Zero(arm.dof()));
}

}  // namespace beeline::internal
