#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <beeline/inverse/internal/analytic_families.h>
#include <beeline/inverse/internal/analytic_family.h>
#include <beeline/inverse/internal/candidate_solutions.h>
#include <beeline/inverse/internal/joint_lock.h>
#include <beeline/inverse/internal/redundant_joint.h>
#include <beeline/inverse/internal/stages.h>
#include <beeline/inverse/numerical/seed_table.h>
#include <beeline/kinematics/jacobian.h>

namespace beeline::internal {
namespace {

/// Returns the joint that moves most in self-motion, so that each solution continues to other
/// values of it. Component k of the null vector of the Jacobian J is, up to its sign, the
/// determinant of J without column k. Compares the lower quartiles over random configurations: the
/// elbow of a shoulder-elbow-wrist arm does not move.
int redundant_joint(const Arm& arm) {
  constexpr int trials = 32;
  Splitmix random(1);
  Eigen::Matrix<double, 7, trials> moved;
  Configuration q(7);
  for (int trial = 0; trial < trials; ++trial) {
    for (double& value : q) value = std::numbers::pi * (2 * random.next() - 1);
    const Eigen::FullPivLU<Eigen::MatrixXd> decomposition(jacobian(arm, q));
    moved.col(trial) = decomposition.kernel().col(0).normalized().cwiseAbs();
  }
  int best = 0;
  double largest = 0;
  for (int k = 0; k < 7; ++k) {
    Eigen::Matrix<double, 1, trials> row = moved.row(k);
    std::nth_element(row.begin(), row.begin() + trials / 4, row.end());
    if (row[trials / 4] <= largest) continue;
    largest = row[trials / 4];
    best = k;
  }
  return best;
}

bool applies_locked_joint(SolverState& state) {
  const Arm& arm = state.arm;
  const InverseOptions& options = state.options;
  constexpr int finest = 256;  // a value takes some milliseconds to prepare
  const bool wanted =
      options.grid <= finest && (options.all || options.method == InverseMethod::closed_form);
  if (!wanted || !has_revolute_joints(state, 7) || options.lock) return false;
  state.grid_coordinate = redundant_joint(arm);
  return true;
}

std::string locked_joint_name(const SolverState& state) {
  return "general six joints with joint " + std::to_string(state.grid_coordinate + 1) + " locked";
}

/// Returns the grid over the joint's range; one revolution of it suffices. It does not depend on
/// the seed, so that the solvers serve every request.
std::vector<double> values_of(const SolverState& state) {
  const int k = state.grid_coordinate;
  LockedRange range = locked_range(state.arm, state.bounds, Configuration::Zero(7), k, 0);
  const double middle = (range.lower + range.upper) / 2;
  range.lower = std::max(range.lower, middle - std::numbers::pi);
  range.upper = std::min(range.upper, middle + std::numbers::pi);
  return grid_values(range, state.options.grid);
}

/// Prepares the solvers of the remaining joints, unless the budget ends it. The middle value comes
/// first: geometry at the ends of a range is more often special.
void prepare(SolverState& state, BudgetMeter& budget) {
  constexpr int few_restarts = 32;  // for a value without a closed form, or with a doubtful one
  InverseOptions options = state.options;
  options.all = true;
  options.every_turn = false;
  options.seed.reset();
  options.weights.reset();
  options.pose_tolerance.reset();
  options.method = InverseMethod::automatic;
  options.max_restarts = std::min(options.max_restarts, few_restarts);
  options.task = state.task;
  const std::vector<double> values = values_of(state);
  const SolverState middle = make_solver_state(
      with_locked(state.arm, state.grid_coordinate, values[values.size() / 2]), options);
  const RaghavanRothSolver* similar = middle.raghavan_roth ? &*middle.raghavan_roth : nullptr;
  state.grid_solvers.clear();
  for (const double value : values) {
    if (budget.ended()) return;
    state.grid_solvers.push_back(
        make_solver_state(with_locked(state.arm, state.grid_coordinate, value), options, similar));
  }
  state.grid_values = values;
}

void solve_locked_joint(SolverState& state, const Request& request, StageResult& found) {
  if (state.grid_values.empty()) prepare(state, request.budget);
  SolutionGrid& solved = found.result.grid.emplace(SolutionGrid{.joint = state.grid_coordinate});
  solved.values = state.grid_values;
  CandidateSolutions candidates(request, found);
  candidates.evidence().complete = candidates.evidence().branches_complete = false;
  const Configuration seed = without(request.seed, state.grid_coordinate);
  for (std::size_t i = 0; i < state.grid_values.size() && !request.budget.ended(); ++i) {
    SolverState& solver = state.grid_solvers[i];
    const Request locked = make_request(solver, request.goal, seed, request.budget);
    const StageResult there = run_stages(solver, locked);
    for (const Configuration& q : there.result.solutions) {
      candidates.add(with(q, state.grid_coordinate, state.grid_values[i]), false);
    }
    if (there.unconstrained.complete && !there.unconstrained.continuum) {
      solved.complete.push_back(state.grid_values[i]);
    }
  }
}

}  // namespace

const AnalyticFamily locked_joint_family{applies_locked_joint, locked_joint_name,
                                         solve_locked_joint};

}  // namespace beeline::internal
