#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/timing/internal/ended_scaling.h>
#include <beeline/timing/internal/fastest.h>
#include <beeline/timing/internal/step_polygon.h>
#include <beeline/timing/internal/timed_section.h>

namespace beeline::internal {
namespace {

constexpr double near_limit = 0.9;       // of a squared velocity limit; steps are not checked below
constexpr double simply_slower = 1.001;  // a violation up to this is removed without a new pass
constexpr double shortest_duration = 1e-3;  // seconds, if nothing moves; times must increase

constexpr std::size_t steps_between_asks = 64;  // steps of the path; then the budget is asked

double squared(double x) { return x * x; }

/// dq/ds and d2q/ds2 of one joint in the middle of a step: of the quintic through its ends.
struct Middle {
  double dq, ddq;
};
inline Middle middle(const JointPath& path, std::size_t k, Eigen::Index i, double h) {
  const double d0 = path.dq[k][i], d1 = path.dq[k + 1][i];
  const double c0 = path.ddq[k][i], c1 = path.ddq[k + 1][i];
  const double chord = (path.q[k + 1][i] - path.q[k][i]) / h;
  return {1.875 * chord - 0.4375 * (d0 + d1) - h / 32 * (c0 - c1),
          1.5 * (d1 - d0) / h - 0.25 * (c0 + c1)};
}

/// The constraints of a path with limits on the squared speeds b at its grid points, for both
/// constraints.
class Constraints {
 public:
  Constraints(const JointPath& path, const PathLimits& limits, BudgetMeter& budget)
      : path_(path),
        limits_(limits),
        budget_(budget),
        slowness_(limits.velocity.cwiseInverse()),
        polygon_(constraints_, constraints_of_a_step()) {
    prepare();
  }

  /// Whether the budget has ended the computation, asked at some of the steps k.
  bool ended(std::size_t k) const { return k % steps_between_asks == 0 && budget_.ended(0); }

  /// The largest squared speed at grid point k that the velocity limits allow.
  double largest(std::size_t k) const { return largest_[k]; }

  /// See StepPolygon, for step k.
  SquaredSpeeds begins(std::size_t k, const SquaredSpeeds& ends) {
    polygon_.go_to(k * constraints_of_a_step());
    return polygon_.begins(ends, largest_[k]);
  }

  double furthest_end(std::size_t k, double x, const SquaredSpeeds& ends) {
    polygon_.go_to(k * constraints_of_a_step());
    return polygon_.furthest_end(x, ends);
  }

  /// Divides the velocity limits by the factor.
  void slow_down(double factor) {
    slowness_ *= factor;
    const double begin = largest_.front(), end = largest_.back();  // the given speeds stay
    prepare();
    largest_.front() = begin;
    largest_.back() = end;
  }

  /// The largest fraction of a velocity limit that is used, between the quarters of the steps, at
  /// which the constraints keep it.
  double velocity_fraction(const std::vector<double>& b) const {
    double largest = 0;
    for (std::size_t k = 0; k + 1 < path_.size() && !ended(k); ++k) {
      const double h = path_.s[k + 1] - path_.s[k], higher = std::max(b[k], b[k + 1]);
      for (Eigen::Index i = 0; i < slowness_.size(); ++i) {
        const double d0 = path_.dq[k][i], d1 = path_.dq[k + 1][i], mid = middle(path_, k, i, h).dq;
        const double scale = squared(slowness_[i]);
        if (std::max({d0 * d0, mid * mid, d1 * d1}) * scale * higher < near_limit) continue;
        for (const double x : {0.125, 0.375, 0.625, 0.875}) {
          const double slope =
              (1 - x) * (1 - 2 * x) * d0 + 4 * x * (1 - x) * mid + x * (2 * x - 1) * d1;
          largest = std::max(largest, slope * slope * scale * ((1 - x) * b[k] + x * b[k + 1]));
        }
      }
    }
    return std::sqrt(largest);
  }

 private:
  std::size_t constraints_of_a_step() const {
    return static_cast<std::size_t>(3 * slowness_.size() + 3);
  }

