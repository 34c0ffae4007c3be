#include <beeline/timing/internal/duration_problem.h>

namespace beeline {
namespace {

constexpr double side = 1e-6;  // of a step: how far inside its ends are looked at

}  // namespace

DurationProblem::DurationProblem(const SquaredRateSpline& clock,
                                 const Eigen::VectorXd& acceleration, const Eigen::VectorXd& jerk)
    : end_(clock.knots().back()) {
  for (Eigen::Index i = 0; i < jerk.size(); ++i) {
    inverse_limits_.push_back(1 / acceleration[i]);
    inverse_limits_.push_back(1 / jerk[i]);
  }
  const auto add = [&](std::size_t first, double share, double weight) {
    first_steps_.push_back(first);
    numbers_.resize(numbers_.size() + block_size());
    double* at = numbers_.data() + numbers_.size() - block_size();
    for (std::size_t k = first; k < first + lanes; ++k, ++at) {
      if (k >= clock.steps()) {
        moments_.push_back(end_);
        at[0] = 1;  // b is the first coefficient
        continue;
      }
      const double length = clock.knots()[k + 1] - clock.knots()[k];
      moments_.push_back(clock.knots()[k] + share * length);
      const Eigen::Matrix3d rows = clock.rows(k, share);
      for (Eigen::Index r = 0; r < 9; ++r) at[std::size_t(r) * lanes] = rows(r / 3, r % 3);
      at[9 * lanes] = weight * length / end_;
    }
  };
  for (std::size_t k = 0; k < clock.steps(); k += lanes) {
    add(k, side, 1.0 / 6);
    add(k, 0.5, 4.0 / 6);
    add(k, 1 - side, 1.0 / 6);
    // Where the motion stands still, b has no bounds at the step's own end.
    const bool outermost = k == 0 || k + lanes >= clock.steps();
    if (outermost) add(k, 0.25, 0);
    if (outermost) add(k, 0.75, 0);
  }
}

void DurationProblem::set(std::size_t moment, const MotionSample& motion) {
  if (moments_[moment] == end_) return;
  double* at = numbers_.data() + moment / lanes * block_size() + moment % lanes + 10 * lanes;
  *at = motion.inverse_most;
  for (std::size_t i = 0; i < joints(); ++i) {
    for (const double value : {motion.half_velocity[i], motion.acceleration[i], motion.jerk[i]}) {
      *(at += lanes) = value;
    }
  }
}

}  // namespace beeline
