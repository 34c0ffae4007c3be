#include <algorithm>
#include <cmath>

#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/inverse/numerical/linear_model.h>
#include <beeline/math/damped_least_squares.h>

namespace beeline::internal {
namespace {

// The factors and the patience were chosen by trial over random poses of the built-in arms; the
// optimum is flat. Less patience abandons starts that would converge, more wastes iterations.
constexpr double first_factor = 0.2;   // damping over squared error
constexpr double min_factor = 1e-3;    // the same, after steps that were all accepted
constexpr double min_damping = 1e-13;  // keeps J J^T regular at singularities
constexpr double largest_step = 1;     // radians, or units of length; range of the linear model
constexpr int patience = 8;            // max steps in which the squared error must halve

/// Computes the damped step within the bounds.
void compute_step(const NumericalGoal& goal, const Configuration& q, const LinearModel& at,
                  double damping, BoundedStep& bounded) {
  constexpr int max_rounds = 10;  // at least one joint stops in each; then the step is clamped
  bounded.begin(at);
  for (int round = 0; round < max_rounds; ++round) {
    const Twist dual = damped_multipliers(bounded.free, bounded.error, damping);
    if (!bounded.take(goal, q, [&](int k) { return bounded.free.col(k).dot(dual); })) return;
  }
}

}  // namespace

NumericalResult levenberg_marquardt(const Arm& arm, const Pose& world_T_tool, const Task& task,
                                    const Bounds& bounds, const Configuration& start,
                                    const NumericalOptions& options) {
  const NumericalGoal goal = numerical_goal(arm, world_T_tool, task, bounds, start, options);
  // The loop does not allocate.
  LinearModel now(arm.dof()), next(arm.dof());
  BoundedStep bounded(arm.dof());
  Configuration trial;
  NumericalResult run;
  run.q = clamped(bounds, start);
  linearise(goal, run.q, now);
  double factor = first_factor;
  double milestone = now.cost;
  for (; run.iterations < options.max_iterations && now.cost > 0 && std::isfinite(now.cost);
       ++run.iterations) {
    if (options.budget.ended()) break;
    const bool polishing = options.accepts(now.deviation);
    const double before = now.cost;
    // Damping that falls with the error's square keeps convergence quadratic (Sugihara 2011).
    compute_step(goal, run.q, now, factor * before + min_damping, bounded);
    const double longest = bounded.step.cwiseAbs().maxCoeff();
    if (longest > largest_step) bounded.step *= largest_step / longest;
    trial = run.q + goal.units.cwiseProduct(bounded.step);
    trial = clamped(bounds, std::move(trial));
    const bool finite = trial.allFinite();
    if (finite) linearise(goal, trial, next);
    if (finite && next.cost < before) {
      run.q.swap(trial);
      std::swap(now, next);
      factor = std::max(factor / 2, min_factor);
    } else {
      factor *= 4;
    }
    if (polishing && !(now.cost < before / 4)) break;  // rounding, or slow convergence
    if ((run.iterations + 1) % patience == 0) {
      if (!options.accepts(now.deviation) && now.cost > milestone / 2) break;
      milestone = now.cost;
    }
  }
  run.error = now.deviation;
  run.converged = options.accepts(run.error);
  return run;
}

}  // namespace beeline::internal
