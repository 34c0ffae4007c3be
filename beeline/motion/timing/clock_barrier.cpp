#include <algorithm>
#include <cmath>

#include <beeline/motion/timing/clock_barrier.h>

namespace beeline {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double first_weight = 1;   // of the duration against the barrier, for each knot
constexpr double last_weight = 3e4;  // what is left to gain is some parts of its inverse
constexpr double weight_growth = 6;
constexpr int most_newton_steps = 40;  // for one weight

/// The value, gradient and (Gauss-Newton) Hessian by b, b' and b'' at one side of a knot.
struct Local {
  double value = 0;
  Vector3d gradient = Vector3d::Zero();
  Matrix3d hessian = Matrix3d::Zero();
  bool inside = true;  ///< of all limits
};

/// Adds -log(1 - z^2), whose z has this gradient; what z's own bend adds is left out, so that the
/// Hessian stays positive.
void add_share(Local& local, double z, const Vector3d& slope, double& product) {
  const double room = 1 - z * z;
  if (!(room > 0)) {
    local.inside = false;
    return;
  }
  product *= room;
  local.gradient += (2 * z / room) * slope;
  const double bend = 2 * (1 + z * z) / (room * room);
  local.hessian.noalias() += (bend * slope) * slope.transpose();
}

/// The barrier of one moment; accelerations and velocities, which both sides of a knot share, only
/// where `whole`.
Local barrier(const ClockMoment& moment, const ClockRate& rate, bool whole) {
  Local local;
  const double root = std::sqrt(rate.b);
  if (!(rate.b > 0 && rate.b < moment.most)) {
    local.inside = false;
    return local;
  }
  double product = 1;
  for (Eigen::Index i = 0; i < moment.jerk_v.size(); ++i) {
    const Vector3d by(moment.jerk_j[i], 1.5 * moment.jerk_a[i], 0.5 * moment.jerk_v[i]);
    const double sum = by[0] * rate.b + by[1] * rate.slope + by[2] * rate.bend;
    Vector3d slope = root * by;
    slope[0] += 0.5 * sum / root;
    add_share(local, root * sum, slope, product);
    if (!whole || !local.inside) continue;
    const Vector3d a(moment.acceleration_a[i], 0.5 * moment.acceleration_v[i], 0);
    add_share(local, a[0] * rate.b + a[1] * rate.slope, a, product);
  }
  if (whole && std::isfinite(moment.most)) {
    const double room = 1 - rate.b / moment.most;
    product *= room;
    local.gradient[0] += 1 / (room * moment.most);
    local.hessian(0, 0) += 1 / (room * room * moment.most * moment.most);
  }
  local.value = -std::log(product);
  return local;
}

/// A symmetric matrix with two diagonals beside the middle one, and the solution of its equations.
struct Banded {
  Eigen::Matrix<double, 3, Eigen::Dynamic> bands;  ///< band d of column k: entry (k + d, k)

  explicit Banded(Eigen::Index size) : bands(3, size) { bands.setZero(); }

  void add(Eigen::Index k, const Matrix3d& block) {
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column <= row; ++column) {
        bands(row - column, k + column) += block(row, column);
      }
    }
  }

  /// By its factors L D L^T. Returns the solution in place.
  void solve(VectorXd& x) {
    const Eigen::Index size = bands.cols();
    for (Eigen::Index k = 0; k < size; ++k) {
      const double pivot = bands(0, k);
      const double first = bands(1, k) / pivot, second = bands(2, k) / pivot;
      if (k + 1 < size) {
        bands(0, k + 1) -= first * bands(1, k);
        bands(1, k + 1) -= first * bands(2, k);
        x[k + 1] -= first * x[k];
      }
      if (k + 2 < size) {
        bands(0, k + 2) -= second * bands(2, k);
        x[k + 2] -= second * x[k];
      }
      bands(1, k) = first;
      bands(2, k) = second;
    }
    for (Eigen::Index k = size; k-- > 0;) {
      x[k] /= bands(0, k);
      if (k + 1 < size) x[k] -= bands(1, k) * x[k + 1];
      if (k + 2 < size) x[k] -= bands(2, k) * x[k + 2];
    }
  }
};

/// weight * duration + barrier, by the clock's coefficients.
class Objective {
 public:
  Objective(const ClockSpline& clock, const std::vector<ClockMoment>& moments)
      : clock_(clock), moments_(moments) {
    for (const ClockMoment& moment : moments) {
      rows_.push_back(clock.rows(moment.step, moment.share));
    }
    total_ = clock.knots().back() - clock.knots().front();
  }

