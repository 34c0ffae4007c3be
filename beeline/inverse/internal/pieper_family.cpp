#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include <beeline/inverse/internal/analytic_family.h>
#include <beeline/inverse/internal/candidate_solutions.h>
#include <beeline/inverse/internal/infeasibility.h>
#include <beeline/inverse/internal/numerical_stage.h>
#include <beeline/inverse/internal/redundant_joint.h>
#include <beeline/inverse/internal/self_motion_branches.h>
#include <beeline/inverse/internal/value_search.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/math/six_row_svd.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {
namespace {

/// Whether the closed form recovers random configurations of the arm, or reports a continuum. It
/// may do neither if axes of its loop coincide. Sixteen trials suffice, because it then fails
/// almost everywhere. The tolerance 1e-4 is far below the distance of other solutions and far above
/// rounding.
bool recovers_configurations(const PieperSolver& form, const Arm& arm) {
  constexpr int trials = 16;
  const Configuration zero = Configuration::Zero(arm.dof());
  const Bounds open = no_bounds(arm);
  PieperRequest loop = form.request(zero, Configuration::Ones(arm.dof()), open.lower, open.upper);
  Splitmix random(1);
  for (int trial = 0; trial < trials; ++trial) {
    Configuration q(arm.dof()), recovered(arm.dof());
    for (double& value : q) value = 2 * random.next() - 1;
    PieperBranches found;
    const double value = form.locked() ? q[*form.locked()] : 0;
    form.branches(forward_kinematics(arm, q), value, loop, found);
    bool met = found.continuum != 0;
    for (int lane = 0; lane < 8 && !met; ++lane) {
      if ((found.found >> lane & 1) == 0) continue;
      form.configuration(found, lane, value, recovered);
      met = same_posture(arm, q, recovered, 1e-4);
    }
    if (!met) return false;
  }
  return true;
}

/// Whether an arm of six joints can move with the tool at rest from every configuration, such as a
/// shoulder-elbow-wrist arm with its elbow locked. Its poses have no solution or infinitely many.
bool moves_with_tool_at_rest(const Arm& arm) {
  if (arm.dof() != 6) return false;
  constexpr double rounding = 1e-12;
  Splitmix random(1);
  Configuration q(6);
  for (int trial = 0; trial < 3; ++trial) {
    for (double& value : q) value = 2 * random.next() - 1;
    const SixRowSvd svd = six_row_svd(jacobian(arm, q));
    if (svd.singular_values[5] > rounding * svd.singular_values[0]) return false;
  }
  return true;
}

bool applies_pieper(SolverState& state) {
  const std::optional<int>& lock = state.options.lock;
  state.pieper.emplace(state.arm, state.task);
  const std::optional<PieperSolver>& solver = (*state.pieper)->solver;
  return solver && (!lock || solver->locked() == lock);
}

/// Whether the closed form recovers configurations, if it is not for a locked coordinate.
bool is_verified(const SolverState& state) {
  return state.options.lock || (*state.pieper)->verified;
}

std::string pieper_name(const SolverState& state) {
  return state.pieper_solver().family(state.removed_coordinate);
}

constexpr unsigned all_lanes = 0xff;

/// Adds the lanes of the mask that have a solution.
void add_branches(const PieperSolver& form, const PieperBranches& found, unsigned lanes,
                  double value, int dof, CandidateSolutions& candidates) {
  for (int lane = 0; lane < 8; ++lane) {
    if ((found.found & lanes & 1u << lane) == 0) continue;
    Configuration q(dof);
    form.configuration(found, lane, value, q);
    candidates.add(q, !form.has_virtual_joints() && (found.continuum >> lane & 1) != 0);
  }
}

bool is_continuum(const LockedBranch& branch) {
  return (branch.found.continuum >> branch.lane & 1) != 0;
}

/// Adds the solutions for each value of a grid of the redundant joint.
void solve_grid(const PieperSolver& form, const Request& request, const LockedRange& range,
                PieperRequest& loop, StageResult& found, CandidateSolutions& candidates) {
  SolutionGrid& solved = found.result.grid.emplace();
  solved.joint = *form.locked();
  solved.values = grid_values(range, request.options.grid);
  for (const double value : solved.values) {
    if (request.budget.ended()) break;
    PieperBranches branches;
    form.branches(request.goal, value, loop, branches);
    add_branches(form, branches, all_lanes, value, request.arm.dof(), candidates);
    if (branches.continuum == 0 && !nearly_found(form, branches)) solved.complete.push_back(value);
  }
}

void solve_locked(SolverState& state, const Request& request, StageResult& found) {
  CandidateSolutions candidates(request, found);
  const PieperSolver& form = state.pieper_solver();
  PieperRequest loop = form.request(request.seed, request.weights, request.bounds.lower,
                                    request.bounds.upper, request.tolerance);
  LockedRange range =
      locked_range(request.arm, request.bounds, request.seed, *form.locked(), form.size());
  range.weight = request.weights[*form.locked()];
  candidates.evidence().complete = candidates.evidence().branches_complete = false;
  if (request.options.all) return solve_grid(form, request, range, loop, found, candidates);
  const int dof = request.arm.dof(), grid = request.options.grid;
  Configuration q(dof);
  const auto add = [&](const LockedBranch& branch) {
    if (branch.lane < 0) return;
    form.configuration(branch.found, branch.lane, branch.value, q);
    candidates.add(q, is_continuum(branch));
  };
  const auto add_all = [&](const LeastOutside& outside) {
    for (int i = 0; i < outside.count; ++i) {
      candidates.add(Eigen::Map<const Configuration>(outside.q[i], dof), false);
    }
  };
  if (request.options.redundancy != Redundancy::any) {
    add(best_within(form, request.goal, range, grid, request.options.redundancy, loop,
                    request.budget));
  }
  Configuration solution(dof);
  const ValueSearch search = search_value(state, request.goal, request.seed, range, grid - 1, loop,
                                          request.budget, solution);
  if (search.end == ValueSearchEnd::near_seed) {
    candidates.add(solution, false);
    found.result.method = "numerical";
    found.result.iterations += state.iterations();
    return;
  }
  if (search.end == ValueSearchEnd::first_values) return add(search.branch);
  add_all(search.outside);
  if (search.end == ValueSearchEnd::examined_range) return add(search.branch);
  add_all(search.in_range);
  if (search.end == ValueSearchEnd::from_outside) candidates.add(solution, false);
  candidates.evidence().range_examined = search.conclusive;
}

/// Adds a solution of every branch in the lanes that have a free joint. Returns whether there is
/// one; if not, all are outside the limits.
bool add_self_motions(const PieperSolver& form, const Request& request, PieperRequest loop,
                      const PieperBranches& at_seed, CandidateSolutions& candidates) {
  const std::vector<int> free = form.free_joints(at_seed);
  std::vector<double> values;
  for (const int joint : free) values.push_back(loop.seed[joint]);
  const double closes = std::max(loop.max_residual, 1e-9 * form.size());
  PieperBranches found;
  const SolutionsAt solutions_at = [&](const std::vector<double>& at,
                                       std::vector<FreeSolution>& solutions) {
    for (std::size_t i = 0; i < free.size(); ++i) loop.seed[free[i]] = at[i];
    form.branches(request.goal, 0, loop, found);
    solutions.assign(8, {.miss = no_solution});
    for (int lane = 0; lane < 8; ++lane) {
      FreeSolution& solution = solutions[static_cast<std::size_t>(lane)];
      if ((at_seed.continuum >> lane & 1) == 0) continue;
      const bool closed = (found.found >> lane & 1) != 0 && found.residual[lane] <= closes;
      solution.miss = closed ? found.excess[lane] : no_solution + found.residual[lane];
      if (solution.miss > 0) continue;
      solution.q.resize(request.arm.dof());
      form.configuration(found, lane, 0, solution.q);
    }
  };
  const std::vector<Configuration> branches = self_motion_branches(request, values, solutions_at);
  for (const Configuration& q : branches) candidates.add(q, !form.has_virtual_joints());
  return !branches.empty();
}

void solve_branches(SolverState& state, const Request& request, CandidateSolutions& candidates) {
  const PieperSolver& form = state.pieper_solver();
  PieperRequest loop = form.request(request.seed, request.weights, request.bounds.lower,
                                    request.bounds.upper, request.tolerance);
  PieperBranches found;
  form.branches(request.goal, 0, loop, found);
  unsigned lanes = all_lanes;
  if (found.continuum != 0 && !form.has_free_joints() &&
      add_self_motions(form, request, loop, found, candidates)) {
    lanes &= ~found.continuum;
  }
  add_branches(form, found, lanes, 0, request.arm.dof(), candidates);
  // The axis of a virtual joint may coincide with the axis of an arm's joint. Then only one of
  // infinitely many solutions was examined.
  candidates.evidence().complete = !form.has_virtual_joints() || found.continuum == 0;
  // A grid over one free joint, refined between its points, represents every branch. A grid over
  // two may miss a small branch, and proves nothing without a solution.
  const bool represented = (lanes & found.continuum) == 0 && form.free_joints(found).size() == 1;
  candidates.evidence().branches_complete = found.continuum == 0 || represented;
  candidates.evidence().doubtful |= !is_verified(state) || nearly_found(form, found);
}

void solve_pieper(SolverState& state, const Request& request, StageResult& found) {
  if (state.pieper_solver().locked()) {
    solve_locked(state, request, found);
  } else {
    CandidateSolutions candidates(request, found);
    solve_branches(state, request, candidates);
  }
}

/// Whether the branch that exceeds the limits least is a solution.
bool closes(const SolverState& state, const Pose& goal, const LeastOutside& outside) {
  if (outside.count == 0) return false;
  const Eigen::Map<const Configuration> q(outside.q[0], state.arm.dof());
  const Deviation error = task_deviation(state.task, goal, forward_kinematics(state.arm, q));
  return std::max(error.position, error.orientation) <= state.options.tolerance;
}

/// Writes one solution of an arm with a redundant joint. A few values of that joint suffice for
/// most poses. For the others the numerical search from the nearest branches succeeds more often
/// than further values.
std::optional<FastSolutions> solve_redundant(SolverState& state, const Pose& goal,
                                             const ConfigurationRef& seed, PieperRequest& loop,
                                             BudgetMeter& budget,
                                             Eigen::Ref<Eigen::MatrixXd> solutions) {
  if (out_of_reach(state.defaults->ball, goal, state.task, state.options.tolerance)) {
    if (state.options.pose_tolerance) return std::nullopt;
    return FastSolutions{};
  }
  constexpr int few = 8;  // two rounds of steps: see first_within()
  const PieperSolver& form = state.pieper_solver();
  const LockedRange range =
      locked_range(state.arm, state.bounds, seed, *form.locked(), form.size());
  const ValueSearch search = search_value(
      state, goal, seed, range, std::min(few, state.options.grid - 1), loop, budget, solutions);
  switch (search.end) {
    case ValueSearchEnd::near_seed:
    case ValueSearchEnd::from_outside:
      return FastSolutions{1};
    case ValueSearchEnd::first_values:
    case ValueSearchEnd::examined_range:
      if (is_continuum(search.branch)) return std::nullopt;
      form.configuration(search.branch.found, search.branch.lane, search.branch.value,
                         solutions.col(0));
      return FastSolutions{1};
    case ValueSearchEnd::failed:
      break;
  }
  if (search.conclusive && !state.options.pose_tolerance) {
    const bool found = search.outside.count + search.in_range.count > 0;
    const bool outside =
        closes(state, goal, search.outside) || closes(state, goal, search.in_range);
    return FastSolutions{.examined = !found || outside, .outside = outside};
  }
  if (search_fast_path(state, goal, seed, budget, solutions)) return FastSolutions{1};
  return std::nullopt;
}

/// Returns the lanes within limits, sorted by distance from the seed.
struct OrderedLanes {
  int count = 0;
  int lane[8];
};

/// Returns nothing if a lane needs the corrections of solve().
std::optional<OrderedLanes> lanes_in_order(const PieperRequest& loop, const PieperBranches& found) {
  OrderedLanes order;
  for (unsigned rest = found.found; rest != 0; rest &= rest - 1) {
    const int lane = std::countr_zero(rest);
    if (!(found.residual[lane] <= loop.max_residual)) return std::nullopt;
    if ((found.within >> lane & 1) == 0) {
      // As in add_solution(): a lane outside by less may be within limits once it is corrected.
      constexpr double slack = 1e-6;
      if (found.excess[lane] < slack) return std::nullopt;
      continue;
    }
    int index = order.count++;
    for (; index > 0 && found.distance[order.lane[index - 1]] > found.distance[lane]; --index) {
      order.lane[index] = order.lane[index - 1];
    }
    order.lane[index] = lane;
  }
  return order;
}

/// Whether two of these lanes are the same posture.
bool has_twins(const PieperBranches& found, const OrderedLanes& order) {
  // Two solutions merge at the boundary of the workspace.
  constexpr double twin = 1e-4;  // radians or metres
  for (int i = 0; i < order.count; ++i) {
    for (int j = 0; j < i; ++j) {
      const bool same = std::all_of(std::begin(found.q), std::end(found.q), [&](const auto& q) {
        return std::abs(wrap_angle(q[order.lane[i]] - q[order.lane[j]])) < twin;
      });
      if (same) return true;
    }
  }
  return false;
}

/// Writes all solutions of six joints.
std::optional<FastSolutions> write_all(const PieperSolver& form, const PieperRequest& loop,
                                       const PieperBranches& found, double value,
                                       Eigen::Ref<Eigen::MatrixXd> solutions) {
  if (found.continuum != 0 || nearly_found(form, found)) return std::nullopt;
  const std::optional<OrderedLanes> order = lanes_in_order(loop, found);
  if (!order || (found.twin != 0 && has_twins(found, *order))) return std::nullopt;
  const int shown = std::min(order->count, static_cast<int>(solutions.cols()));
  for (int i = 0; i < shown; ++i) {
    form.configuration(found, order->lane[i], value, solutions.col(i));
  }
  return FastSolutions{shown};
}

/// Writes solutions whose loops close within the tolerance, without further checks.
std::optional<FastSolutions> solve_pieper_fast(SolverState& state, const Pose& goal,
                                               const ConfigurationRef& seed, BudgetMeter& budget,
                                               Eigen::Ref<Eigen::MatrixXd> solutions) {
  const InverseOptions& options = state.options;
  const bool any_one = !options.all && state.redundancy == Redundancy::any;
  const PieperSolver& form = state.pieper_solver();
  // Solutions and distances would depend on the values chosen for free joints.
  if (form.has_free_joints() || !is_verified(state)) return std::nullopt;
  PieperRequest loop =
      form.request(seed, state.weights, state.bounds.lower, state.bounds.upper, options.tolerance);
  double value = 0;  // value of a locked joint
  if (options.lock) {
    check_lock(state, seed);
    value = seed[*options.lock];
  } else if (form.locked()) {
    if (!any_one || options.method != InverseMethod::automatic) return std::nullopt;
    return solve_redundant(state, goal, seed, loop, budget, solutions);
  }
  PieperBranches found;
  form.branches(goal, value, loop, found);
  if (options.all) {
    if (options.every_turn) return std::nullopt;
    return write_all(form, loop, found, value, solutions);
  }
  const int lane = nearest_lane(loop, found);
  if (lane < 0 || (found.continuum >> lane & 1) != 0) return std::nullopt;
  form.configuration(found, lane, value, solutions.col(0));
  return FastSolutions{1};
}

}  // namespace

PieperForm PieperForm::make(const Arm& arm, const Task& task) {
  PieperForm form;
  if (!moves_with_tool_at_rest(arm)) form.solver = PieperSolver::make(arm, task);
  if (form.solver) form.verified = recovers_configurations(*form.solver, arm);
  return form;
}

const AnalyticFamily pieper_family{applies_pieper, pieper_name, solve_pieper, solve_pieper_fast};

}  // namespace beeline::internal
