#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/path/internal/joint_path_derivatives.h>
#include <beeline/timing/scalar_profile.h>

namespace beeline {
namespace {

constexpr double least_ramp = 1e-3;  // of the duration
constexpr int place_count = 400;     // at which a shape is tried on the path

/// A scaling that takes one second, by the fractions of what it ramps up: `ramp` of the duration,
/// of which `round` goes to each of the two phases of jerk.
struct Shape {
  ScalarForm form;
  SCurve curve;
  double length;

  Shape(ScalarForm kind, double way, double ramp = 0.5, double round = 0.5)
      : form(kind), length(way) {
    curve.distance = way;
    curve.duration = 1;
    curve.jerk_time = kind == ScalarForm::s_curve ? round * ramp : 0;
    curve.acceleration_time = ramp - 2 * curve.jerk_time;
    curve.cruise_time = 1 - 2 * ramp;
    curve.velocity = way / (1 - ramp);
    curve.acceleration = curve.velocity / (ramp - curve.jerk_time);
    curve.jerk = curve.jerk_time > 0 ? curve.acceleration / curve.jerk_time : Limits::none;
  }

  JointState at(double u) const {
    if (form != ScalarForm::quintic) return beeline::at(curve, u);
    return {length * u * u * u * (10 + u * (-15 + 6 * u)), length * 30 * u * u * (1 + u * (u - 2)),
            length * 60 * u * (1 + u * (2 * u - 3)), length * 60 * (1 + 6 * u * (u - 1))};
  }