  /// Infinite outside the limits; gradient and Hessian where they are asked for.
  double value(const VectorXd& c, double weight, VectorXd* gradient = nullptr,
               Banded* hessian = nullptr) const {
    double value = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      const ClockMoment& moment = moments_[i];
      const auto k = static_cast<Eigen::Index>(moment.step);
      const Vector3d at = rows_[i] * c.segment<3>(k);
      const bool whole = moment.share < 1 || i + 1 == rows_.size();
      Local local = barrier(moment, {at[0], at[1], at[2]}, whole);
      if (!local.inside) return std::numeric_limits<double>::infinity();
      const double step = clock_.knots()[k + 1] - clock_.knots()[k];
      const bool of_knot = moment.share == 0 || moment.share == 1;
      const double share = of_knot ? 0.5 * weight * step / total_ : 0;  // the trapezoid rule
      const double pace = 1 / std::sqrt(at[0]);
      local.value += share * pace;
      value += local.value;
      if (gradient == nullptr) continue;
      local.gradient[0] -= 0.5 * share * pace / at[0];
      local.hessian(0, 0) += 0.75 * share * pace / (at[0] * at[0]);
      gradient->segment<3>(k) += rows_[i].transpose() * local.gradient;
      hessian->add(k, rows_[i].transpose() * local.hessian * rows_[i]);
    }
    return value;
  }

 private:
  const ClockSpline& clock_;
  const std::vector<ClockMoment>& moments_;
  std::vector<Matrix3d> rows_;
  double total_ = 0;
};

/// Newton's method with backtracking for one weight.
void centre(const Objective& objective, double weight, VectorXd& c) {
  for (int i = 0; i < most_newton_steps; ++i) {
    VectorXd gradient = VectorXd::Zero(c.size());
    Banded hessian(c.size());
    const double value = objective.value(c, weight, &gradient, &hessian);
    VectorXd step = -gradient;
    hessian.solve(step);
    const double decrease = -gradient.dot(step);
    if (!(decrease > 1e-4 * double(c.size()))) return;
    double length = 1;
    for (; length > 1e-6; length /= 2) {
      const double next = objective.value(c + length * step, weight);
      if (next < value - 0.1 * length * decrease) break;
    }
    if (length <= 1e-6) return;
    c += length * step;
  }
}

}  // namespace

ClockShares shares(const ClockMoment& moment, const ClockRate& rate) {
  ClockShares most;
  most.velocity_squared = rate.b / moment.most;
  for (Eigen::Index i = 0; i < moment.jerk_v.size(); ++i) {
    const double acceleration =
        moment.acceleration_a[i] * rate.b + 0.5 * moment.acceleration_v[i] * rate.slope;
    const double jerk = moment.jerk_j[i] * rate.b + 1.5 * moment.jerk_a[i] * rate.slope +
                        0.5 * moment.jerk_v[i] * rate.bend;
    most.acceleration = std::max(most.acceleration, std::abs(acceleration));
    most.jerk = std::max(most.jerk, std::abs(jerk) * std::sqrt(rate.b));
  }
  return most;
}

ClockSpline::ClockSpline(std::vector<double> knots)
    : coefficients(VectorXd::Ones(static_cast<Eigen::Index>(knots.size()) + 1)),
      knots_(std::move(knots)) {}

Matrix3d ClockSpline::rows(std::size_t step, double share) const {
  const auto length =
      [this](std::size_t k) {  // of step k - 1; none before the first, after the last
        return k == 0 || k == knots_.size() ? 0 : knots_[k] - knots_[k - 1];
      };
  const double before = length(step), here = length(step + 1), after = length(step + 2);
  // At both knots of the step b is between two coefficients, and b' their difference.
  Matrix3d rows = Matrix3d::Zero();
  rows.row(0) << here / (before + here), before / (before + here), 0;
  rows.row(1) << -2 / (before + here), 2 / (before + here), 0;
  const Eigen::RowVector3d end_slope(0, -2 / (here + after), 2 / (here + after));
  rows.row(2) = (end_slope - rows.row(1)) / here;
  const double x = share * here;
  rows.row(0) += x * rows.row(1) + 0.5 * x * x * rows.row(2);
  rows.row(1) += x * rows.row(2);
  return rows;
}

ClockRate ClockSpline::at(std::size_t step, double t) const {
  const double share = (t - knots_[step]) / (knots_[step + 1] - knots_[step]);
  const Vector3d rate =
      rows(step, share) * coefficients.segment<3>(static_cast<Eigen::Index>(step));
  return {rate[0], rate[1], rate[2]};
}

void hasten(ClockSpline& clock, const std::vector<ClockMoment>& moments) {
  const Objective objective(clock, moments);
  const double knots = double(clock.steps());
  for (double weight = first_weight; weight < last_weight; weight *= weight_growth) {
    centre(objective, weight * knots, clock.coefficients);
  }
}

}  // namespace beeline
