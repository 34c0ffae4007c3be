#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <beeline/inverse/internal/analytic_family.h>
#include <beeline/inverse/internal/joint_lock.h>
#include <beeline/inverse/internal/redundant_joint.h>
#include <beeline/inverse/internal/stages.h>
#include <beeline/inverse/numerical/seed_table.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/math/decompositions.h>

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
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian(arm, q), Eigen::ComputeFullV);
    moved.col(trial) = svd.matrixV().rightCols<1>().cwiseAbs();
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
  state.grid_coordinate = Kept<RedundantJoint>(arm)->coordinate;
  return true;
}

std::string locked_joint_name(const SolverState& state) {
  return "general six joints with joint " + std::to_string(state.grid_coordinate + 1) + " locked";
}

/// Returns the grid over the joint's range; one revolution of it suffices. It does not depend on
/// the seed, so that the arms serve every request.
std::vector<double> values_of(const SolverState& state) {
  const int k = state.grid_coordinate;
  LockedRange range = locked_range(state.arm, state.bounds, Configuration::Zero(7), k, 0);
  const double middle = (range.lower + range.upper) / 2;
  range.lower = std::max(range.lower, middle - std::numbers::pi);
  range.upper = std::min(range.upper, middle + std::numbers::pi);
  return grid_values(range, state.options.grid);
}

/// The options of the remaining joints.
InverseOptions remaining_options(const SolverState& state) {
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
  return options;
}

/// The arms of the remaining joints, one for each value of the locked joint, which a thread keeps.
struct LockedJointGrid {
  std::vector<Arm> arms;
  /// The eliminations of the arm of the middle value, if it needs some, which suit the others:
  /// geometry at the ends of a range is more often special.
  std::optional<EliminationChoice> similar;

  struct Key {
    int coordinate = 0;
    std::vector<double> values;
    bool operator==(const Key&) const = default;
  };
  static LockedJointGrid make(const Arm& arm, const Key& key, const InverseOptions& options) {
    LockedJointGrid grid;
    for (const double value : key.values) {
      grid.arms.push_back(with_locked(arm, key.coordinate, value));
    }
    const SolverState middle(grid.arms[grid.arms.size() / 2], options);
    if (middle.family == &raghavan_roth_family) grid.similar = **middle.eliminations;
    return grid;
  }
};

void solve_locked_joint(SolverState& state, const Request& request, StageResult& found) {
  const int k = state.grid_coordinate;
  const InverseOptions options = remaining_options(state);
  const std::vector<double> values = values_of(state);
  const KeptByThread<LockedJointGrid> grid(state.arm, {k, values}, options);
  const EliminationChoice* const similar = grid->similar ? &*grid->similar : nullptr;
  SolutionGrid& solved = found.result.grid.emplace(SolutionGrid{.joint = k});
  found.unconstrained.complete = found.unconstrained.branches_complete = false;
  // The first request prepares what the arms keep, as long as the budget lasts. The later ones
  // count the same work, so that they end at the same value.
  for (const Arm& arm : grid->arms) {
    if (request.budget.ended()) return;
    const SolverState prepared(arm, options, similar);
  }
  solved.values = values;
  const Configuration seed = without(request.seed, k);
  for (std::size_t i = 0; i < values.size() && !request.budget.ended(); ++i) {
    SolverState remaining(grid->arms[i], options, similar);
    const Request locked = make_request(remaining, request.goal, seed, request.budget);
    StageResult there;
    run_stages(remaining, locked, there);
    for (const Solution& solution : *there.solutions) {
      found.solutions->candidate = with(solution.q, k, values[i]);
      add_candidate(request, found.solutions->candidate, found);
    }
    if (there.unconstrained.complete && !there.unconstrained.continuum) {
      solved.complete.push_back(values[i]);
    }
  }
}

}  // namespace

RedundantJoint RedundantJoint::make(const Arm& arm, const Key&) { return {redundant_joint(arm)}; }

const AnalyticFamily locked_joint_family{applies_locked_joint, locked_joint_name,
                                         solve_locked_joint};

}  // namespace beeline::internal
