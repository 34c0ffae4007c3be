#include <algorithm>
#include <cmath>

#include <beeline/control/internal/resolved_rates.h>

namespace beeline::internal {
namespace {

// Fraction of the norm of A. Damps directions with singular values of this size or less. Its square
// is just above the rounding of A A^T; for other directions the error after two passes is 1e-14.
constexpr double damping = 1e-7;

}  // namespace

ResolvedRates::ResolvedRates(const Arm& arm, const Task& task)
    : task_(arm, task),
      fixed_(static_cast<std::size_t>(arm.dof())),
      x_(arm.dof()),
      previous_(arm.dof()),
      singular_(arm.dof()),
      rates_{Eigen::VectorXd::Zero(arm.dof()), Eigen::VectorXd::Zero(arm.dof())} {}

/// Solves by damped least squares for the coordinates that are not fixed. Returns whether A x = c.
bool ResolvedRates::solve_least_squares() {
  const Jacobian& a = task_.matrix();
  InverseCholesky6::Vector remainder = task_.command();
  InverseCholesky6::Matrix gram = InverseCholesky6::Matrix::Zero();
  for (Eigen::Index k = 0; k < x_.size(); ++k) {
    if (fixed_[k]) {
      remainder -= a.col(k) * x_[k];
    } else {
      x_[k] = 0;
      gram += a.col(k) * a.col(k).transpose();
    }
  }
  gram.diagonal().array() += damping * damping * gram.trace() + 1e-300;
  gram_.factor(gram);
  for (int pass = 0; pass < 2; ++pass) {  // the second pass removes most of the damping's error
    const InverseCholesky6::Vector y = gram_.solve(remainder);
    for (Eigen::Index k = 0; k < x_.size(); ++k) {
      if (fixed_[k]) continue;
      const double change = a.col(k).dot(y);
      x_[k] += change;
      remainder -= change * a.col(k);
    }
  }
  return remainder.norm() <= negligible_command * task_.command().norm() && x_.allFinite();
}

/// Returns the coordinate that exceeds its bound for a position limit by the largest factor; -1
/// when none does.
Eigen::Index ResolvedRates::farthest_outside(const std::vector<VelocityBounds>& bounds) const {
  Eigen::Index worst = -1;
  double largest = 1;
  for (Eigen::Index k = 0; k < x_.size(); ++k) {
    const double v = task_.weight()[k] * x_[k];
    if (bounds[k].limit(v) != ServoLimit::position || fixed_[k]) continue;
    const double allowed = bounds[k].max_speed(v);
    if (!(std::abs(v) > largest * allowed)) continue;
    largest = std::abs(v) / std::max(allowed, 1e-300);
    worst = k;
  }
  return worst;
}

/// Returns whether A x = c; coordinates may be beyond their bounds.
bool ResolvedRates::solve_within_bounds(const std::vector<VelocityBounds>& bounds) {
  std::fill(fixed_.begin(), fixed_.end(), char{0});
  bool solved = solve_least_squares();
  for (Eigen::Index redundant = x_.size() - 6; solved && redundant > 0; --redundant) {
    const Eigen::Index worst = farthest_outside(bounds);
    if (worst < 0) break;
    previous_ = x_;
    fixed_[worst] = 1;
    x_[worst] = (x_[worst] > 0 ? bounds[worst].upper : bounds[worst].lower) / task_.weight()[worst];
    if (!solve_least_squares()) {  // the other coordinates do not suffice: restores the last
                                   // solution
      fixed_[worst] = 0;
      solve_least_squares();
      x_ = previous_;
      break;
    }
  }
  return solved;
}

/// Solves A W^-1 q̈ = -S J̇ q̇ for a constant command. Near a singularity q̈ grows with the inverse
/// of the distance.
void ResolvedRates::fill_acceleration(const ConfigurationRef& q) {
  const InverseCholesky6::Vector y = gram_.solve(task_.derivative(q, rates_.velocity));
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    rates_.acceleration[k] = fixed_[k] ? 0 : -task_.weight()[k] * task_.matrix().col(k).dot(y);
  }
}

const Rates& ResolvedRates::solve(const ConfigurationRef& q,
                                  const std::vector<VelocityBounds>& bounds,
                                  const Eigen::VectorXd& last, double time_step) {
  rates_.regular = solve_within_bounds(bounds);
  rates_.scale = 1;
  if (rates_.regular) {
    singular_.reset();
    rates_.velocity = task_.weight().cwiseProduct(x_);
    fill_acceleration(q);
  } else {
    std::fill(fixed_.begin(), fixed_.end(), char{0});
    singular_.solve(task_, q, last, time_step, rates_);
  }
  return rates_;
}

void ResolvedRates::project_to_null_space(Eigen::VectorXd& velocity) {
  const Jacobian& a = task_.matrix();
  const Eigen::VectorXd& weight = task_.weight();
  InverseCholesky6::Vector moved = InverseCholesky6::Vector::Zero();
  for (Eigen::Index k = 0; k < velocity.size(); ++k) {
    velocity[k] = fixed_[k] ? 0 : velocity[k] / weight[k];
    moved += velocity[k] * a.col(k);
  }
  const InverseCholesky6::Vector y = gram_.solve(moved);
  for (Eigen::Index k = 0; k < velocity.size(); ++k) {
    if (fixed_[k]) continue;
    velocity[k] = weight[k] * (velocity[k] - a.col(k).dot(y));
  }
}

}  // namespace beeline::internal
