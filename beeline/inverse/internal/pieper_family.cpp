#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>

#include <beeline/inverse/internal/analytic_family.h>
#include <beeline/inverse/internal/numerical_stage.h>
#include <beeline/inverse/internal/range_examination.h>
#include <beeline/inverse/internal/self_motion_branches.h>

namespace beeline::internal {
namespace {

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

/// The lanes of a mask, the nearest to the seed first.
class NearestLanes {
 public:
  NearestLanes(const PieperBranches& branches, unsigned mask) {
    for (; mask != 0; mask &= mask - 1) {
      const int lane = std::countr_zero(mask);
      int at = count_++;
      for (; at > 0 && branches.distance[lanes_[at - 1]] > branches.distance[lane]; --at) {
        lanes_[at] = lanes_[at - 1];
      }
      lanes_[at] = lane;
    }
  }
  const int* begin() const { return lanes_; }
  const int* end() const { return lanes_ + count_; }

 private:
  int lanes_[8];
  int count_ = 0;
};

/// Whether a lane's loop closes.
bool loop_closes(const LockedRequest& locked, const PieperBranches& branches, int lane) {
  return branches.residual[lane] <= locked.loop.max_residual;
}

/// Adds the lanes of the mask that are solutions as they are, and new ones: regular and within
/// limits. Returns the other lanes of the mask.
unsigned add_plain_lanes(const LockedRequest& locked, const LockedBranch& branch, unsigned mask,
                         StageResult& found) {
  const PieperSolver& form = locked.form;
  const Request& request = locked.request;
  const PieperBranches& branches = branch.found;
  if (!request.quick || form.has_free_joints()) return mask;
  double away = 0;
  if (form.locked()) {
    const int k = *form.locked();
    away = request.weights[k] * std::pow(branch.value - request.seed[k], 2);
  }
  const double accepted = request.accepted_error();
  const unsigned plain = mask & branches.within & ~(branches.twin | branches.continuum);
  for (const int lane : NearestLanes(branches, plain)) {
    if (!loop_closes(locked, branches, lane)) continue;
    Solution& added = found.solutions->add();
    added.q.resize(request.arm.dof());
    form.configuration(branches, lane, branch.value, added.q.data());
    added.error =
        request.skips_forward_check ? branches.residual[lane] : error_at(request, added.q);
    added.distance = std::sqrt(branches.distance[lane] + away);
    added.regular = true;
    if (added.error <= accepted) {
      mask &= ~(1u << lane);
    } else {
      found.solutions->resize(found.solutions->size() - 1);
    }
  }
  return mask;
}

/// Adds the lanes of the mask that have a solution.
void add_lanes(const LockedRequest& locked, const LockedBranch& branch, unsigned lanes,
               StageResult& found) {
  const PieperSolver& form = locked.form;
  const Request& request = locked.request;
  const PieperBranches& branches = branch.found;
  unsigned rest = add_plain_lanes(locked, branch, branches.found & lanes, found);
  for (; rest != 0; rest &= rest - 1) {
    const int lane = std::countr_zero(rest);
    const auto has = [lane](unsigned mask) { return (mask >> lane & 1) != 0; };
    // A lane that is outside by less may be within limits once it is corrected.
    constexpr double slack = 1e-6;
    const bool outside = !has(branches.within) && branches.excess[lane] >= slack;
    const bool regular = !has(branches.twin | branches.continuum);
    const bool certain =
        loop_closes(locked, branches, lane) && regular && (outside || has(branches.within));
    if (request.quick && certain && outside) continue;
    if (request.options.lock && !certain) {  // corrections would move the locked joint
      found.unconstrained.doubtful = true;
      continue;
    }
    Configuration& q = found.solutions->candidate;
    q.resize(request.arm.dof());
    form.configuration(branches, lane, branch.value, q.data());
    add_candidate(request, q, found,
                  {.continuum = !form.has_virtual_joints() && has(branches.continuum),
                   .regular = regular && !form.has_free_joints(),
                   .within = has(branches.within)});
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
bool solves(const Request& request, const LeastOutside& outside) {
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
    evidence.solved_outside = solves(request, outside) || solves(request, in_range);
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
      locked.form.configuration(branch.found, branch.lane, branch.value, start.data());
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
      form.configuration(there, lane, branch.value, solution.q.data());
    }
  };
  std::vector<Configuration> branches = self_motion_branches(request, values, solutions_at);
  for (Configuration& q : branches) {
    add_candidate(request, q, found, {.continuum = !form.has_virtual_joints()});
  }
  return !branches.empty();
}

/// Adds the lane of `at` and the solution to which a search from the seed converges, if that is
/// nearer. Returns false if the search finds none nearby.
bool add_beside_seed(SolverState& state, const LockedRequest& locked, const LockedBranch& at,
                     StageResult& found) {
  constexpr double near = 0.1;  // metres and radians, weighted
  const Request& request = locked.request;
  if (request.options.method != InverseMethod::automatic) return false;
  const double error = error_at(request, request.seed);
  const bool in_continuum = at.found.continuum != 0 && error <= request.tolerance;
  if (in_continuum || !(error < near)) return false;
  Configuration& q = found.solutions->candidate;
  q.resize(request.arm.dof());
  if (!solution_from(state, request, request.seed.data(), false, q)) return false;
  const double distance = distance_from_seed(request, q);
  if (distance > near) return false;
  if (at.lane >= 0 && std::sqrt(at.found.distance[at.lane]) <= distance) {
    add_branch(locked, at, found);
    return true;
  }
  add_candidate(request, q, found);
  if (found.solutions->empty()) return false;
  found.result.method = "numerical";
  found.result.iterations += state.buffers().near.iterations;
  return true;
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
  at.value = value;
  form.branches(request.goal, value, locked.loop, at.found);
  const PieperBranches& branches = at.found;
  // Distances would depend on the values chosen for free joints.
  if (request.quick && !request.options.all && is_verified(state) && !form.has_free_joints()) {
    at.lane = nearest_lane(locked.loop, branches);
    if (request.options.lock || !may_be_nearer(locked, branches)) {
      return add_branch(locked, at, found);
    }
    if (!add_beside_seed(state, locked, at, found)) add_lanes(locked, at, all_lanes, found);
    return;
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
  evidence.branches_complete = branches.continuum == 0 || ((lanes & branches.continuum) == 0 &&
                                                           form.free_joints(branches).size() == 1);
  evidence.doubtful |= !is_verified(state) || nearly_found(form, branches);
}

void solve_pieper(SolverState& state, const Request& request, StageResult& found) {
  const PieperSolver& kept = state.pieper_solver();
  std::unique_ptr<PieperSolver> own;
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

const AnalyticFamily pieper_family{applies_pieper, pieper_name, solve_pieper};

}  // namespace beeline::internal
