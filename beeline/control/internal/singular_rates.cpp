#include <algorithm>
#include <cmath>

#include <beeline/control/internal/singular_rates.h>
#include <beeline/control/internal/velocity_bounds.h>

namespace beeline::internal {
namespace {

// Thresholds on singular values, relative to the largest one. Between `lost` and `zero`, n still
// moves the tool along u to first order, which determines its sign. Below `exact`, the direction of
// A^T u is rounding.
constexpr double lost_below = 1e-5;
constexpr double zero_below = 1e-6;
constexpr double exact_above = 1e-12;

constexpr double still_below = 1e-6;  // fraction of full speed; slower motions count as rest

// Relative to the largest singular value; a curvature of smaller magnitude counts as zero. Greater
// than the error of the difference quotient in WeightedTask::derivative().
constexpr double flat_below = 1e-4;

// The fraction of the acceleration limits for the null motion. Half of it accelerates the motion,
// which must be able to stop again within its distance.
constexpr double null_acceleration = 0.25;

}  // namespace

SingularRates::SingularRates(int dof) : x_(dof), null_(dof), candidate_(dof) {
  svd_.scaled_right.resize(dof, 6);
}

bool SingularRates::is_zero(const LostDirection& lost) const {
  return lost.value <= zero_below * largest_;
}

/// Sets x_ to the minimum-norm solution for the directions that are not lost. Returns the lost
/// direction with the largest component of the command; -1 when all components are negligible.
Eigen::Index SingularRates::solve_other_directions(const WeightedTask& task) {
  const auto& values = svd_.singular_values;
  x_.setZero();
  Eigen::Index lost = -1;
  double largest = negligible_command * task.command().norm();
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double component = svd_.left.col(i).dot(task.command());
    if (values[i] > lost_below * largest_) {
      x_ += component / (values[i] * values[i]) * svd_.scaled_right.col(i);
    } else if (std::abs(component) > largest) {
      largest = std::abs(component);
      lost = i;
    }
  }
  return lost;
}

/// Sets null_ to the motion of unit length that moves the tool only along direction `index`, or not
/// at all; returns whether there is one.
bool SingularRates::fill_null_motion(Eigen::Index index) {
  const auto& values = svd_.singular_values;
  if (values[index] > exact_above * largest_) {
    null_ = svd_.scaled_right.col(index) / values[index];
    return true;
  }
  double longest = 0;  // longest projection of a unit vector onto the null space
  for (Eigen::Index joint = 0; joint < null_.size(); ++joint) {
    candidate_.setZero();
    candidate_[joint] = 1;
    for (int pass = 0; pass < 2; ++pass) {  // the second pass removes the rounding of the first
      for (Eigen::Index i = 0; i < 6; ++i) {
        if (!(values[i] > exact_above * largest_)) continue;
        const auto row = svd_.scaled_right.col(i);
        candidate_ -= row.dot(candidate_) / (values[i] * values[i]) * row;
      }
    }
    const double length = candidate_.norm();
    if (length > longest) {
      longest = length;
      null_ = candidate_ / length;
    }
  }
  return longest > 1e-6;  // shorter projections are rounding
}

SingularRates::LostDirection SingularRates::describe(WeightedTask& task, const ConfigurationRef& q,
                                                     Eigen::Index index, Rates& rates) {
  LostDirection lost;
  lost.index = index;
  lost.u = svd_.left.col(index);
  lost.value = svd_.singular_values[index];
  lost.command = lost.u.dot(task.command());
  rates.velocity = task.weight().cwiseProduct(null_);
  lost.second = task.derivative(q, rates.velocity);
  lost.curvature = lost.u.dot(lost.second);
  lost.rate = task.lost_direction_rate(lost.u, x_);
  lost.curved = std::abs(lost.curvature) > flat_below * largest_ * task.weight().maxCoeff();
  lost.achievable = lost.curved && lost.curvature * lost.command > 0;
  return lost;
}

