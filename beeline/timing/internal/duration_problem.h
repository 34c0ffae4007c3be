#pragma once

#include <beeline/timing/internal/squared_rate_spline.h>

namespace beeline {

/// A motion at one of its moments. With b the square of the rate at which its clock runs, b' and
/// b'' by the motion's own time, each joint then moves with
///     velocity      v sqrt(b)
///     acceleration  a b + v b' / 2
///     jerk          sqrt(b) (j b + 3/2 a b' + v b'' / 2).
struct MotionSample {
  std::vector<double> half_velocity, acceleration, jerk;  ///< v / 2, a, j of each joint
  double inverse_most = 0;  ///< 1 / b's largest value for the limits of velocity

  explicit MotionSample(std::size_t joints)
      : half_velocity(joints), acceleration(joints), jerk(joints) {}
};

/// What a clock has to keep, at both ends of each of its steps and in between. Numbers lie in
/// eights, for Lanes: of as many steps one after the other, at one moment of each.
class DurationProblem {
 public:
  static constexpr std::size_t lanes = 8;

  DurationProblem(const SquaredRateSpline& clock, const Eigen::VectorXd& acceleration,
                  const Eigen::VectorXd& jerk);

  /// The times at which motions are to be set, in eights too; past the clock's end its end, at
  /// which nothing moves whatever is set.
  const std::vector<double>& moments() const { return moments_; }
  void set(std::size_t moment, const MotionSample& motion);

  std::size_t joints() const { return inverse_limits_.size() / 2; }
  std::size_t blocks() const { return moments_.size() / lanes; }
  /// The first step of a block.
  std::size_t first_step(std::size_t block) const { return first_steps_[block]; }
  /// How many coefficients the blocks reach, those past the clock's end too: these are one, and
  /// with them what ends the clock has to be positive.
  std::size_t coefficients() const { return first_steps_.back() + lanes + 2; }
  /// How many multipliers the limits have. In eights for each block: of b's largest value, then of
  /// each joint the acceleration's upper and lower one and the jerk's.
  std::size_t multipliers() const { return blocks() * lanes * (1 + 4 * joints()); }

  /// In eights: nine of SquaredRateSpline::rows(), row by row; the share of the duration that it
  /// counts for; 1 / b's largest value; then of each joint v / 2, a and j.
  const double* numbers(std::size_t block) const { return numbers_.data() + block * block_size(); }
  /// Of each joint 1 / limit of acceleration, 1 / limit of jerk.
  const double* inverse_limits() const { return inverse_limits_.data(); }

 private:
  std::size_t block_size() const { return lanes * (11 + 3 * joints()); }

  double end_;
  std::vector<std::size_t> first_steps_;
  std::vector<double> moments_, numbers_, inverse_limits_;
};

}  // namespace beeline
