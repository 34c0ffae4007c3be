#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/math/hermite.h>
#include <beeline/math/minimise.h>
#include <beeline/path/internal/joint_path_derivatives.h>
#include <beeline/timing/internal/ended_scaling.h>
#include <beeline/timing/internal/scalar_profile.h>
#include <beeline/timing/point_to_point.h>
#include <beeline/trajectory/limit_usage.h>

namespace beeline::internal {
namespace {

constexpr double min_ramp = 1e-3;  // of the duration: nearly a step of the velocity
constexpr int grid_count = 400;    // path parameters at which shapes are compared, as refined()

/// A profile of duration 1: `ramp` is the fraction of the duration in which ds/dt increases,
/// `round` the fraction of the ramp in each of its two phases of constant jerk.
struct Shape {
  ScalarForm form;
  SCurve curve;
  double length;

  Shape(ScalarForm kind, double distance, double ramp = 0.5, double round = 0.5)
      : form(kind), length(distance) {
    curve.distance = distance;
    curve.duration = 1;
    curve.jerk_time = kind == ScalarForm::s_curve ? round * ramp : 0;
    curve.acceleration_time = ramp - 2 * curve.jerk_time;
    curve.cruise_time = 1 - 2 * ramp;
    curve.velocity = distance / (1 - ramp);
    curve.acceleration = curve.velocity / (ramp - curve.jerk_time);
    curve.jerk = curve.jerk_time > 0 ? curve.acceleration / curve.jerk_time : Limits::none;
  }

  JointState at(double u) const {
    if (form != ScalarForm::quintic) return beeline::at(curve, u);
    const RestToRest motion = rest_to_rest(u);
    return {length * motion.value, length * motion.first, length * motion.second,
            length * motion.third};
  }

  /// The time at which s is reached, at `after` or later: Newton's method, safeguarded by
  /// bisection.
  double time_at(double s, double after) const {
    double low = after, high = 1, u = 0.5 * (low + high);
    for (int i = 0; i < 100 && high - low > 1e-15; ++i) {
      const JointState state = at(u);
      (state.position < s ? low : high) = u;
      const double newton = u + (s - state.position) / state.velocity;
      const bool inside = newton > low && newton < high;
      const double next = inside ? newton : 0.5 * (low + high);
      if (std::abs(next - u) < 1e-14) return next;
      u = next;
    }
    return u;
  }

  /// The times between phases, at which the jerk jumps.
  std::vector<double> phase_ends() const {
    if (form == ScalarForm::quintic) return {};
    std::vector<double> ends;
    double u = 0;
    for (const double phase : {curve.jerk_time, curve.acceleration_time, curve.jerk_time,
                               curve.cruise_time, curve.jerk_time, curve.acceleration_time}) {
      u += phase;
      if (phase > 0) ends.push_back(u);
    }
    return ends;
  }
};

/// The largest fractions of the limits that a profile uses.
class LimitFractions {
 public:
  explicit LimitFractions(const PathLimits& limits)
      : by_velocity_(limits.velocity.cwiseInverse()),
        by_acceleration_(limits.acceleration.cwiseInverse()),
        by_jerk_(limits.jerk.cwiseInverse()) {}

  /// Adds the state at a path parameter with these derivatives of the path, where this fraction of
  /// the limits of acceleration and jerk may be used.
  void add(const double* dq, const double* ddq, const double* dddq, const JointState& state,
           double usable) {
    const double v = state.velocity, a = state.acceleration;
    for (Eigen::Index i = 0; i < by_jerk_.size(); ++i) {
      const double acceleration = dq[i] * a + ddq[i] * v * v;
      const double jerk = dq[i] * state.jerk + v * (3 * ddq[i] * a + dddq[i] * v * v);
      velocity_ = std::max(velocity_, std::abs(dq[i] * v) * by_velocity_[i]);
      acceleration_ =
          std::max(acceleration_, std::abs(acceleration) * by_acceleration_[i] / usable);
      jerk_ = std::max(jerk_, std::abs(jerk) * by_jerk_[i] / usable);
    }
  }

  /// The factor by which the profile must be slowed down to keep them.
  double slowdown_of(ScalarForm form) const {
    return slowdown_factor(velocity_, acceleration_, form == ScalarForm::trapezoidal ? 0 : jerk_);
  }

