#include <beeline/timing/internal/duration_problem.h>

namespace beeline::internal {
namespace {

constexpr double end_offset = 1e-6;  // of a step: its ends are one-sided, as b'' jumps at knots

}  // namespace

DurationProblem::DurationProblem(const SquaredRateSpline& spline,
                                 const Eigen::VectorXd& acceleration, const Eigen::VectorXd& jerk)
    : end_(spline.knots().back()) {
  for (Eigen::Index i = 0; i < jerk.size(); ++i) {
    inverse_limits_.push_back(1 / acceleration[i]);
    inverse_limits_.push_back(1 / jerk[i]);
  }
  constexpr std::size_t outermost_blocks = 4;
  const std::size_t blocks = 3 * (spline.steps() / lanes + 1) + outermost_blocks;
  numbers_.reserve(blocks * (lanes * (11 + 3 * static_cast<std::size_t>(jerk.size()))));
  times_.reserve(blocks * lanes);
  const auto add = [&](std::size_t first, double u, double weight) {
    first_steps_.push_back(first);
    numbers_.resize(numbers_.size() + block_size());
    double* at = numbers_.data() + numbers_.size() - block_size();
    for (std::size_t k = first; k < first + lanes; ++k, ++at) {
      if (k >= spline.steps()) {
        times_.push_back(end_);
        at[0] = 1;  // here b is the first coefficient
        continue;
      }
      const double length = spline.knots()[k + 1] - spline.knots()[k];
      times_.push_back(spline.knots()[k] + u * length);
      const Eigen::Matrix3d rows = spline.rows(k, u);
      for (Eigen::Index r = 0; r < 9; ++r) at[std::size_t(r) * lanes] = rows(r / 3, r % 3);
      at[9 * lanes] = weight * length / end_;
    }
  };
  for (std::size_t k = 0; k < spline.steps(); k += lanes) {
    add(k, end_offset, 1.0 / 6);
    add(k, 0.5, 4.0 / 6);
    add(k, 1 - end_offset, 1.0 / 6);
    // At rest the limits do not bound b: more times in the first and the last steps do.
    const bool outermost = k == 0 || k + lanes >= spline.steps();
    if (outermost) add(k, 0.25, 0);
    if (outermost) add(k, 0.75, 0);
  }
}

void DurationProblem::set(std::size_t index, const MotionSample& sample) {
  if (times_[index] == end_) return;
  double* at = numbers_.data() + index / lanes * block_size() + index % lanes + 10 * lanes;
  *at = sample.inverse_max;
  for (std::size_t i = 0; i < joints(); ++i) {
    for (const double value : {sample.half_velocity[i], sample.acceleration[i], sample.jerk[i]}) {
      *(at += lanes) = value;
    }
  }
}

}  // namespace beeline::internal
