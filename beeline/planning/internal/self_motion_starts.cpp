#include <algorithm>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/levenberg_marquardt_lanes.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/inverse/numerical/seed_table.h>
#include <beeline/planning/internal/self_motion_starts.h>

namespace beeline::internal {
namespace {

using Node = RedundantConfiguration;

/// Solutions of damped least squares from random configurations within the bounds of `problem`,
/// which it ignores.
std::vector<Configuration> random_solutions(const Arm& arm, const Task& task, const Pose& pose,
                                            BudgetMeter& budget) {
  constexpr int blocks = 32;  // of eight starts: each of some ten manifolds attracts several
  const NumericalProblem limited = numerical_problem(arm, task, bounds_of(arm));
  const NumericalProblem free = numerical_problem(arm, task, no_bounds(arm));
  Splitmix random(1);
  LevenbergMarquardtLanes lanes;
  Eigen::MatrixXd starts(arm.dof(), solver_lane_count);
  std::vector<Configuration> solutions;
  for (int block = 0; block < blocks && !budget.ended(solver_lane_count); ++block) {
    for (int i = 0; i < solver_lane_count; ++i) {
      draw_configuration(limited, 1, random, starts.col(i).data());
    }
    levenberg_marquardt_lanes(free, pose, starts,
                              {.tolerance = 1e-7, .max_iterations = 40, .polish = false}, lanes);
    for (int i = 0; i < solver_lane_count; ++i) {
      if ((lanes.converged >> i & 1) == 0) continue;
      Configuration& q = solutions.emplace_back(arm.dof());
      lane_configuration(free, lanes, i, q.data());
    }
  }
  return solutions;
}

/// Returns solutions without limits, on a grid and at random.
std::vector<Configuration> unlimited_solutions(const Arm& arm, const Task& task, const Pose& pose,
                                               BudgetMeter& budget) {
  constexpr int grid = 64;
  std::vector<Configuration> solutions =
      inverse_kinematics(arm, pose,
                         {.task = task,
                          .method = method_for_few_poses(arm, task),
                          .all = true,
                          .ignore_limits = true,
                          .grid = grid,
                          .max_restarts = grid,
                          .budget = budget.part()})
          .solutions;
  const auto more = random_solutions(arm, task, pose, budget);
  solutions.insert(solutions.end(), more.begin(), more.end());
  return solutions;
}

/// Adds the nodes within the bounds, in all their representatives, of a curve without limits; and
/// configurations between nodes outside, where the margin has a maximum.
void add_inside(const Arm& arm, const Pose& pose, const SelfMotion& unlimited,
                const SelfMotionCurve& curve, SelfMotion& motion, std::vector<Node>& starts) {
  constexpr double nearly = 0.2;  // a negative margin next to which there may be a short curve
  const Configuration middle = middle_configuration(arm);
  const std::vector<Node>& nodes = curve.nodes;
  std::vector<Configuration> postures;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    postures.push_back(
        nearest_representative(arm, Configuration(nodes[i]), middle, motion.bounds()));
    const Node q = postures.back();
    const double margin = motion.margin(q);
    if (margin >= 0 || margin < -nearly) continue;
    const auto exceeds = [&](std::size_t k) {
      return motion.margin(q + unlimited.difference(nodes[k % nodes.size()], nodes[i])) > margin;
    };
    if (exceeds(i + 1) || exceeds(i + nodes.size() - 1)) continue;
    const auto inside = motion.move_inside(pose, q, motion.step());
    if (inside) postures.emplace_back(*inside);
  }
  for (const Configuration& q : every_representative(arm, postures, motion.bounds())) {
    if (within(motion.bounds(), q)) starts.emplace_back(q);
  }
}

}  // namespace

InverseMethod method_for_few_poses(const Arm& arm, const Task& task) {
  const bool redundant = arm.dof() > task.size();
  return redundant && !has_closed_form(arm, {.task = task}) ? InverseMethod::numerical
                                                            : InverseMethod::automatic;
}

std::vector<Node> self_motion_starts(const Arm& arm, const Task& task, const Pose& pose,
                                     SelfMotion& motion, BudgetMeter& budget) {
  std::vector<bool> periodic;
  for (int k = 0; k < arm.dof(); ++k) periodic.push_back(arm.periodic(k));
  SelfMotion unlimited(arm, task, motion.bounds(), periodic, 2 * motion.step());
  std::vector<SelfMotionCurve> curves;
  std::vector<Node> starts;
  for (const Configuration& solution : unlimited_solutions(arm, task, pose, budget)) {
    if (budget.ended()) break;
    const Node q = solution;
    const auto passed = [&](const SelfMotionCurve& curve) {
      return passes(unlimited, curve, q, 0.2 * unlimited.step());
    };
    if (std::any_of(curves.begin(), curves.end(), passed)) continue;
    curves.push_back(unlimited.unlimited_curve_through(pose, q));
    add_inside(arm, pose, unlimited, curves.back(), motion, starts);
  }
  return starts;
}

}  // namespace beeline::internal
