#include <algorithm>

#include <beeline/error.h>
#include <beeline/inverse/analytic/planar_solver.h>
#include <beeline/inverse/internal/request.h>
#include <beeline/inverse/internal/solver_state.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {
namespace {

/// Whether the arm has six revolute joints, each driven by its own coordinate.
bool has_six_revolute_joints(const Arm& arm, const Task& task) {
  return arm.dof() == 6 && arm.joints().size() == 6 && task.size() == 6 &&
         std::all_of(arm.joints().begin(), arm.joints().end(),
                     [](const Joint& joint) { return kind(joint) == JointKind::revolute; });
}

/// Prepares for options.lock: keeps the closed form that takes the coordinate's value as an input,
/// if there is one. Otherwise solve() prepares an arm for each value.
SolverState prepare_locked(SolverState state) {
  if (state.options.method == InverseMethod::numerical) return state;
  state.pieper = PieperSolver::make(state.arm, state.task);
  if (state.pieper && state.pieper->locked() != state.options.lock) state.pieper.reset();
  return state;
}

/// Whether the closed form recovers random configurations of the arm, or reports a continuum. It
/// may do neither if axes of its loop coincide. Sixteen trials suffice, because it then fails
/// almost everywhere. The tolerance 1e-4 is far below the distance of other solutions and far above
/// rounding.
bool recovers_configurations(const PieperSolver& form, const Arm& arm) {
  constexpr int trials = 16;
  const Configuration zero = Configuration::Zero(arm.dof());
  const Bounds open = no_bounds(arm);
  PieperRequest loop = form.request(zero, open.lower, open.upper);
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

}  // namespace

SolverState make_solver_state(const Arm& arm, const InverseOptions& options) {
  check_options(arm, options);
  const Configuration middle = middle_configuration(arm);
  SolverState state{arm, options, options.task.value_or(default_task(arm)),
                    options.ignore_limits ? no_bounds(arm) : bounds_of(arm), middle};
  if (options.seed) check_configuration(arm, *options.seed);
  if (options.lock) return prepare_locked(std::move(state));
  const bool formulas = options.method != InverseMethod::numerical;
  state.planar = formulas && has_planar_closed_form(arm, state.task);
  if (formulas && !state.planar) state.pieper = PieperSolver::make(arm, state.task);
  if (state.pieper) state.pieper_verified = recovers_configurations(*state.pieper, arm);
  state.six_revolute = formulas && !state.pieper && has_six_revolute_joints(arm, state.task);
  // The numerical stage is faster for one solution.
  if (options.all || options.method == InverseMethod::closed_form) {
    state.raghavan_roth = make_raghavan_roth(state);
  }
  if (options.method == InverseMethod::closed_form && !state.planar && !state.pieper &&
      !state.raghavan_roth) {
    throw Error("arm " + arm.name() + " has no closed form for the task " + name(state.task) +
                "; method numerical solves it");
  }
  return state;
}

void check_lock(const SolverState& state, const ConfigurationRef& seed) {
  if (state.options.ignore_limits) return;
  const int k = *state.options.lock;
  const double lower = state.bounds.lower[k], upper = state.bounds.upper[k];
  if (seed[k] >= lower && seed[k] <= upper) return;
  const Joint& joint = state.arm.joint_of(k);
  throw Error("joint " + joint.name + " is locked at " + with_unit(joint, seed[k]) +
              "; its limits are " + with_unit(joint, lower) + " to " + with_unit(joint, upper));
}

std::optional<RaghavanRothSolver> make_raghavan_roth(const SolverState& state) {
  if (!state.six_revolute) return std::nullopt;
  RaghavanRothSolver general(state.arm.chain());
  return general.reliable() ? std::optional(std::move(general)) : std::nullopt;
}

const PreparedSearch& search_within_limits(SolverState& state) {
  if (!state.within_limits) {
    state.within_limits =
        prepared_search(state.arm, state.task, state.bounds, state.options.random_seed);
  }
  return *state.within_limits;
}

std::string method_name(const SolverState& state) {
  if (state.planar) return "closed form: planar";
  if (state.pieper) return "closed form: " + state.pieper->family(state.removed_coordinate);
  if (state.raghavan_roth) return "closed form: general six joints";
  return "numerical";
}

}  // namespace beeline::internal
