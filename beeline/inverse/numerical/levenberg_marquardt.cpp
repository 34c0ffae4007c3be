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

/// Buffers of one run, so that its loop does not allocate.
struct Workspace {
  LinearModel now, next;
  Jacobian free;  ///< the columns of the joints that are not held at a bound
  Eigen::VectorXd step;
  std::vector<char> held;
  Configuration trial;
};

void clamp_to(const Bounds& bounds, Configuration& q) {
  q = q.cwiseMax(bounds.lower).cwiseMin(bounds.upper);
}

/// Computes the damped step within the bounds. Joints that would pass a bound stop there, and the
/// step of the others is solved again for the remaining error.
void bounded_step(const NumericalGoal& goal, const Configuration& q, double damping,
                  Workspace& work) {
  constexpr int max_rounds = 10;  // at least one joint stops in each; then the step is clamped
  work.free = work.now.columns;
  std::fill(work.held.begin(), work.held.end(), 0);
  Twist left = work.now.error;
  for (int round = 0; round < max_rounds; ++round) {
    const Twist dual = damped_multipliers(work.free, left, damping);
    bool stopped = false;
    for (int k = 0; k < q.size(); ++k) {
      char& held = work.held[k];
      if (held) continue;
      const double wanted = work.free.col(k).dot(dual);
      work.step[k] = std::clamp(wanted, (goal.bounds.lower[k] - q[k]) / goal.units[k],
                                (goal.bounds.upper[k] - q[k]) / goal.units[k]);
      if (work.step[k] == wanted) continue;
      held = 1;
      stopped = true;
      left -= work.free.col(k) * work.step[k];
      work.free.col(k).setZero();
    }
    if (!stopped) return;
  }
}

}  // namespace

NumericalResult levenberg_marquardt(const Arm& arm, const Pose& world_T_tool, const Task& task,
                                    const Bounds& bounds, const Configuration& start,
                                    const NumericalOptions& options) {
  check_configuration(arm, start);
  const NumericalGoal goal = numerical_goal(arm, world_T_tool, task, bounds, options);
  Workspace work;
  work.now.columns.resize(6, arm.dof());
  work.next.columns.resize(6, arm.dof());
  work.step.resize(arm.dof());
  work.held.resize(static_cast<std::size_t>(arm.dof()));

  NumericalResult run;
  run.q = start;
  clamp_to(bounds, run.q);
  linearise(goal, run.q, work.now);
  const auto within = [&](const Deviation& left) {
    return left.position <= options.tolerance && left.orientation <= options.tolerance;
  };
  double factor = first_factor;
  double milestone = work.now.cost;
  for (;
       run.iterations < options.max_iterations && work.now.cost > 0 && std::isfinite(work.now.cost);
       ++run.iterations) {
    if (ended(options.budget)) break;
    const bool polishing = within(work.now.deviation);
    const double before = work.now.cost;
    // Damping that falls with the error's square keeps convergence quadratic (Sugihara 2011).
    bounded_step(goal, run.q, factor * before + min_damping, work);
    const double longest = work.step.cwiseAbs().maxCoeff();
    if (longest > largest_step) work.step *= largest_step / longest;
    work.trial = run.q + goal.units.cwiseProduct(work.step);
    clamp_to(bounds, work.trial);
    const bool finite = work.trial.allFinite();
    if (finite) linearise(goal, work.trial, work.next);
    if (finite && work.next.cost < before) {
      run.q.swap(work.trial);
      std::swap(work.now, work.next);
      factor = std::max(factor / 2, min_factor);
    } else {
      factor *= 4;
    }
    if (polishing && !(work.now.cost < before / 4)) break;  // rounding, or slow convergence
    if ((run.iterations + 1) % patience == 0) {
      if (!within(work.now.deviation) && work.now.cost > milestone / 2) break;
      milestone = work.now.cost;
    }
  }
  run.error = work.now.deviation;
  run.converged = within(run.error);
  return run;
}

}  // namespace beeline::internal
