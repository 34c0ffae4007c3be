#include <algorithm>
#include <iterator>

#include <beeline/inverse/internal/analytic_families.h>

namespace beeline::internal {
namespace {

/// A new family is added as a row here, before those that cover more arms.
constexpr const AnalyticFamily* families[] = {
    &planar_family,
    &pieper_family,
    &locked_joint_family,
    &raghavan_roth_family,
};

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

void solve_analytic(const AnalyticFamily& family, SolverState& state, const Request& request,
                    StageResult& found) {
  UnconstrainedResult& evidence = found.unconstrained;
  evidence = {};
  evidence.complete = evidence.branches_complete = true;
  family.solve(state, request, found);
  evidence.complete = evidence.complete && !evidence.doubtful;
  evidence.branches_complete = evidence.branches_complete && !evidence.doubtful;
  found.result.singular = evidence.continuum && !found.result.solutions.empty();
}

}  // namespace beeline::internal
