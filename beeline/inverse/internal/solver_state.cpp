#include <beeline/error.h>
#include <beeline/inverse/internal/analytic_families.h>
#include <beeline/inverse/internal/request.h>
#include <beeline/inverse/internal/solver_state.h>

namespace beeline::internal {

SolverState make_solver_state(const Arm& arm, const InverseOptions& options,
                              const RaghavanRothSolver* similar) {
  check_options(arm, options);
  const Configuration middle = middle_configuration(arm);
  SolverState state{arm,
                    options,
                    options.task.value_or(default_task(arm)),
                    ToolPlane::required(arm, options.task),
                    options.ignore_limits ? no_bounds(arm) : bounds_of(arm),
                    middle,
                    options.weights.value_or(Configuration::Ones(arm.dof()))};
  if (options.seed) check_configuration(arm, *options.seed);
  state.similar = similar;
  select_family(state);
  state.similar = nullptr;
  if (options.method == InverseMethod::closed_form && !options.lock && !state.family) {
    throw Error::of("method", "arm " + arm.name() + " has no closed form for the task " +
                                  name(state.task) + "; method numerical solves it");
  }
  return state;
}

void check_lock(const SolverState& state, const ConfigurationRef& seed) {
  if (state.options.ignore_limits) return;
  const int k = *state.options.lock;
  const double lower = state.bounds.lower[k], upper = state.bounds.upper[k];
  if (seed[k] >= lower && seed[k] <= upper) return;
  const Joint& joint = state.arm.joint_of(k);
  throw Error::of("lock", "joint " + joint.name + " is locked at " + with_unit(joint, seed[k]) +
                              "; its limits are " + with_unit(joint, lower) + " to " +
                              with_unit(joint, upper));
}

const PreparedSearch& search_within_limits(SolverState& state) {
  if (!state.within_limits) {
    state.within_limits =
        prepared_search(state.arm, state.task, state.bounds, state.options.random_seed);
  }
  return *state.within_limits;
}

std::string method_name(const SolverState& state) {
  return state.family ? "closed form: " + state.family->name(state) : "numerical";
}

}  // namespace beeline::internal
