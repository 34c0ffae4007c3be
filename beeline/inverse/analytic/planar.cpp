#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/inverse/analytic/planar.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/forward.h>
#include <beeline/pose/orientation.h>

namespace beeline {
namespace {

using Complex = std::complex<double>;

Complex in_plane(const Vector3& v) { return {v.x(), v.y()}; }

/// The turn about z in a rotation, in half: what is left without it is the shortest tilt. For a
/// tilted pose this is the heading that task_error() calls right.
double heading(const Rotation& rotation) {
  const Quaternion q = quaternion(rotation);
  return 2 * std::atan2(q.qz, q.qw);
}

/// The arm's joints as motions of the world's plane at q = 0.
std::vector<PlanarJoint> planar_joints(const Arm& arm, const Configuration& seed) {
  const std::vector<Pose> world_T_link = link_poses(arm, Configuration::Zero(arm.dof()));
  std::vector<PlanarJoint> joints;
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    const Twist screw = adjoint(world_T_link[i + 1], arm.joints()[i].screw);
    PlanarJoint joint;
    joint.turns = kind(arm.joints()[i]) != JointKind::prismatic;
    joint.preferred = seed[static_cast<Eigen::Index>(i)];
    joint.place = in_plane(screw.head<3>());
    if (joint.turns) {
      joint.sign = screw[5] < 0 ? -1 : 1;
      joint.place *= Complex(0, joint.sign);  // the point that stays: v + i w place = 0
    }
    joints.push_back(joint);
  }
  return joints;
}

double largest(const Deviation& error) { return std::max(error.position, error.orientation); }

/// An arm counts as planar when its axes are parallel to 1e-9: over long links that can leave more
/// than the tolerance, which a few steps of descent mend.
void polish(const Arm& arm, const Pose& world_T_tool, const Task& task, double tolerance,
            PlanarSolution& solution) {
  if (largest(solution.error) <= tolerance || largest(solution.error) > 1000 * tolerance) return;
  const internal::NumericalResult run =
      internal::levenberg_marquardt(arm, world_T_tool, task, internal::no_bounds(arm), solution.q,
                                    {.tolerance = tolerance, .iterations = 5});
  if (!run.converged) return;
  solution.q = run.q;
  solution.error = run.error;
}

std::vector<PlanarSolution> measured(const Arm& arm, const Pose& world_T_tool, const Task& task,
                                     const Configuration& seed, double tolerance) {
  std::vector<PlanarJoint> joints = planar_joints(arm, seed);
  const Pose rest = forward_kinematics(arm, Configuration::Zero(arm.dof()));
  const Complex from = in_plane(rest.translation()), to = in_plane(world_T_tool.translation());
  double turn = heading(world_T_tool.linear()) - heading(rest.linear());
  if (task == Task::position()) {
    // One more joint, which turns the tool about its own origin, makes every orientation right.
    joints.push_back({.turns = true, .sign = 1, .place = from});
    turn = 0;
  }
  const Complex rotation = std::polar(1.0, turn);
  std::vector<PlanarSolution> solutions;
  for (PlanarCandidate& candidate : planar_candidates(joints, rotation, to - rotation * from)) {
    candidate.q.conservativeResize(arm.dof());
    const Pose reached = forward_kinematics(arm, candidate.q);
    PlanarSolution solution{candidate.q, candidate.continuum,
                            task_deviation(task, world_T_tool, reached)};
    polish(arm, world_T_tool, task, tolerance, solution);
    solutions.push_back(solution);
  }
  return solutions;
}

}  // namespace

bool has_planar_closed_form(const Arm& arm, const Task& task) {
  const bool mimics = static_cast<std::size_t>(arm.dof()) != arm.joints().size();
  if (!arm.planar() || mimics) return false;
  const Task point{{true, true, false, false, false, false}};
  const bool position = task == Task::position() || task == point;
  return (task == Task::planar() && arm.dof() <= 3) || (position && arm.dof() <= 2);
}

std::vector<PlanarSolution> nearest_planar_solutions(const Arm& arm, const Pose& world_T_tool,
                                                     const Task& task, const Configuration& seed,
                                                     double tolerance) {
  if (!has_planar_closed_form(arm, task)) {
    throw Error("arm " + arm.name() + " has no planar closed form for the task " + name(task) +
                "; it takes a planar arm of one to three joints (position: one or two)");
  }
  check_configuration(arm, seed);
  if (!world_T_tool.matrix().allFinite()) throw Error("the pose has a number that is not finite");
  const auto reaches = [tolerance](const PlanarSolution& solution) {
    return largest(solution.error) <= tolerance;
  };
  std::vector<PlanarSolution> near_seed = measured(arm, world_T_tool, task, seed, tolerance);
  if (std::any_of(near_seed.begin(), near_seed.end(), reaches)) return near_seed;
  // A seed far away costs digits. That a pose is out of reach must not hang on them.
  return measured(arm, world_T_tool, task, Configuration::Zero(arm.dof()), tolerance);
}

std::vector<Configuration> planar_solutions(const Arm& arm, const Pose& world_T_tool,
                                            const Task& task, const Configuration& seed,
                                            double tolerance) {
  std::vector<Configuration> within;
  for (const PlanarSolution& solution :
       nearest_planar_solutions(arm, world_T_tool, task, seed, tolerance)) {
    if (largest(solution.error) <= tolerance) within.push_back(solution.q);
  }
  return within;
}

}  // namespace beeline
