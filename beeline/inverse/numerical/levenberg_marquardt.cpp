#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>

namespace beeline::internal {
namespace {

/// The task at one configuration: the error e and the Jacobian of its decrease (e falls by J dz),
/// both weighted (lengths in units of `length`, rows that do not matter zero), and z the
/// coordinates in the same units.
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

// Found by trial over random poses of the built-in arms; the optimum is flat.
constexpr double first_factor = 0.2;     // damping over squared error
constexpr double least_factor = 1e-3;    // the same, where all goes well
constexpr double least_damping = 1e-13;  // keeps the normal equations regular, whatever the arm
constexpr double largest_step = 1;       // radians, or units of length: beyond, J tells nothing
constexpr int patience = 8;              // steps in which the squared error must halve

/// What one run is for, and the units it counts in.
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
  // With all three rows the plain Jacobian leads straight to the goal. With some, the free part of
  // the error may stay large, and turns the others' rate of change.
  if (tool_axes && partly(0)) {
    at.columns.topRows<3>() -= hat(error.head<3>()) * at.columns.bottomRows<3>();
  }
  if (partly(3)) {
    const Vector3 turn = error.tail<3>();
    at.columns.bottomRows<3>() =
        so3_left_jacobian_inverse(tool_axes ? turn : -turn) * at.columns.bottomRows<3>();
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

void bring_within(const Bounds& bounds, Configuration& q) {
  q = q.cwiseMax(bounds.lower).cwiseMin(bounds.upper);
}

/// The damped step within the bounds: joints that it would carry through a bound are stopped there,
/// and the others solved again for what is left.
void bounded_step(const Goal& goal, const Configuration& q, double damping, Workspace& work) {
  constexpr int max_rounds = 10;  // after these the bounds cut off what still sticks out
  work.free = work.now.columns;
  std::fill(work.held.begin(), work.held.end(), 0);
  Twist left = work.now.error;
  for (int round = 0; round < max_rounds; ++round) {
    Matrix6 normal = work.free * work.free.transpose();
    normal.diagonal().array() += damping;
    const Twist dual = normal.ldlt().solve(left);
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
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance) || options.iterations < 0) {
    throw Error("tolerance must be above zero, and iterations zero or more; not " +
                number(options.tolerance) + " and " + std::to_string(options.iterations));
  }
}

}  // namespace

double unit_of_length(const Arm& arm) {
  const double reach = arm.reach().radius;
  return std::isfinite(reach) && reach > 0 ? reach : 1;
}

Bounds no_bounds(const Arm& arm) {
  return {Configuration::Constant(arm.dof(), -Limits::none),
          Configuration::Constant(arm.dof(), Limits::none)};
}

void check_task(const Arm& arm, const Task& task, const Bounds& bounds) {
  check_task(task);
  if (bounds.lower.size() != arm.dof() || bounds.upper.size() != arm.dof() ||
      !(bounds.lower.array() <= bounds.upper.array()).all()) {
    throw Error("the bounds for arm " + arm.name() + " need " + std::to_string(arm.dof()) +
                " lower values, none above its upper one");
  }
}

Bounds bounds_of(const Arm& arm) {
  Bounds bounds = no_bounds(arm);
  for (int k = 0; k < arm.dof(); ++k) {
    bounds.lower[k] = arm.limits(k).lower;
    bounds.upper[k] = arm.limits(k).upper;
  }
  return bounds;
}

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
  bring_within(bounds, run.q);
  linearise(goal, run.q, work.now);
  const auto within = [&](const Deviation& left) {
    return left.position <= options.tolerance && left.orientation <= options.tolerance;
  };
  double factor = first_factor;
  double milestone = work.now.cost;
  for (; run.iterations < options.iterations && work.now.cost > 0 && std::isfinite(work.now.cost);
       ++run.iterations) {
    const bool polishing = within(work.now.deviation);
    const double before = work.now.cost;
    // Damping that falls with the error's square keeps convergence quadratic (Sugihara 2011).
    bounded_step(goal, run.q, factor * before + least_damping, work);
    const double longest = work.step.cwiseAbs().maxCoeff();
    if (longest > largest_step) work.step *= largest_step / longest;
    work.trial = run.q + goal.units.cwiseProduct(work.step);
    bring_within(bounds, work.trial);
    const bool finite = work.trial.allFinite();
    if (finite) linearise(goal, work.trial, work.next);
    if (finite && work.next.cost < before) {
      run.q.swap(work.trial);
      std::swap(work.now, work.next);
      factor = std::max(factor / 2, least_factor);
    } else {
      factor *= 4;
    }
    if (polishing && !(work.now.cost < before / 4)) break;  // rounding level, or slow: good enough
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
