#include <algorithm>
#include <limits>

#include <beeline/certificate/internal/motion_tubes.h>

namespace beeline::internal {
namespace {

constexpr double roundoff = std::numeric_limits<double>::epsilon();
constexpr Eigen::Index last = 5;  // degree of the coefficients

/// The coefficients of degree five of a cubic polynomial.
void set_elevated(double c0, double c1, double c2, double c3, Eigen::Ref<Eigen::VectorXd> b) {
  b << c0, (2 * c0 + 3 * c1) / 5, (c0 + 6 * c1 + 3 * c2) / 10, (3 * c1 + 6 * c2 + c3) / 10,
      (3 * c2 + 2 * c3) / 5, c3;
}

}  // namespace

void set_bernstein_coefficients(const Trajectory& trajectory, std::size_t k,
                                BernsteinCoefficients& b) {
  const Configuration& p0 = trajectory.positions[k];
  const Configuration& p1 = trajectory.positions[k + 1];
  const double h = trajectory.times[k + 1] - trajectory.times[k];
  b.resize(6, p0.size());
  for (Eigen::Index i = 0; i < p0.size(); ++i) {
    if (trajectory.velocities.empty()) {
      for (Eigen::Index m = 0; m <= last; ++m) {
        const double u = static_cast<double>(m) / last;
        b(m, i) = (1 - u) * p0[i] + u * p1[i];
      }
      continue;
    }
    const double d0 = h * trajectory.velocities[k][i], d1 = h * trajectory.velocities[k + 1][i];
    if (trajectory.accelerations.empty()) {
      set_elevated(p0[i], p0[i] + d0 / 3, p1[i] - d1 / 3, p1[i], b.col(i));
      continue;
    }
    const double dd0 = h * h * trajectory.accelerations[k][i];
    const double dd1 = h * h * trajectory.accelerations[k + 1][i];
    b.col(i) << p0[i], p0[i] + d0 / 5, p0[i] + 2 * d0 / 5 + dd0 / 20, p1[i] - 2 * d1 / 5 + dd1 / 20,
        p1[i] - d1 / 5, p1[i];
  }
}

void set_coefficient_rounding(const BernsteinCoefficients& coefficients,
                              Eigen::VectorXd& rounding) {
  rounding = 32 * roundoff * coefficients.cwiseAbs().colwise().maxCoeff().transpose();
}

void add_halving_rounding(const BernsteinCoefficients& whole, Eigen::VectorXd& rounding) {
  // Each of five sums, one of the other, rounds by half a unit of the last place.
  rounding += 5 * roundoff * whole.cwiseAbs().colwise().maxCoeff().transpose();
}

void halve(const BernsteinCoefficients& whole, BernsteinCoefficients& first,
           BernsteinCoefficients& second) {
  first.resize(6, whole.cols());
  second = whole;
  for (Eigen::Index m = 0; m <= last; ++m) {
    first.row(m) = second.row(0);
    for (Eigen::Index i = 0; i < last - m; ++i) {
      second.row(i) = 0.5 * (second.row(i) + second.row(i + 1));
    }
  }
}

void enclose(const BernsteinCoefficients& motion, const Eigen::VectorXd& rounding,
             TubeValues& tube) {
  const auto begin = motion.row(0), end = motion.row(last);
  Eigen::Index widest = 0;
  const double widest_change = (end - begin).cwiseAbs().maxCoeff(&widest);
  std::array<double, last + 1> pace{};
  for (Eigen::Index m = 0; m <= last; ++m) {
    const double share = widest_change > 0
                             ? (motion(m, widest) - begin[widest]) / (end[widest] - begin[widest])
                             : static_cast<double>(m) / last;
    pace[static_cast<std::size_t>(m)] = std::clamp(share, 0.0, 1.0);
  }
  for (Eigen::Index i = 0; i < motion.cols(); ++i) {
    double lowest = 0, highest = 0;
    for (Eigen::Index m = 0; m <= last; ++m) {
      const double on_line = begin[i] + pace[static_cast<std::size_t>(m)] * (end[i] - begin[i]);
      lowest = std::min(lowest, motion(m, i) - on_line);
      highest = std::max(highest, motion(m, i) - on_line);
    }
    tube.middle[i] = (begin[i] + end[i] + lowest + highest) / 2;
    tube.half_motion[i] = (end[i] - begin[i]) / 2;
    tube.slack[i] = (highest - lowest) / 2 + rounding[i];
  }
}

void enclose(const TubeValues& first, const TubeValues& second, const Configuration& begin,
             const Configuration& middle, const Configuration& end, TubeValues& tube) {
  const double length = (end - begin).squaredNorm();
  const double fraction =
      length > 0 ? std::clamp((middle - begin).dot(end - begin) / length, 0.0, 1.0) : 0.5;
  for (Eigen::Index i = 0; i < begin.size(); ++i) {
    const double change = end[i] - begin[i];
    // The lines of the halves are beside the whole line by 0 to `beside`; their tubes may be
    // shifted.
    const double beside = middle[i] - (begin[i] + fraction * change);
    const double first_shift = first.middle[i] - (begin[i] + middle[i]) / 2;
    const double second_shift = second.middle[i] - (middle[i] + end[i]) / 2;
    const double lowest = std::min(0.0, beside) +
                          std::min(first_shift - first.slack[i], second_shift - second.slack[i]);
    const double highest = std::max(0.0, beside) +
                           std::max(first_shift + first.slack[i], second_shift + second.slack[i]);
    tube.middle[i] = (begin[i] + end[i] + lowest + highest) / 2;
    tube.half_motion[i] = change / 2;
    tube.slack[i] = (highest - lowest) / 2 +
                    16 * roundoff * (std::abs(begin[i]) + std::abs(middle[i]) + std::abs(end[i]));
  }
}

MotionTubes::MotionTubes(const Trajectory& trajectory) : trajectory_(&trajectory) {
  const std::size_t intervals = trajectory.size() - 1;
  if (scratch_->coefficients.size() < intervals) {
    scratch_->coefficients.resize(intervals);
    scratch_->rounding.resize(intervals);
    scratch_->nodes.resize(2 * intervals - 1);
  }
  for (std::size_t k = 0; k < intervals; ++k) {
    set_bernstein_coefficients(trajectory, k, scratch_->coefficients[k]);
    set_coefficient_rounding(scratch_->coefficients[k], scratch_->rounding[k]);
  }
  fill(all());
}

void MotionTubes::fill(const Range& range) {
  TubeValues& tube = scratch_->nodes[range.node];
  tube.resize(trajectory_->positions.front().size());
  if (range.is_interval()) {
    return enclose(coefficients(range.first), rounding(range.first), tube);
  }
  const Range first = range.first_half(), second = range.second_half();
  fill(first);
  fill(second);
  const std::vector<Configuration>& q = trajectory_->positions;
  enclose(values(first), values(second), q[range.first], q[range.middle()], q[range.last], tube);
}

}  // namespace beeline::internal