  void prepare() {
    const double fastest = squared((path_.s.back() - path_.s.front()) / shortest_duration);
    largest_.resize(path_.size());
    for (std::size_t k = 0; k < path_.size(); ++k) {
      double slowest = path_.dq[k].cwiseAbs().cwiseProduct(slowness_).maxCoeff();
      if (!limits_.speed.empty()) slowest = std::max(slowest, 1 / limits_.speed[k]);
      largest_[k] = std::min(fastest, 1 / squared(slowest));
    }
    constraints_.begin.resize((path_.size() - 1) * constraints_of_a_step());
    constraints_.end.resize(constraints_.begin.size());
    for (std::size_t k = 0; k + 1 < path_.size() && !ended(k); ++k) prepare_step(k);
  }

  /// With the squared speeds x and y at both ends, d2s/dt2 = (y - x) / 2h. A joint's acceleration
  /// q' d2s/dt2 + q'' b is a parabola in s where the path is cubic: within its limit where the
  /// three coefficients of its Bernstein form are. Its velocity is kept at the ends by `largest`,
  /// and here at the quarters.
  void prepare_step(std::size_t k) {
    const double h = path_.s[k + 1] - path_.s[k], half = 0.5 / h;
    double* begin = &constraints_.begin[k * constraints_of_a_step()];
    double* end = &constraints_.end[k * constraints_of_a_step()];
    const auto& fraction = limits_.fraction;
    const double usable = fraction.empty() ? 1 : std::min(fraction[k], fraction[k + 1]);
    double slowest[3] = {0, 0, 0};  // inverse of the speed at each quarter of the step
    for (Eigen::Index i = 0; i < slowness_.size(); ++i) {
      const double d0 = path_.dq[k][i], d1 = path_.dq[k + 1][i];
      const double scale = 1 / (usable * limits_.acceleration[i]);
      const Middle mid = middle(path_, k, i, h);
      const double e0 = d0 * half, e = mid.dq * half, e1 = d1 * half;  // q' / 2h
      const double x0 = path_.ddq[k][i] - e0, y1 = path_.ddq[k + 1][i] + e1;
      *begin++ = x0 * scale;
      *end++ = e0 * scale;
      *begin++ = (mid.ddq - 2 * e - 0.5 * (x0 - e1)) * scale;
      *end++ = (mid.ddq + 2 * e - 0.5 * (e0 + y1)) * scale;
      *begin++ = -e1 * scale;
      *end++ = y1 * scale;
      const double first = 0.375 * d0 + 0.75 * mid.dq - 0.125 * d1;
      const double third = -0.125 * d0 + 0.75 * mid.dq + 0.375 * d1;
      slowest[0] = std::max(slowest[0], std::abs(first) * slowness_[i]);
      slowest[1] = std::max(slowest[1], std::abs(mid.dq) * slowness_[i]);
      slowest[2] = std::max(slowest[2], std::abs(third) * slowness_[i]);
    }
    for (int j = 0; j < 3; ++j) {
      const double u = 0.25 * (j + 1), inverse = squared(slowest[j]);
      *begin++ = (1 - u) * inverse;
      *end++ = u * inverse;
    }
  }

