#include <algorithm>
#include <cmath>

#include <beeline/control/internal/goal_solver.h>
#include <beeline/kinematics/internal/mask.h>
#include <beeline/math/decompositions.h>
#include <beeline/planning/internal/null_space.h>

namespace beeline::internal {
namespace {

constexpr int max_goal_steps = 8;  // from a command to the next, two suffice
constexpr double solved = 1e-12;   // |c|, rounding is about 1e-15
constexpr double unsolved = 1e-4;  // |c| of a pose that may be out of reach

// Fraction of the squared norm of A's columns. The smallest damping only keeps the factors finite.
constexpr double min_damping = 1e-12;

// An accepted step reduces |c|^2 by at least this fraction of the linear model's prediction. At its
// end, the slope of |c|^2 along the step with the opposite sign is at most this fraction of the
// slope at its start, so the step does not pass the minimum.
constexpr double min_gain_ratio = 0.55;
constexpr double max_slope_ratio = 0.02;

// Away from a solution, at a boundary of the workspace, a step that reduces |c| by less than this
// is not taken: it would remove the last bend of the arm, and the side of the elbow would be lost.
constexpr double negligible_reduction = 1e-8;

// Speed of the null-space motion away from the position limits, relative to the motion of the step.
// saddle_step is the length of a step that leaves a saddle of the error, relative to the velocity
// limits, s.
constexpr double goal_null_space_speed = 0.5;
constexpr double saddle_step = 0.02;

/// Returns minus half of the slope of |c|^2 along x; the error c has the derivative -A.
double descent(const Jacobian& a, const WeightedTask::Rows& c, const Eigen::VectorXd& x) {
  double sum = 0;
  for (Eigen::Index k = 0; k < x.size(); ++k) sum += x[k] * a.col(k).dot(c);
  return sum;
}

}  // namespace

GoalSolver::GoalSolver(const Arm& arm, const Task& task)
    : task_(arm, task),
      rows_(task),
      positions_(bounds_of(arm)),
      redundant_(arm.dof() > task.size()),
      least_squares_(arm.dof()),
      goal_(Configuration::Zero(arm.dof())),
      trial_(arm.dof()),
      crossed_(arm.dof()),
      a_(6, arm.dof()),
      c_(Rows::Zero()),
      error_(Twist::Zero()),
      trial_error_(Twist::Zero()),
      x_(arm.dof()),
      bias_(arm.dof()),
      lower_(arm.dof()),
      upper_(arm.dof()) {}

void GoalSolver::reset(const ConfigurationRef& q) {
  goal_ = q;
  damping_ = 0;
}

/// Sets task_ and trial_error_ at trial_. Returns |c|^2.
double GoalSolver::evaluate_trial(const Pose& world_T_tool) {
  const Pose tool = task_.set_configuration(trial_);
  trial_error_ = masked(rows_, pose_error(world_T_tool, tool, rows_.frame));
  task_.set_command(trial_error_);
  return task_.command().squaredNorm();
}

void GoalSolver::accept_trial(double cost) {
  goal_ = trial_;
  error_ = trial_error_;
  a_ = task_.matrix();
  c_ = task_.command();
  cost_ = cost;
}

/// Computes the damped step x_ from the goal, with null-space motion for a redundant arm, and
/// trial_ from it.
void GoalSolver::fill_step(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper) {
  const Eigen::VectorXd& weight = task_.weight();
  lower_ = (lower - goal_).cwiseQuotient(weight);
  upper_ = (upper - goal_).cwiseQuotient(weight);
  bias_.setZero();
  x_ = least_squares_.solve(a_, c_, damping_, bias_, lower_, upper_);
  if (redundant_) {
    const double speed = goal_null_space_speed * x_.lpNorm<Eigen::Infinity>();
    for (Eigen::Index k = 0; k < x_.size(); ++k) {
      bias_[k] = speed * push_from_limits(goal_[k], positions_.lower[k], positions_.upper[k]);
    }
    if (!bias_.isZero(0)) {
      x_ = least_squares_.solve(a_, c_, damping_, bias_, lower_, upper_);
    }
  }
  trial_ = (goal_ + weight.cwiseProduct(x_)).cwiseMax(lower).cwiseMin(upper);
}

/// Tries one step. After `rejected` the damping increases; after `none` the goal is stationary.
GoalSolver::StepOutcome GoalSolver::improve(const Pose& world_T_tool, const Eigen::VectorXd& lower,
                                            const Eigen::VectorXd& upper) {
  const double size = a_.squaredNorm();
  damping_ = std::clamp(damping_, min_damping * size, std::max(std::sqrt(cost_), 1e-6) * size);
  fill_step(lower, upper);
  Rows remainder = c_;
  for (Eigen::Index k = 0; k < x_.size(); ++k) remainder -= x_[k] * a_.col(k);
  const double predicted = cost_ - remainder.squaredNorm();
  if (!(predicted > 1e-15 * cost_)) return StepOutcome::none;
  const double cost = evaluate_trial(world_T_tool);
  const double ratio = (cost_ - cost) / predicted;
  const bool passed =
      -descent(task_.matrix(), task_.command(), x_) > max_slope_ratio * descent(a_, c_, x_);
  if ((!(ratio >= min_gain_ratio) || passed) && cost > solved * solved) {
    damping_ = std::max(10 * damping_, 0.01 * std::sqrt(cost_) * size);
    return StepOutcome::rejected;
  }
  const double reduction = cost_ - cost;
  if (ratio < 1 && reduction < 1e-3 * cost_ &&
      reduction < 2 * negligible_reduction * std::sqrt(cost_)) {
    return StepOutcome::none;
  }
  if (ratio > 0.75) damping_ /= 10;
  accept_trial(cost > unsolved * unsolved ? cost_on_same_side(cost, world_T_tool) : cost);
  return StepOutcome::yes;
}

/// Returns the determinant of A if it has as many coordinates as rows. Its sign changes at a
/// singularity.
double GoalSolver::determinant(const Jacobian& a) const {
  Matrix6 square = Matrix6::Zero();
  square.leftCols(a.cols()) = a;
  Eigen::Index column = a.cols();
  for (int i = 0; i < 6; ++i) {
    if (!rows_.rows[i]) square(i, column++) = 1;
  }
  return square.determinant();
}

/// Sets bias_ to a direction of the null space of A, of length saddle_step. Squared singular values
/// up to `damping` count as zero. Returns whether there is such a direction.
bool GoalSolver::fill_null_direction(double damping) {
  for (Eigen::Index k = 0; k < x_.size(); ++k) {
    bias_[k] = (k % 2 == 0 ? 1 : -1) / (1 + 0.3 * static_cast<double>(k));  // any direction
    lower_[k] = -Limits::none;
    upper_[k] = Limits::none;
  }
  bias_ = least_squares_.solve(a_, Rows::Zero(), damping, bias_, lower_, upper_);
  const double size = bias_.lpNorm<Eigen::Infinity>();
  if (!(size > 1e-3)) return false;
  bias_ *= saddle_step / size;
  return true;
}

/// If the arm is stretched out towards a pose beyond its reach, a step across the singularity
/// hardly changes the error. Moves trial_ back to the side of the goal along the null space of A,
/// if that does not increase the error. At a singularity that null-space motion does not leave on
/// that side, such as a wrist singularity, the step stays. Returns |c|^2 at trial_.
double GoalSolver::cost_on_same_side(double cost, const Pose& world_T_tool) {
  if (trial_.size() != rows_.size()) return cost;
  const double before = determinant(a_), after = determinant(task_.matrix());
  if (!(before * after < 0) || !fill_null_direction(1e-5 * a_.squaredNorm())) return cost;
  crossed_ = trial_;
  for (const double sign : {1.0, -1.0}) {
    trial_ = crossed_ + sign * task_.weight().cwiseProduct(bias_);
    evaluate_trial(world_T_tool);
    const double beyond = determinant(task_.matrix());
    if (!(beyond * before > 0)) continue;
    const double part = std::min(1.0, (before - after) / (beyond - after));
    trial_ = (crossed_ + sign * part * task_.weight().cwiseProduct(bias_))
                 .cwiseMax(positions_.lower)
                 .cwiseMin(positions_.upper);
    const double moved = evaluate_trial(world_T_tool);
    if (moved <= cost_ && determinant(task_.matrix()) * before > 0) return moved;
  }
  trial_ = crossed_;
  return evaluate_trial(world_T_tool);
}

/// At a saddle of the error no first-order step reduces the error. An example is an arm that is
/// stretched out exactly, with the pose nearer to its base. Tries a motion in the null space of A
/// both ways.
bool GoalSolver::leave_saddle(const Pose& world_T_tool, const Eigen::VectorXd& lower,
                              const Eigen::VectorXd& upper) {
  if (!fill_null_direction(1e-8 * a_.squaredNorm())) return false;
  for (const double sign : {1.0, -1.0}) {
    trial_ = (goal_ + sign * task_.weight().cwiseProduct(bias_)).cwiseMax(lower).cwiseMin(upper);
    const double cost = evaluate_trial(world_T_tool);
    if (!(cost_ - cost > 2 * negligible_reduction * std::sqrt(cost_))) continue;
    accept_trial(cost);
    return true;
  }
  return false;
}

GoalStatus GoalSolver::status(bool stationary, const Eigen::VectorXd& lower,
                              const Eigen::VectorXd& upper) const {
  GoalStatus status{{error_.head<3>().norm(), error_.tail<3>().norm()}, stationary};
  double largest = 1e-9 * a_.norm() * c_.norm();
  for (Eigen::Index k = 0; k < goal_.size(); ++k) {
    const double gradient = a_.col(k).dot(c_);
    const double slack = gradient > 0 ? upper[k] - goal_[k] : goal_[k] - lower[k];
    if (slack > 1e-12 || !(std::abs(gradient) > largest)) continue;
    largest = std::abs(gradient);
    status.blocking = k;
    status.upwards = gradient > 0;
  }
  return status;
}

GoalStatus GoalSolver::approach(const Pose& world_T_tool, const Eigen::VectorXd& lower,
                                const Eigen::VectorXd& upper) {
  trial_ = goal_.cwiseMax(lower).cwiseMin(upper);
  accept_trial(evaluate_trial(world_T_tool));
  bool stationary = false, left_saddle = false;
  for (int i = 0; i < max_goal_steps && cost_ > solved * solved && !stationary; ++i) {
    if (improve(world_T_tool, lower, upper) != StepOutcome::none) continue;
    stationary = left_saddle || !leave_saddle(world_T_tool, lower, upper);
    left_saddle = true;
  }
  return status(stationary, lower, upper);
}

}  // namespace beeline::internal
