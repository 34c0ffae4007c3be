#include <algorithm>
#include <iterator>

#include <beeline/inverse/internal/analytic_family.h>
#include <beeline/inverse/internal/numerical_stage.h>
#include <beeline/inverse/internal/stages.h>
#include <beeline/inverse/numerical/representative.h>

namespace beeline::internal {
namespace {

/// A new family is added as a row here, before those that cover more arms.
constexpr const AnalyticFamily* families[] = {
    &planar_family,
    &pieper_family,
    &locked_joint_family,
    &raghavan_roth_family,
};

bool is_solution(const Request& request, const ConfigurationRef& q) {
  return within(request.bounds, q) && error_at(request, q) <= request.tolerance;
}

/// Adds the seed, which is a solution, because no other one is nearer. Next to a singularity the
/// closed form may lose it to rounding. Returns whether the family has not found it.
bool add_seed(const Request& request, StageResult& found) {
  Solutions& solutions = *found.solutions;
  const auto same = std::find_if(solutions.begin(), solutions.end(), [&](const Solution& each) {
    return same_posture(request.arm, each.q, request.seed);
  });
  const bool is_new = same == solutions.end();
  const bool regular = !is_new && same->regular;
  Solution& solution = is_new ? solutions.add() : *same;
  solution.q = request.seed;
  solution.distance = 0;
  solution.error = error_at(request, request.seed);
  solution.regular = regular;
  UnconstrainedResult& evidence = found.unconstrained;
  if (is_new && !evidence.continuum) evidence.complete = evidence.branches_complete = false;
  return is_new;
}

/// Searches for a proof that there is no solution.
void check_invariants(const Request& request, StageResult& found) {
  UnconstrainedResult& evidence = found.unconstrained;
  evidence.violation =
      invariant_violation(request.arm, request.goal, request.task, request.tolerance);
  evidence.complete = evidence.branches_complete = evidence.violation.has_value();
}

/// Whether a search may find solutions that are missing.
bool needs_search(const SolverState& state, const Request& request, StageResult& found) {
  const UnconstrainedResult& evidence = found.unconstrained;
  const bool none = found.solutions->empty();
  const bool missing = none || (evidence.doubtful && request.options.all);
  // All solutions were examined, except that another member of a continuum may be within limits.
  const bool proved =
      evidence.range_examined || (evidence.complete && !(evidence.continuum && none));
  return missing && !proved && state.options.method != InverseMethod::closed_form &&
         !is_out_of_reach(state, request);
}

/// Adds the solutions of the family, and replaces the evidence by its own.
void run_family(const AnalyticFamily& family, SolverState& state, const Request& request,
                StageResult& found) {
  UnconstrainedResult& evidence = found.unconstrained;
  evidence = {};
  evidence.complete = evidence.branches_complete = true;
  family.solve(state, request, found);
  evidence.complete = evidence.complete && !evidence.doubtful;
  evidence.branches_complete = evidence.branches_complete && !evidence.doubtful;
  found.result.singular = evidence.continuum && !found.solutions->empty();
}

/// Whether run_quick_stages() may solve the request.
bool has_quick_stages(const SolverState& state, const Request& request) {
  const InverseOptions& options = request.options;
  if (request.seed.cwiseAbs().maxCoeff() > farthest_seed) return false;
  if (options.every_turn && options.lock) return false;  // the locked joint keeps its value
  if (state.family != nullptr && request.finitely_many()) return true;
  const bool any_one = !options.all && request.redundancy == Redundancy::any;
  return any_one && (state.family ? options.method == InverseMethod::automatic : !options.lock);
}

}  // namespace

bool has_revolute_joints(const SolverState& state, int count) {
  const std::vector<Joint>& joints = state.arm.joints();
  return state.arm.dof() == count && std::ssize(joints) == count && state.task.size() == 6 &&
         std::all_of(joints.begin(), joints.end(),
                     [](const Joint& joint) { return kind(joint) == JointKind::revolute; });
}

void select_family(SolverState& state) {
  const InverseOptions& options = state.options;
  if (options.method == InverseMethod::numerical) return;
  const bool one = !options.all && options.method != InverseMethod::closed_form;
  for (const AnalyticFamily* family : families) {
    if (one && family->slower_than_search) {
      if (!state.fallback) state.fallback = family;
    } else if (family->applies(state)) {
      state.family = family;
      state.fallback = nullptr;
      return;
    }
  }
}

void run_stages(SolverState& state, const Request& request, StageResult& found) {
  const bool seed_solves = is_solution(request, request.seed);
  if (seed_solves && !request.options.all) add_seed(request, found);
  check_invariants(request, found);
  if (state.family && !found.unconstrained.violation) {
    run_family(*state.family, state, request, found);
  }
  // It takes less time than all restarts, and a search that finds nothing proves nothing.
  if (found.solutions->empty() && state.fallback && needs_search(state, request, found) &&
      state.fallback->applies(state)) {
    run_family(*state.fallback, state, request, found);
  }
  if (needs_search(state, request, found)) solve_numerical(state, request, found);
  if (seed_solves && request.options.all) add_seed(request, found);
  approach_seed(state, request, found);
}

bool run_quick_stages(SolverState& state, const Request& request, StageResult& found) {
  if (!has_quick_stages(state, request)) return false;
  const InverseOptions& options = request.options;
  // run_stages() adds the seed, which the closed form may lose.
  const bool keeps_seed =
      options.all || (!options.lock && request.redundancy != Redundancy::centred);
  const bool is_control_loop =
      request.skips_forward_check && (!state.family || state.family == &pieper_family);
  const bool seed_solves = keeps_seed && !is_control_loop && is_solution(request, request.seed);
  if (seed_solves && request.near_seed) {
    add_seed(request, found);
    return true;
  }
  UnconstrainedResult& evidence = found.unconstrained;
  const bool searches = state.family == nullptr || !request.finitely_many();
  if (seed_solves && searches && !options.all) return false;
  if (searches && is_out_of_reach(state, request)) return state.family && !options.pose_tolerance;
  if (state.family != nullptr) run_family(*state.family, state, request, found);
  if (seed_solves && !options.all) return !add_seed(request, found) && !evidence.continuum;
  const bool none = found.solutions->empty();
  if (searches && none && !evidence.range_examined) solve_numerical(state, request, found);
  if (options.all) {
    if (seed_solves) add_seed(request, found);
    return evidence.complete && !evidence.continuum;
  }
  approach_seed(state, request, found);
  if (!found.solutions->empty()) return !evidence.continuum;
  if (evidence.range_examined) return true;
  // A proof says more.
  return evidence.far && !options.pose_tolerance &&
         !invariant_violation(request.arm, request.goal, request.task, request.tolerance);
}

}  // namespace beeline::internal
