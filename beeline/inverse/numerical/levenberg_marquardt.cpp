#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/internal/mask.h>
#include <beeline/math/damped_least_squares.h>

namespace beeline::internal {
namespace {

/// The linear model of the task at one configuration: the error e and the Jacobian J, such that a
/// step dz changes e to e - J dz to first order. Lengths are in units of `length`, in e and in the
/// coordinates z; rows that the task leaves free are zero.
struct Linearised {
  Jacobian columns;
  Twist error = Twist::Zero();
  Deviation deviation;
  double cost = 0;  ///< |e|^2
};

Eigen::VectorXd coordinate_units(const Arm& arm, double length) {
  Eigen::VectorXd units(arm.dof());
  for (int k = 0; k < arm.dof(); ++k) {
    units[k] = kind(arm.joint_of(k)) == JointKind::prismatic ? length : 1;
  }
  return units;
}

// The factors and the patience were chosen by trial over random poses of the built-in arms; the
// optimum is flat. Less patience abandons starts that would converge, more wastes iterations.
constexpr double first_factor = 0.2;   // damping over squared error
constexpr double min_factor = 1e-3;    // the same, after steps that were all accepted
constexpr double min_damping = 1e-13;  // keeps J J^T regular at singularities
constexpr double largest_step = 1;     // radians, or units of length; range of the linear model
constexpr int patience = 8;            // max steps in which the squared error must halve

/// The problem of one run, and its units.
struct Goal {
  const Arm& arm;
  const Pose& world_T_tool;
  const Task& task;
  const Bounds& bounds;
  double length;
  Eigen::VectorXd units;
};

void linearise(const Goal& goal, const Configuration& q, Linearised& at) {
  const bool tool_axes = goal.task.frame == Frame::tool;
  const Pose world_T_tool = jacobian(goal.arm, q, at.columns, goal.task.frame);
  Twist error = pose_error(goal.world_T_tool, world_T_tool, goal.task.frame);
  const auto& rows = goal.task.rows;
  const auto partly = [&](std::size_t first) {
    return !(rows[first] && rows[first + 1] && rows[first + 2]);
  };
  // The plain Jacobian suffices with all three rows, because its error vanishes with the task's
  // error. With some rows, the free part of the error stays large and contributes to the derivative
  // of the others.
  if (tool_axes && partly(0)) {
    at.columns.topRows<3>() -= hat(error.head<3>()) * at.columns.bottomRows<3>();
  }
  if (partly(3)) {
    const Vector3 rotation = error.tail<3>();
    at.columns.bottomRows<3>() =
        so3_left_jacobian_inverse(tool_axes ? rotation : -rotation) * at.columns.bottomRows<3>();
  }
  error = masked(goal.task, error);
  mask_rows(goal.task, at.columns);
  at.deviation = {error.head<3>().norm(), error.tail<3>().norm()};
  error.head<3>() /= goal.length;
  at.columns.topRows<3>() /= goal.length;
  at.columns.array().rowwise() *= goal.units.transpose().array();
  at.error = error;
  at.cost = error.squaredNorm();
}

/// Buffers of one run, so that its loop does not allocate.
struct Workspace {
  Linearised now, next;
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
void bounded_step(const Goal& goal, const Configuration& q, double damping, Workspace& work) {
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

void check_goal(const Arm& arm, const Pose& world_T_tool, const Task& task, const Bounds& bounds,
                const NumericalOptions& options) {
  if (!world_T_tool.matrix().allFinite()) throw Error("the pose has a number that is not finite");
  check_task(arm, task, bounds);
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance) || options.max_iterations < 0) {
    throw Error("tolerance must be above zero, and max_iterations zero or more; not " +
                number(options.tolerance) + " and " + std::to_string(options.max_iterations));
  }
}

}  // namespace

NumericalResult levenberg_marquardt(const Arm& arm, const Pose& world_T_tool, const Task& task,
                                    const Bounds& bounds, const Configuration& start,
                                    const NumericalOptions& options) {
  check_configuration(arm, start);
  check_goal(arm, world_T_tool, task, bounds, options);
  const double length = unit_of_length(arm);
  const Goal goal{arm, world_T_tool, task, bounds, length, coordinate_units(arm, length)};
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
