#include <algorithm>
#include <bit>
#include <cmath>

#include <beeline/inverse/internal/analytic_family.h>
#include <beeline/inverse/internal/numerical_stage.h>
#include <beeline/inverse/internal/range_examination.h>
#include <beeline/inverse/internal/self_motion_branches.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/math/six_row_svd.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {
namespace {

/// Returns the largest error of random configurations of the arm that the closed form recovers,
/// infinite if it reports a continuum for all of them, or nothing if it does neither for one. That
/// happens if axes of its loop coincide. Sixteen trials suffice, because it then fails almost
/// everywhere. The tolerance 1e-4 is far below the distance of other solutions and far above
/// rounding.
std::optional<double> recovered_error(const PieperSolver& kept, const Arm& arm, const Task& task) {
  constexpr int trials = 16;
  std::optional<double> error;
  std::optional<PieperSolver> own;
  const Configuration zero = Configuration::Zero(arm.dof());
  const Bounds open = no_bounds(arm);
  PieperRequest loop = kept.request(zero, Configuration::Ones(arm.dof()), open.lower, open.upper);
  Splitmix random(1);
  for (int trial = 0; trial < trials; ++trial) {
    Configuration q(arm.dof()), recovered(arm.dof());
    for (double& value : q) value = 2 * random.next() - 1;
    const Pose goal = forward_kinematics(arm, q);
    const PieperSolver* form = kept.for_goal(chain_of(arm), goal, own);
    if (form == nullptr) return std::nullopt;
    PieperBranches found;
    const double value = kept.locked() ? q[*kept.locked()] : 0;
    form->branches(goal, value, loop, found);
    bool met = found.continuum != 0;
    for (int lane = 0; lane < 8 && !met; ++lane) {
      if ((found.found >> lane & 1) == 0) continue;
      form->configuration(found, lane, value, recovered);
      met = same_posture(arm, q, recovered, 1e-4);
      if (!met) continue;
      const Deviation off = task_deviation(task, goal, forward_kinematics(arm, recovered));
      error = std::max({error.value_or(0), off.position, off.orientation});
    }
    if (!met) return std::nullopt;
  }
  return error.value_or(Limits::none);
}

/// Whether an arm of six or more joints is singular at every configuration, such as a
/// shoulder-elbow-wrist arm of six joints with its elbow locked. Its poses have no solution, or
/// more than the closed form counts.
bool is_singular_everywhere(const Arm& arm) {
  if (arm.dof() < 6) return false;
  // Of seven joints, the values of the locked one lose their solutions to rounding sooner.
  const double rounding = arm.dof() == 6 ? 1e-12 : 1e-6;
  Splitmix random(1);
  Configuration q(arm.dof());
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
  if (state.removed_coordinate) return state.pieper_solver().family(state.removed_coordinate);
  return (*state.pieper)->name;
}

constexpr unsigned all_lanes = 0xff;

LockedRequest locked_request(const PieperSolver& form, const Request& request) {
  return {form, request,
          form.request(request.seed, request.weights, request.bounds.lower, request.bounds.upper,
                       request.tolerance)};
}

/// Adds the lanes of the mask that have a solution.
void add_lanes(const LockedRequest& locked, const LockedBranch& branch, unsigned lanes,
               StageResult& found) {
  const PieperSolver& form = locked.form;
  const Request& request = locked.request;
  const PieperBranches& branches = branch.found;
  Configuration& q = found.solutions->candidate;
  q.resize(request.arm.dof());
  for (unsigned rest = branches.found & lanes; rest != 0; rest &= rest - 1) {
    const int lane = std::countr_zero(rest);
    const auto has = [lane](unsigned mask) { return (mask >> lane & 1) != 0; };
    const bool closes = branches.residual[lane] <= locked.loop.max_residual;
    // A lane that is outside by less may be within limits once it is corrected.
    constexpr double slack = 1e-6;
    const bool outside = !has(branches.within) && branches.excess[lane] >= slack;
    const bool regular = !has(branches.twin | branches.continuum);
    const bool certain = closes && regular && (outside || has(branches.within));
    if (request.quick && certain && outside) continue;
    if (request.options.lock && !certain) {  // corrections would move the locked joint
      found.unconstrained.doubtful = true;
      continue;
    }
    form.configuration(branches, lane, branch.value, q);
    Knowledge known{.continuum = !form.has_virtual_joints() && has(branches.continuum),
                    .regular = regular && !form.has_free_joints(),
                    .within = has(branches.within)};
    if (request.trusts_closed_loops && closes && known.within)
      known.error = branches.residual[lane];
    add_candidate(request, q, found, known);
  }
}

/// Adds the lane of the branch, if it has one.
void add_branch(const LockedRequest& locked, const LockedBranch& branch, StageResult& found) {
  if (branch.lane >= 0) add_lanes(locked, branch, 1u << branch.lane, found);
}

/// Adds the solutions for each value of a grid of the redundant joint.
void solve_grid(LockedRequest& locked, StageResult& found) {
  SolutionGrid& solved = found.result.grid.emplace();
  solved.joint = *locked.form.locked();
  solved.values = grid_values(locked.range, locked.request.options.grid);
  LockedBranch at;
  for (const double value : solved.values) {
    if (locked.request.budget.ended()) break;
    evaluate(locked, value, at);
    add_lanes(locked, at, all_lanes, found);
    const bool complete = at.found.continuum == 0 && !nearly_found(locked.form, at.found);
    if (complete) solved.complete.push_back(value);
  }
}

/// Whether the branch that exceeds the limits least is a solution.
bool closes(const Request& request, const LeastOutside& outside) {
  if (outside.count == 0) return false;
  const Eigen::Map<const Configuration> q(outside.q[0], request.arm.dof());
  return error_at(request, q) <= request.tolerance;
}

/// Adds the evidence of branches outside the limits.
void add_outside(const Request& request, const LeastOutside& outside, const LeastOutside& in_range,
                 StageResult& found) {
  UnconstrainedResult& evidence = found.unconstrained;
  if (request.quick) {
    evidence.range_examined &= !request.options.pose_tolerance;
    evidence.solved_outside = closes(request, outside) || closes(request, in_range);
    evidence.doubtful = outside.count + in_range.count > 0 && !evidence.solved_outside;
    return;
  }
  for (const LeastOutside* each : {&outside, &in_range}) {
    for (int i = 0; i < each->count; ++i) {
      found.solutions->candidate = Eigen::Map<const Configuration>(each->q[i], request.arm.dof());
      add_candidate(request, found.solutions->candidate, found);
    }
  }
}

/// Whether a search from the seed converges to a solution that is nearer to the seed than `branch`,
/// the one for the seed's value of the redundant joint; writes it to q. There may be none for that
/// value although one is near: a value next to it has the solutions that it lacks.
bool solve_near_seed(SolverState& state, const Request& request, const LockedBranch& branch,
                     Configuration& q) {
  constexpr double far = 0.25;  // square of a distance that is another branch, or nearly one
  const double distance = branch.lane >= 0 ? branch.found.distance[branch.lane] : Limits::none;
  if (distance < far * request.weights.maxCoeff()) return false;
  if (search_from_seed(state, request, q) &&
      (q - request.seed).cwiseAbs2().dot(request.weights) < distance) {
    return true;
  }
  state.reset_search();  // the closed form solves
  return false;
}

/// Adds one solution of an arm with a redundant joint, in steps, each only if the ones before it
/// fail: the seed's value, and a search from the seed; further values; a search from the branches
/// that exceed the limits least; following all branches. A few values suffice for most poses, and
/// for the others a search succeeds more often than further values. With the option closed_form
/// only values are tried and the branches outside them.
void solve_redundant(SolverState& state, LockedRequest& locked, StageResult& found) {
  constexpr int few = 8;  // two rounds of steps: see first_within()
  const Request& request = locked.request;
  const bool automatic = request.options.method == InverseMethod::automatic;
  const int grid = request.options.grid, tries = std::min(request.quick ? few : grid, grid - 1);
  Configuration& q = found.solutions->candidate;
  q.resize(request.arm.dof());
  LeastOutside outside, in_range;
  LockedBranch branch = branch_at(locked, locked.range.seed, outside);
  if (automatic && solve_near_seed(state, request, branch, q)) {
    found.result.method = "numerical";
    found.result.iterations += state.iterations();
    return add_candidate(request, q, found);
  }
  if (branch.lane < 0) branch = first_within(locked, tries, outside);
  if (branch.lane >= 0) return add_branch(locked, branch, found);
  const auto solved_from = [&](const LeastOutside& start) {
    if (start.count == 0 || !solve_from_outside(state, request, start, q)) return false;
    add_candidate(request, q, found);
    return true;
  };
  bool solved = solved_from(outside);
  if (!solved && automatic) {
    const ExaminedRange examined = examine_range(locked, in_range);
    add_branch(locked, examined.branch, found);
    solved = examined.branch.lane >= 0 || solved_from(in_range);
    found.unconstrained.range_examined = !solved && examined.conclusive;
  }
  if (!(request.quick && solved)) add_outside(request, outside, in_range, found);
}

/// Adds the solution nearest to the seed that is found from the seed or, if that is far away, from
/// few values of the redundant joint. Returns whether there is one.
bool solve_near(SolverState& state, LockedRequest& locked, StageResult& found) {
  constexpr double near = 0.1;         // distance up to which no other branch is examined
  constexpr double far = 0.5;          // distance from which the other branches are examined first
  constexpr double at_the_pose = 0.1;  // metres and radians
  constexpr double same = 1e-3;        // max correction of a branch
  const Request& request = locked.request;
  const double least_weight = request.weights.minCoeff();
  const auto square = [&](const auto& away) { return request.weights.dot(away.cwiseAbs2()); };
  Configuration& q = found.solutions->candidate;
  q.resize(request.arm.dof());
  bool solved = solution_from(state, request, request.seed.data(), false, q);
  const bool tool_is_near = !solved && error_at(request, request.seed) < at_the_pose;
  if (tool_is_near) solved = solution_from(state, request, request.seed.data(), true, q);
  const bool is_far = !solved || square(q - request.seed) > far * far * least_weight;
  if (!is_far) approach_seed(state, request, q);
  if (is_far || square(q - request.seed) > near * near * least_weight) {
    const LockedBranch branch =
        nearest_of_few(locked, tool_is_near, solved ? square(q - request.seed) : Limits::none);
    if (branch.lane >= 0) {
      Eigen::Matrix<double, 7, 1> start;
      locked.form.configuration(branch.found, branch.lane, branch.value, start);
      const bool converges = solution_from(state, request, start.data(), false, q);
      if (!converges || square(q - start) > same * same) {  // next to a singularity
        add_branch(locked, branch, found);
        return !found.solutions->empty();
      }
    }
    if (branch.lane >= 0 || (solved && is_far)) approach_seed(state, request, q);
    if (branch.lane < 0 && !solved) return false;
  }
  found.result.method = "numerical";
  found.result.iterations += state.buffers().near.iterations;
  found.near_seed = true;
  add_candidate(request, q, found, {.regular = true, .within = true});
  return !found.solutions->empty();
}

void solve_locked(SolverState& state, LockedRequest& locked, StageResult& found) {
  const Request& request = locked.request;
  const int k = *locked.form.locked();
  locked.range = locked_range(request.arm, request.bounds, request.seed, k, locked.form.size());
  locked.range.weight = request.weights[k];
  found.unconstrained.complete = found.unconstrained.branches_complete = false;
  if (request.options.all) return solve_grid(locked, found);
  const bool optimises = !request.quick && request.redundancy != Redundancy::any;
  if (optimises) add_branch(locked, best_within(locked), found);
  if (request.near_seed && solve_near(state, locked, found)) return;
  solve_redundant(state, locked, found);
}

/// Adds a solution of every branch in the lanes that have a free joint. Returns whether there is
/// one; if not, all are outside the limits.
bool add_self_motions(const LockedRequest& locked, const LockedBranch& branch, StageResult& found) {
  const PieperSolver& form = locked.form;
  const PieperBranches& at_seed = branch.found;
  const Request& request = locked.request;
  PieperRequest loop = locked.loop;
  const std::vector<int> free = form.free_joints(at_seed);
  std::vector<double> values;
  for (const int joint : free) values.push_back(loop.seed[joint]);
  const double closes = std::max(loop.max_residual, 1e-9 * form.size());
  PieperBranches there;
  const SolutionsAt solutions_at = [&](const std::vector<double>& at,
                                       std::vector<FreeSolution>& solutions) {
    for (std::size_t i = 0; i < free.size(); ++i) loop.seed[free[i]] = at[i];
    form.branches(request.goal, branch.value, loop, there);
    solutions.assign(8, {.miss = no_solution});
    for (int lane = 0; lane < 8; ++lane) {
      FreeSolution& solution = solutions[static_cast<std::size_t>(lane)];
      if ((at_seed.continuum >> lane & 1) == 0) continue;
      const bool closed = (there.found >> lane & 1) != 0 && there.residual[lane] <= closes;
      solution.miss = closed ? there.excess[lane] : no_solution + there.residual[lane];
      if (solution.miss > 0) continue;
      solution.q.resize(request.arm.dof());
      form.configuration(there, lane, branch.value, solution.q);
    }
  };
  std::vector<Configuration> branches = self_motion_branches(request, values, solutions_at);
  for (Configuration& q : branches) {
    add_candidate(request, q, found, {.continuum = !form.has_virtual_joints()});
  }
  return !branches.empty();
}

/// Solves without a redundant joint, or with the seed's value of the locked one.
void solve_branches(SolverState& state, LockedRequest& locked, StageResult& found) {
  const PieperSolver& form = locked.form;
  const Request& request = locked.request;
  double value = 0;
  if (request.options.lock) {
    check_lock(state, request.seed);
    value = request.seed[*request.options.lock];
  } else if (form.spins()) {
    const int k = *form.locked();
    value = std::clamp(request.seed[k], request.bounds.lower[k], request.bounds.upper[k]);
  }
  LockedBranch at;
  evaluate(locked, value, at);
  const PieperBranches& branches = at.found;
  // Distances would depend on the values chosen for free joints.
  if (request.quick && !request.options.all && is_verified(state) && !form.has_free_joints()) {
    return add_branch(locked, at, found);
  }
  unsigned lanes = all_lanes;
  if (!request.quick && branches.continuum != 0 && !form.has_free_joints() &&
      add_self_motions(locked, at, found)) {
    lanes &= ~branches.continuum;
  }
  add_lanes(locked, at, lanes, found);
  UnconstrainedResult& evidence = found.unconstrained;
  // The axis of a virtual joint may coincide with the axis of an arm's joint. Then only one of
  // infinitely many solutions was examined.
  evidence.complete = !form.has_virtual_joints() || branches.continuum == 0;
  // A grid over one free joint, refined between its points, represents every branch. A grid over
  // two may miss a small branch, and proves nothing without a solution.
  const bool represented =
      (lanes & branches.continuum) == 0 && form.free_joints(branches).size() == 1;
  evidence.branches_complete = branches.continuum == 0 || represented;
  evidence.doubtful |= !is_verified(state) || nearly_found(form, branches);
}

void solve_pieper(SolverState& state, const Request& request, StageResult& found) {
  const PieperSolver& kept = state.pieper_solver();
  std::optional<PieperSolver> own;
  const PieperSolver* form = kept.for_goal(chain_of(request.arm), request.goal, own);
  if (form == nullptr) {
    found.unconstrained.doubtful = true;
    return;
  }
  LockedRequest locked = locked_request(*form, request);
  if (!request.finitely_many()) return solve_locked(state, locked, found);
  solve_branches(state, locked, found);
  // Each solution has the seed's value of the last joint, of which any other does too.
  const bool samples = kept.spins() && !request.options.lock;
  found.unconstrained.continuum |= samples && !found.solutions->empty();
}

}  // namespace

PieperForm PieperForm::make(const Arm& arm, const Task& task) {
  PieperForm form;
  if (!is_singular_everywhere(arm)) form.solver = PieperSolver::make(arm, task);
  if (!form.solver) return form;
  const std::optional<double> error = recovered_error(*form.solver, arm, task);
  form.verified = error.has_value();
  form.error = error.value_or(Limits::none);
  form.name = form.solver->family();
  return form;
}

const AnalyticFamily pieper_family{applies_pieper, pieper_name, solve_pieper};

}  // namespace beeline::internal