/// Returns the largest speed along n with which the joints can stop before n must end: at the
/// singularity if the motion would reverse there, or when u has rotated away from the command.
double SingularRates::max_null_speed(const LostDirection& lost, double sign,
                                     const WeightedTask& task, const Rates& rates,
                                     double time_step) const {
  double distance = Limits::none;
  if (lost.curved && !lost.achievable) {
    distance = lost.value / std::abs(lost.curvature);
  } else if (!lost.curved && sign * lost.command * lost.rate < 0) {
    distance = std::abs(lost.command / lost.rate) / 2;
  }
  double speed = 1 / null_.lpNorm<Eigen::Infinity>();
  for (Eigen::Index k = 0; k < null_.size(); ++k) {
    const double v = std::abs(rates.velocity[k]);
    const double acceleration = task.arm().limits(k).acceleration * null_acceleration;
    if (v > 0) {
      speed = std::min(speed, max_stopping_speed(distance * v, acceleration, time_step) / v);
    }
  }
  return speed;
}

/// Adds the motion along n to x_, sets rates.acceleration, and returns the scale.
double SingularRates::solve_lost_direction(const LostDirection& lost, const WeightedTask& task,
                                           const Eigen::VectorXd& last, double time_step,
                                           Rates& rates) {
  const double demand = std::abs(lost.command);
  double current = null_.dot(last.cwiseQuotient(task.weight()));  // speed along n
  double sign = lost.command > 0 ? 1 : -1;
  if (is_zero(lost)) {  // both signs serve equally: continues the arm's motion
    if (std::abs(current) < still_below) current = lost.curved ? 1 : -lost.command * lost.rate;
    sign = current < 0 ? -1 : 1;
  }
  double speed = max_null_speed(lost, sign, task, rates, time_step);
  // The tool's velocity along u at this speed, including the effect of the curvature within the
  // step.
  const double gain = lost.achievable ? std::abs(lost.curvature) * time_step / 2 : 0;
  const auto achieved = [&](double s) { return (lost.value + gain * s) * s; };
  if (achieved(speed) > demand) {
    speed = 2 * demand / (lost.value + std::sqrt(lost.value * lost.value + 4 * gain * demand));
  }
  double scale = std::min(1.0, achieved(speed) / demand);
  if (lost.curved && !lost.achievable && (scale < lost_below || is_zero(lost))) {
    x_.setZero();  // the arm is at the boundary of the workspace
    return 0;
  }
  if (sign * current < -still_below) {  // the motion along n must reverse first
    x_.setZero();
    scale = 0;
  }
  x_ = scale * x_ + sign * speed * null_;
  // Keeps the other directions' velocities constant: n changes as the arm moves along it.
  const auto& values = svd_.singular_values;
  for (Eigen::Index i = 0; i < 6; ++i) {
    if (i == lost.index || !(values[i] > lost_below * largest_)) continue;
    const double part = speed * speed * svd_.left.col(i).dot(lost.second) / (values[i] * values[i]);
    rates.acceleration -= part * task.weight().cwiseProduct(svd_.scaled_right.col(i));
  }
  return scale;
}

void SingularRates::solve(WeightedTask& task, const ConfigurationRef& q,
                          const Eigen::VectorXd& last, double time_step, Rates& rates) {
  svd_.compute(task.matrix());
  largest_ = svd_.singular_values.maxCoeff();
  rates.acceleration.setZero();
  rates.scale = 1;
  const Eigen::Index index = solve_other_directions(task);
  if (index >= 0 && fill_null_motion(index)) {
    const LostDirection lost = describe(task, q, index, rates);
    rates.scale = solve_lost_direction(lost, task, last, time_step, rates);
  } else if (index >= 0) {  // fewer joints than rows, and no null motion
    x_.setZero();
    rates.scale = 0;
  }
  rates.velocity = task.weight().cwiseProduct(x_);
}

}  // namespace beeline::internal