 private:
  Configuration by_velocity_, by_acceleration_, by_jerk_;
  double velocity_ = 0, acceleration_ = 0, jerk_ = 0;
};

/// The derivatives and limits of the path at equidistant path parameters. Shapes are compared at
/// these.
struct DerivativeGrid {
  std::size_t joints;
  std::vector<double> rates;
  std::vector<double> fraction, speed;  ///< see PathLimits; 1 and infinity where there are none

  DerivativeGrid(const JointPath& path, const PathLimits& limits)
      : joints(static_cast<std::size_t>(path.q[0].size())),
        fraction(grid_count + 1, 1),
        speed(grid_count + 1, Limits::none) {
    const PathDerivatives along(path);
    rates.resize(3 * joints * (grid_count + 1));
    const double begin = path.s.front(), length = path.s.back() - begin;
    std::size_t step = 0;
    for (int k = 0; k <= grid_count; ++k) {
      const double s = begin + length * k / grid_count;
      while (step + 2 < path.size() && path.s[step + 1] <= s) ++step;
      const double u = (s - path.s[step]) / (path.s[step + 1] - path.s[step]);
      const auto point = static_cast<std::size_t>(k);
      double* dq = rates.data() + 3 * joints * point;
      along.at(step, std::min(u, 1.0), dq, dq + joints, dq + 2 * joints);
      const auto least = [&](const std::vector<double>& values) {
        return std::min(values[step], values[step + 1]);
      };
      if (!limits.fraction.empty()) fraction[point] = least(limits.fraction);
      if (!limits.speed.empty()) speed[point] = least(limits.speed);
    }
  }

