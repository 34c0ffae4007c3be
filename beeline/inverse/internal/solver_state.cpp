#include <beeline/error.h>
#include <beeline/inverse/internal/analytic_family.h>
#include <beeline/inverse/internal/request.h>
#include <beeline/inverse/internal/solver_state.h>
#include <beeline/inverse/internal/stages.h>

namespace beeline::internal {

ArmDefaults ArmDefaults::make(const Arm& arm, const Key&) {
  return {bounds_of(arm),
          no_bounds(arm),
          middle_configuration(arm),
          Configuration::Ones(arm.dof()),
          ToolPlane::required(arm, std::nullopt),
          ToolVolume(arm)};
}

std::size_t ArmDefaults::heap_bytes() const {
  return 6 * sizeof(double) * ones.size() + (plane ? plane->heap_bytes() : 0);
}

SolverState::SolverState(const Arm& its_arm, const InverseOptions& its_options,
                         const EliminationChoice* similar_choice)
    : arm(its_arm),
      options(checked_options(its_arm, its_options)),
      defaults(its_arm),
      task(options.task ? *options.task : default_task(its_arm)),
      bounds(options.ignore_limits ? defaults->no_limits : defaults->limits),
      weights(options.weights ? *options.weights : defaults->ones),
      similar(similar_choice) {
  select_family(*this);
  redundancy = options.redundancy.value_or(Redundancy::any);
  if (options.seed) set_near_seed();
  if (options.method == InverseMethod::closed_form && !options.lock && family == nullptr) {
    throw Error::of("method", "arm " + arm.name() + " has no closed form for the task " +
                                  name(task) + "; method numerical solves it");
  }
}

void SolverState::set_near_seed() {
  near_seed = !options.redundancy && !options.all && !options.lock &&
              options.method == InverseMethod::automatic && family == &pieper_family &&
              arm.dof() > task.size();
}

const ToolPlane* SolverState::plane() const {
  return options.task || !defaults->plane ? nullptr : &*defaults->plane;
}

MultiStartBuffers& SolverState::buffers() {
  search();
  return (*scratch)->buffers;
}

SearchResult& SolverState::search() {
  if (!scratch) {
    scratch.emplace();
    reset_search();
  }
  return (*scratch)->result;
}

void SolverState::reset_search() {
  if (scratch) (*scratch)->result.iterations = (*scratch)->result.restarts = 0;
}

bool is_out_of_reach(const SolverState& state, const Request& request) {
  return state.defaults->volume.excludes(request.goal, request.task, request.tolerance,
                                         /*ignore_limits=*/true);
}

bool is_out_of_reach_within_bounds(const SolverState& state, const Request& request) {
  return state.defaults->volume.excludes(request.goal, request.task, request.tolerance,
                                         state.options.ignore_limits);
}

const NumericalProblem& problem_within_bounds(SolverState& state) {
  if (!state.bounded_problem) {
    state.bounded_problem.emplace(state.arm,
                                  NumericalProblem::Key{state.task, state.options.ignore_limits});
  }
  return **state.bounded_problem;
}

Search search_within_bounds(SolverState& state) {
  const NumericalProblem& problem = problem_within_bounds(state);
  return {state.arm, problem, seeds_for(state, state.options.ignore_limits, problem)};
}

const SeedTable& seeds_for(SolverState& state, bool ignore_limits,
                           const NumericalProblem& problem) {
  std::optional<Kept<SeedTable>>& seeds = state.seeds[ignore_limits];
  const SeedTable::Key key{ignore_limits, state.options.random_seed};
  if (!seeds) seeds.emplace(state.arm, key, problem);
  return **seeds;
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

std::string method_name(const SolverState& state) {
  return state.family ? "closed form: " + state.family->name(state) : "numerical";
}

}  // namespace beeline::internal
