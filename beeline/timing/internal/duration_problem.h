#pragma once

#include <beeline/timing/internal/squared_rate_spline.h>

namespace beeline::internal {

/// A joint motion q(tau) at one time tau. Under a time scaling with squared rate b each joint has
///     velocity      v sqrt(b)
///     acceleration  a b + v b' / 2
///     jerk          sqrt(b) (j b + 3/2 a b' + v b'' / 2).
struct MotionSample {
  std::vector<double> half_velocity, acceleration, jerk;  ///< v / 2, a, j of each joint
  double inverse_max = 0;  ///< 1 / the largest b that the velocity limits allow

  explicit MotionSample(std::size_t joints)
      : half_velocity(joints), acceleration(joints), jerk(joints) {}
};

/// Minimise the duration, the integral of b^(-1/2), over the coefficients of b subject to the
/// limits of velocity, acceleration and jerk, at both ends of each step of the spline and in its
/// middle. Numbers are stored in blocks of eight for Lanes: of eight consecutive steps, at one time
/// of each.
class DurationProblem {
 public:
  static constexpr std::size_t lanes = 8;

  DurationProblem(const SquaredRateSpline& spline, const Eigen::VectorXd& acceleration,
                  const Eigen::VectorXd& jerk);

  /// The times tau at which samples of the motion are to be set. The last blocks are filled up with
  /// the end of the spline, where set() has no effect and nothing moves.
  const std::vector<double>& times() const { return times_; }
  void set(std::size_t index, const MotionSample& sample);

  std::size_t joints() const { return inverse_limits_.size() / 2; }
  std::size_t blocks() const { return times_.size() / lanes; }
  /// The first step of a block.
  std::size_t first_step(std::size_t block) const { return first_steps_[block]; }
  /// The number of coefficients that the blocks read. Those past the end of the spline must be 1.
  std::size_t coefficients() const { return first_steps_.back() + lanes + 2; }
  /// The number of Lagrange multipliers. In eights for each block: of the largest b, then for each
  /// joint of the upper and lower limit of acceleration and of jerk.
  std::size_t multipliers() const { return blocks() * lanes * (1 + 4 * joints()); }

  /// In eights: the nine numbers of SquaredRateSpline::rows(), row by row; the weight in the
  /// duration (Simpson's rule, as a fraction of the whole); 1 / the largest b; then v / 2, a and j
  /// of each joint.
  const double* numbers(std::size_t block) const { return numbers_.data() + block * block_size(); }
  /// For each joint 1 / limit of acceleration, 1 / limit of jerk.
  const double* inverse_limits() const { return inverse_limits_.data(); }

 private:
  std::size_t block_size() const { return lanes * (11 + 3 * joints()); }

  double end_;
  std::vector<std::size_t> first_steps_;
  std::vector<double> times_, numbers_, inverse_limits_;
};

}  // namespace beeline::internal