  /// The moment at which s is reached, at `after` or later: Newton's method between bounds.
  double moment(double s, double after) const {
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

  /// Between phases the jerk jumps.
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

/// The largest shares of limits that a scaling takes.
class Shares {
 public:
  explicit Shares(const PathLimits& limits)
      : by_velocity_(limits.velocity.cwiseInverse()),
        by_acceleration_(limits.acceleration.cwiseInverse()),
        by_jerk_(limits.jerk.cwiseInverse()) {}

  /// At a place with these derivatives of the path.
  void take(const double* dq, const double* ddq, const double* dddq, const JointState& state) {
    const double v = state.velocity, a = state.acceleration;
    for (Eigen::Index i = 0; i < by_jerk_.size(); ++i) {
      const double bend = dq[i] * a + ddq[i] * v * v;
      const double change = dq[i] * state.jerk + v * (3 * ddq[i] * a + dddq[i] * v * v);
      velocity_ = std::max(velocity_, std::abs(dq[i] * v) * by_velocity_[i]);
      acceleration_ = std::max(acceleration_, std::abs(bend) * by_acceleration_[i]);
      jerk_ = std::max(jerk_, std::abs(change) * by_jerk_[i]);
    }
  }

  /// By what factor the scaling must be slower to keep them.
  double slower(ScalarForm form) const {
    const double least = std::max(velocity_, std::sqrt(acceleration_));
    return form == ScalarForm::trapezoidal ? least : std::max(least, std::cbrt(jerk_));
  }

 private:
  Configuration by_velocity_, by_acceleration_, by_jerk_;
  double velocity_ = 0, acceleration_ = 0, jerk_ = 0;
};

/// The path's derivatives at places a like way apart, to try shapes on.
struct Places {
  std::size_t joints;
  std::vector<double> rates;

  explicit Places(const JointPath& path) : joints(static_cast<std::size_t>(path.q[0].size())) {
    const PathRates along(path);
    rates.resize(3 * joints * (place_count + 1));
    const double begin = path.s.front(), length = path.s.back() - begin;
    std::size_t step = 0;
    for (int k = 0; k <= place_count; ++k) {
      const double s = begin + length * k / place_count;
      while (step + 2 < path.size() && path.s[step + 1] <= s) ++step;
      const double share = (s - path.s[step]) / (path.s[step + 1] - path.s[step]);
      double* dq = rates.data() + 3 * joints * static_cast<std::size_t>(k);
      along.at(step, std::min(share, 1.0), dq, dq + joints, dq + 2 * joints);
    }
  }

  /// The one that is nearest to this share of the way.
  const double* nearest(double share) const {
    const double place = std::clamp(share * place_count + 0.5, 0.0, place_count + 0.5);
    return rates.data() + 3 * joints * static_cast<std::size_t>(place);
  }
};

/// The seconds that the shape takes, told at some moments and the places next to them.
double duration(const Shape& shape, const Places& places, const PathLimits& limits) {
  Shares shares(limits);
  const auto take = [&](double u) {
    const JointState state = shape.at(u);
    const double* dq = places.nearest(state.position / shape.length);
    shares.take(dq, dq + places.joints, dq + 2 * places.joints, state);
  };
  constexpr int moments = 100;
  for (int k = 0; k < moments; ++k) take((k + 0.5) / moments);
  for (const double end : {1e-9, 1 - 1e-9}) take(end);
  for (const double end : shape.phase_ends()) {
    take(end - 1e-9);
    take(end + 1e-9);
  }
  return shares.slower(shape.form);
}

/// The argument in [least_ramp, 0.5] with the least value: the best of a few, then golden sections
/// about it.
template <class Function>
double least(int sections, Function&& value) {
  constexpr int count = 8;
  constexpr double low = least_ramp, high = 0.5;
  const auto place = [&](int k) { return low * std::pow(high / low, double(k) / count); };
  int best = 0;
  double best_value = Limits::none;
  for (int k = 0; k <= count; ++k) {
    const double tried = value(place(k));
    if (tried < best_value) best = k, best_value = tried;
  }
  double a = place(std::max(best - 1, 0)), b = place(std::min(best + 1, count));
  const double golden = 0.5 * (std::sqrt(5.0) - 1);
  double x = b - golden * (b - a), y = a + golden * (b - a);
  double at_x = value(x), at_y = value(y);
  for (int i = 0; i < sections; ++i) {
    if (at_x < at_y) {
      b = y, y = x, at_y = at_x;
      at_x = value(x = b - golden * (b - a));
    } else {
      a = x, x = y, at_x = at_y;
      at_y = value(y = a + golden * (b - a));
    }
  }
  const double found = at_x < at_y ? x : y;
  return std::min(at_x, at_y) < best_value ? found : place(best);
}

Shape best_shape(ScalarForm form, const JointPath& path, const PathLimits& limits) {
  const double length = path.s.back() - path.s.front();
  if (form == ScalarForm::quintic) return {form, length};
  const Places places(path);
  const auto lasts = [&](double ramp, double round) {
    return duration(Shape(form, length, ramp, round), places, limits);
  };
  if (form == ScalarForm::trapezoidal) {
    return {form, length, least(24, [&](double ramp) { return lasts(ramp, 0); })};
  }
  const auto best_round = [&](double ramp) {
    return least(12, [&](double round) { return lasts(ramp, round); });
  };
  const double ramp = least(16, [&](double tried) { return lasts(tried, best_round(tried)); });
  const double round = least(24, [&](double tried) { return lasts(ramp, tried); });
  return {form, length, ramp, round};
}

struct Moment {
  double s, u;
  bool of_grid;  ///< a grid point of the path, else the end of a phase
};

/// When the path's grid points and the ends of the phases are passed, in the order of time.
std::vector<Moment> moments_of(const Shape& shape, const JointPath& path) {
  std::vector<Moment> all;
  double u = 0;
  for (std::size_t k = 0; k < path.size(); ++k) {
    const bool last = k + 1 == path.size();
    u = k == 0 ? 0 : last ? 1 : shape.moment(path.s[k] - path.s[0], u);
    all.push_back({path.s[k], u, true});
  }
  for (const double end : shape.phase_ends()) {
    all.push_back({path.s[0] + shape.at(end).position, end, false});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Moment& a, const Moment& b) { return a.u < b.u; });
  std::vector<Moment> kept;
  for (std::size_t i = 0; i < all.size(); ++i) {
    // A phase that ends at a grid point, but for rounding, is no moment of its own.
    const auto apart = [&](const Moment& other) {
      return std::abs(all[i].u - other.u) > 1e-9 && all[i].s != other.s;
    };
    const bool alone = i > 0 && i + 1 < all.size() && apart(all[i - 1]) && apart(all[i + 1]);
    if (all[i].of_grid || alone) kept.push_back(all[i]);
  }
  return kept;
}

/// The seconds that the scaling takes: what is needed at the moments, on both sides, and half-way
/// between them.
double seconds_for(const Shape& shape, const std::vector<Moment>& moments, const JointPath& path,
                   const PathLimits& limits) {
  const PathRates rates(path);
  std::vector<double> dq(3 * rates.joints());
  double *const ddq = dq.data() + rates.joints(), *const dddq = ddq + rates.joints();
  Shares shares(limits);
  double longest = 0;
  std::size_t step = 0;
  for (std::size_t i = 0; i + 1 < moments.size(); ++i) {
    while (step + 2 < path.size() && path.s[step + 1] <= moments[i].s) ++step;
    const double begin = path.s[step], h = path.s[step + 1] - begin;
    const double first = moments[i].u, length = moments[i + 1].u - first;
    for (const double part : {1e-6, 0.5, 1 - 1e-6}) {
      const JointState state = shape.at(first + part * length);
      const double share = (path.s[0] + state.position - begin) / h;
      rates.at(step, std::clamp(share, 0.0, 1.0), dq.data(), ddq, dddq);
      shares.take(dq.data(), ddq, dddq, state);
    }
    if (limits.speed.empty() || !moments[i].of_grid) continue;
    longest = std::max(longest, shape.at(first).velocity / limits.speed[step]);
  }
  return std::max(longest, shares.slower(shape.form));
}

}  // namespace

SCurve quickest_s_curve(const JointPath& path, const PathLimits& limits) {
  check_path(path);
  check_limits(limits, path);
  const Shape shape = best_shape(ScalarForm::s_curve, path, limits);
  const double seconds = seconds_for(shape, moments_of(shape, path), path, limits);
  SCurve curve = shape.curve;
  for (double* time :
       {&curve.duration, &curve.jerk_time, &curve.acceleration_time, &curve.cruise_time}) {
    *time *= seconds;
  }
  curve.velocity /= seconds;
  curve.acceleration /= seconds * seconds;
  curve.jerk /= seconds * seconds * seconds;
  return curve;
}

TimeScaling scalar_profile(ScalarForm form, const JointPath& path, const PathLimits& limits) {
  check_path(path);
  check_limits(limits, path);
  const Shape shape = best_shape(form, path, limits);
  const std::vector<Moment> moments = moments_of(shape, path);
  const double seconds = seconds_for(shape, moments, path, limits);
  TimeScaling scaling;
  scaling.smooth = form != ScalarForm::trapezoidal;
  for (const Moment& moment : moments) {
    const JointState state = shape.at(moment.u);
    // Where the trapezoid's acceleration jumps the mean; at the ends what the motion begins with.
    const double before = shape.at(std::max(moment.u - 1e-9, 1e-12)).acceleration;
    const double after = shape.at(std::min(moment.u + 1e-9, 1 - 1e-12)).acceleration;
    const bool first = moment.u == 0, last = moment.u == 1;
    const double mean = first ? after : last ? before : 0.5 * (before + after);
    scaling.s.push_back(moment.s);
    scaling.t.push_back(moment.u * seconds);
    scaling.speed.push_back(state.velocity / seconds);
    scaling.acceleration.push_back((scaling.smooth ? state.acceleration : mean) /
                                   (seconds * seconds));
  }
  return scaling;
}

}  // namespace beeline