  /// Returns the grid point nearest to this fraction of the path length.
  static std::size_t nearest(double part) {
    return static_cast<std::size_t>(std::clamp(part * grid_count + 0.5, 0.0, grid_count + 0.5));
  }
};

/// Returns the smallest duration of the shape that the limits allow at some times, with the
/// derivatives of the path at the nearest grid points.
double duration(const Shape& shape, const DerivativeGrid& grid, const PathLimits& limits) {
  LimitFractions fractions(limits);
  double longest = 0;
  const auto take = [&](double u) {
    const JointState state = shape.at(u);
    const std::size_t point = grid.nearest(state.position / shape.length);
    const double* dq = grid.rates.data() + 3 * grid.joints * point;
    fractions.add(dq, dq + grid.joints, dq + 2 * grid.joints, state, grid.fraction[point]);
    longest = std::max(longest, state.velocity / grid.speed[point]);
  };
  constexpr int times = 100;  // to compare shapes; seconds_for() is exact
  for (int k = 0; k < times; ++k) take((k + 0.5) / times);
  for (const double end : {1e-9, 1 - 1e-9}) take(end);
  for (const double end : shape.phase_ends()) {
    take(end - 1e-9);
    take(end + 1e-9);
  }
  return std::max(longest, fractions.slowdown_of(shape.form));
}

/// Minimises f over [min_ramp, 0.5]: a scan of geometric steps, then golden sections.
template <class Function>
Minimum minimised(int sections, Function&& f) {
  constexpr int intervals = 8;
  const auto point = [](int k) {
    return min_ramp * std::pow(0.5 / min_ramp, double(k) / intervals);
  };
  return scan_and_refine(intervals, point, sections, f);
}

Shape best_shape(ScalarForm form, const JointPath& path, const PathLimits& limits) {
  const double length = path.s.back() - path.s.front();
  if (form == ScalarForm::quintic) return {form, length};
  const DerivativeGrid grid(path, limits);
  const auto lasts = [&](double ramp, double round) {
    return duration(Shape(form, length, ramp, round), grid, limits);
  };
  // Sections: 24 to 1e-5 of the interval. The nested search needs fewer, because its duration is
  // stationary in the parameter that is not yet exact.
  if (form == ScalarForm::trapezoidal) {
    return {form, length, minimised(24, [&](double ramp) { return lasts(ramp, 0); }).x};
  }
  const auto best_round = [&](double ramp) {
    return minimised(12, [&](double round) { return lasts(ramp, round); }).x;
  };
  const double ramp =
      minimised(16, [&](double tried) { return lasts(tried, best_round(tried)); }).x;
  const double round = minimised(24, [&](double tried) { return lasts(ramp, tried); }).x;
  return {form, length, ramp, round};
}

constexpr std::size_t points_between_asks = 64;  // points; then the budget is asked

/// A point of the time scaling, at u = t / T.
struct Point {
  double s, u;
  bool of_grid;  ///< a grid point of the path, else the end of a phase
};

/// The grid points of the path and the ends of the phases, in the order of time.
std::vector<Point> points_of(const Shape& shape, const JointPath& path, BudgetMeter& budget) {
  std::vector<Point> all;
  double u = 0;
  for (std::size_t k = 0; k < path.size(); ++k) {
    if (k % points_between_asks == 0 && budget.ended(0)) return {};
    const bool last = k + 1 == path.size();
    u = k == 0 ? 0 : last ? 1 : shape.time_at(path.s[k] - path.s[0], u);
    all.push_back({path.s[k], u, true});
  }
  for (const double end : shape.phase_ends()) {
    all.push_back({path.s[0] + shape.at(end).position, end, false});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Point& a, const Point& b) { return a.u < b.u; });
  std::vector<Point> kept;
  for (std::size_t i = 0; i < all.size(); ++i) {
    // A phase that ends at a grid point, up to rounding, needs no point of its own.
    const auto apart = [&](const Point& other) {
      return std::abs(all[i].u - other.u) > 1e-9 && all[i].s != other.s;
    };
    const bool alone = i > 0 && i + 1 < all.size() && apart(all[i - 1]) && apart(all[i + 1]);
    if (all[i].of_grid || alone) kept.push_back(all[i]);
  }
  return kept;
}

/// Returns the smallest duration T that the limits allow at the points, on both sides of each, and
/// half-way between them.
double seconds_for(const Shape& shape, const std::vector<Point>& points, const JointPath& path,
                   const PathLimits& limits, BudgetMeter& budget) {
  const PathDerivatives derivatives(path);
  std::vector<double> dq(3 * derivatives.joints());
  double *const ddq = dq.data() + derivatives.joints(), *const dddq = ddq + derivatives.joints();
  LimitFractions fractions(limits);
  double longest = 0;
  std::size_t step = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    if (i % points_between_asks == 0 && budget.ended(0)) break;
    while (step + 2 < path.size() && path.s[step + 1] <= points[i].s) ++step;
    const double begin = path.s[step], h = path.s[step + 1] - begin;
    const double first = points[i].u, length = points[i + 1].u - first;
    for (const double part : {1e-6, 0.5, 1 - 1e-6}) {
      const JointState state = shape.at(first + part * length);
      const double u = std::clamp((path.s[0] + state.position - begin) / h, 0.0, 1.0);
      derivatives.at(step, u, dq.data(), ddq, dddq);
      const auto& fraction = limits.fraction;
      fractions.add(dq.data(), ddq, dddq, state,
                    fraction.empty() ? 1 : std::lerp(fraction[step], fraction[step + 1], u));
    }
    if (limits.speed.empty() || !points[i].of_grid) continue;
    longest = std::max(longest, shape.at(first).velocity / limits.speed[step]);
  }
  return std::max(longest, fractions.slowdown_of(shape.form));
}

}  // namespace

TimeScaling scalar_profile(ScalarForm form, const JointPath& path, const PathLimits& limits,
                           BudgetMeter& budget) {
  check_path(path);
  check_limits(limits, path);
  const Shape shape = best_shape(form, path, limits);
  const std::vector<Point> points = points_of(shape, path, budget);
  const double seconds = seconds_for(shape, points, path, limits, budget);
  if (budget.ended(0)) return ended_scaling(budget);
  TimeScaling scaling;
  scaling.smooth = form != ScalarForm::trapezoidal;
  for (const Point& point : points) {
    const JointState state = shape.at(point.u);
    // At a jump of the trapezoid's acceleration the mean is taken; at the ends, the inner value.
    const double before = shape.at(std::max(point.u - 1e-9, 1e-12)).acceleration;
    const double after = shape.at(std::min(point.u + 1e-9, 1 - 1e-12)).acceleration;
    const bool first = point.u == 0, last = point.u == 1;
    const double mean = first ? after : last ? before : 0.5 * (before + after);
    scaling.s.push_back(point.s);
    scaling.t.push_back(point.u * seconds);
    scaling.speed.push_back(state.velocity / seconds);
    scaling.acceleration.push_back((scaling.smooth ? state.acceleration : mean) /
                                   (seconds * seconds));
  }
  return scaling;
}

}  // namespace beeline::internal