  const JointPath& path_;
  const PathLimits& limits_;
  BudgetMeter& budget_;
  Configuration slowness_;       ///< inverses of the limits of velocity
  StepConstraints constraints_;  ///< of all steps
  StepPolygon polygon_;
  std::vector<double> largest_;
};

/// The backward and the forward pass. Writes the squared speeds at the grid points into b. Returns
/// why there are none; no reason when there are, or the budget has ended the computation.
Reason squared_speeds(const JointPath& path, const EndSpeeds& ends, Constraints& constraints,
                      std::vector<double>& b) {
  if (constraints.ended(0)) return {};
  const std::size_t last = path.size() - 1;
  const double within = 1 + 1e-9;  // rounding of a speed computed as the largest
  if (squared(ends.end) > constraints.largest(last) * within) {
    return {ReasonCode::end_speed_too_high,
            {{ReasonField::speed, ends.end},
             {ReasonField::needed_speed, std::sqrt(constraints.largest(last))}}};
  }
  std::vector<SquaredSpeeds> controllable(last + 1);
  controllable[last].min = controllable[last].max = squared(ends.end);
  for (std::size_t k = last; k-- > 0;) {
    if (constraints.ended(k)) return {};
    controllable[k] = constraints.begins(k, controllable[k + 1]);
    if (!controllable[k].none()) continue;
    return {ReasonCode::end_speed_unreachable, {{ReasonField::s, path.s[k]}}};
  }
  b.assign(last + 1, 0);
  b[0] = squared(ends.begin);
  if (b[0] > controllable[0].max * within || b[0] * within < controllable[0].min) {
    const bool high = b[0] > controllable[0].max;
    return {
        high ? ReasonCode::begin_speed_too_high : ReasonCode::begin_speed_too_low,
        {{ReasonField::speed, ends.begin},
         {ReasonField::needed_speed, std::sqrt(high ? controllable[0].max : controllable[0].min)}}};
  }
  for (std::size_t k = 0; k < last; ++k) {
    if (constraints.ended(k)) return {};
    b[k + 1] = constraints.furthest_end(k, b[k], controllable[k + 1]);
    if (b[k] + b[k + 1] > 0) continue;
    return {ReasonCode::path_not_traversable, {{ReasonField::s, path.s[k]}}};
  }
  return {};
}

/// The time scaling with these squared speeds at the grid points.
TimeScaling scaling_of(const JointPath& path, const std::vector<double>& b) {
  const std::size_t points = path.size();
  TimeScaling scaling;
  scaling.s = path.s;
  scaling.t.resize(points);
  scaling.speed.resize(points);
  scaling.acceleration.resize(points);
  double before = 0;
  for (std::size_t k = 0; k < points; ++k) {
    scaling.speed[k] = std::sqrt(b[k]);
    if (k > 0) {
      scaling.t[k] = scaling.t[k - 1] +
                     2 * (path.s[k] - path.s[k - 1]) / (scaling.speed[k - 1] + scaling.speed[k]);
    }
    const bool last = k + 1 == points;
    const double after = last ? before : 0.5 * (b[k + 1] - b[k]) / (path.s[k + 1] - path.s[k]);
    scaling.acceleration[k] = k == 0 ? after : 0.5 * (before + after);
    before = after;
  }
  return scaling;
}

void check(const JointPath& path, const PathLimits& limits, const EndSpeeds& ends) {
  check_path(path);
  check_limits(limits, path);
  for (const double speed : {ends.begin, ends.end}) {
    if (speed >= 0 && std::isfinite(speed)) continue;
    throw Error("a path's speed at an end must be zero or more, not " + number(speed));
  }
}

}  // namespace

TimeScaling fastest(const JointPath& path, const PathLimits& limits, const EndSpeeds& ends,
                    BudgetMeter& budget) {
  check(path, limits, ends);
  Constraints constraints(path, limits, budget);
  std::vector<double> b;
  Reason reason = squared_speeds(path, ends, constraints, b);
  const double found = reason ? 0 : constraints.velocity_fraction(b);
  if (budget.ended(0)) return ended_scaling(budget);
  // The peaks are between the eighths at which it is evaluated; a quarter more bounds a parabola.
  const double over = found + 0.25 * std::max(0.0, found - 1);
  const bool at_rest = ends.begin == 0 && ends.end == 0;
  if (at_rest && over <= simply_slower) {
    TimeScaling scaling = scaling_of(path, b);
    slow_down(scaling, std::max(over, 1.0));
    return scaling;
  }
  if (over > 1) {
    constraints.slow_down(over * (1 + 1e-9));
    reason = squared_speeds(path, ends, constraints, b);
  }
  if (budget.ended(0)) return ended_scaling(budget);
  if (!reason) return scaling_of(path, b);
  TimeScaling none;
  none.reason = std::move(reason);
  return none;
}

}  // namespace beeline::internal
