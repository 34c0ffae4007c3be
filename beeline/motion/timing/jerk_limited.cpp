#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/motion/timing/clock_barrier.h>
#include <beeline/motion/timing/jerk_limited.h>
#include <beeline/motion/timing/scalar_law.h>

namespace beeline {
namespace {

constexpr std::size_t least_steps = 400;  // of the clock's spline
constexpr double room = 0.7;              // b at the begin of the search: all limits have room
constexpr double side = 1e-9;             // of a step: how far inside one looks at its ends
constexpr double looks[] = {side, 0.25, 0.5, 0.75, 1 - side};  // within a step, at the result

/// The path with the s-curve along it: a motion by its own time.
struct Motion {
  const JointPath& path;
  const PathLimits& limits;
  SCurve curve;

  std::size_t step_at(double s) const {
    const auto after = std::upper_bound(path.s.begin(), path.s.end(), s);
    const auto index = static_cast<std::size_t>(after - path.s.begin());
    return std::clamp<std::size_t>(index, 1, path.size() - 1) - 1;
  }

  ClockMoment moment(double t) const {
    const JointState state = at(curve, t);
    const double s = path.s[0] + state.position;
    const std::size_t k = step_at(s);
    const double share = (s - path.s[k]) / (path.s[k + 1] - path.s[k]);
    const PathPoint point = path_point(path, k, std::clamp(share, 0.0, 1.0));
    const double speed = state.velocity;
    const Configuration v = point.dq * speed;
    const Configuration a = point.dq * state.acceleration + point.ddq * speed * speed;
    const Configuration j = point.dq * state.jerk + 3 * speed * state.acceleration * point.ddq +
                            speed * speed * speed * point.dddq;
    ClockMoment moment;
    moment.acceleration_v = v.cwiseQuotient(limits.acceleration);
    moment.acceleration_a = a.cwiseQuotient(limits.acceleration);
    moment.jerk_v = v.cwiseQuotient(limits.jerk);
    moment.jerk_a = a.cwiseQuotient(limits.jerk);
    moment.jerk_j = j.cwiseQuotient(limits.jerk);
    double slowest = v.cwiseQuotient(limits.velocity).lpNorm<Eigen::Infinity>();
    if (!limits.speed.empty()) {
      slowest = std::max(slowest, speed / std::min(limits.speed[k], limits.speed[k + 1]));
    }
    moment.most = 1 / (slowest * slowest);
    return moment;
  }

  /// The ends of the curve's phases, and between them steps of a like length.
  std::vector<double> knots() const {
    std::vector<double> knots{0};
    const double steps = double(std::max(least_steps, path.size()));
    double end = 0;
    for (const double phase :
         {curve.jerk_time, curve.acceleration_time, curve.jerk_time, curve.cruise_time,
          curve.jerk_time, curve.acceleration_time, curve.jerk_time}) {
      const double begin = end;
      end += phase;
      const double count = std::ceil(phase / curve.duration * steps - 1e-9);
      if (phase < 1e-6 * curve.duration) continue;
      for (double k = 1; k <= count; ++k) knots.push_back(begin + phase * k / count);
    }
    knots.back() = curve.duration;
    return knots;
  }
};

/// The motion's time at which the path's grid points are passed.
std::vector<double> passed(const Motion& motion) {
  std::vector<double> times{0};
  for (std::size_t k = 1; k + 1 < motion.path.size(); ++k) {
    const double s = motion.path.s[k] - motion.path.s[0];
    double low = times.back(), high = motion.curve.duration;
    for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
      const double middle = 0.5 * (low + high);
      (at(motion.curve, middle).position < s ? low : high) = middle;
    }
    times.push_back(high);
  }
  times.push_back(motion.curve.duration);
  return times;
}

/// The seconds that the clock takes from one time of the motion to another within step k: Gauss's
/// rule of three points.
double seconds(const ClockSpline& clock, std::size_t k, double from, double to) {
  const double half = 0.5 * (to - from), middle = 0.5 * (from + to), aside = std::sqrt(0.6) * half;
  const auto pace = [&](double t) { return 1 / std::sqrt(clock.at(k, t).b); };
  return half / 9 * (5 * pace(middle - aside) + 8 * pace(middle) + 5 * pace(middle + aside));
}

struct Place {
  double t, s;  ///< the motion's own time
  bool of_grid;
};

/// The path's grid points and the clock's knots, in order.
std::vector<Place> places_of(const Motion& motion, const ClockSpline& clock) {
  std::vector<Place> all;
  const std::vector<double> times = passed(motion);
  for (std::size_t k = 0; k < times.size(); ++k) all.push_back({times[k], motion.path.s[k], true});
  for (const double t : clock.knots()) {
    all.push_back({t, motion.path.s[0] + at(motion.curve, t).position, false});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Place& a, const Place& b) { return a.t < b.t; });
  std::vector<Place> kept;
  const double hair = 0.25 * motion.curve.duration / double(clock.steps());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto apart = [&](const Place& other) {
      return std::abs(other.t - all[i].t) > hair && other.s != all[i].s;
    };
    const bool alone = i > 0 && i + 1 < all.size() && apart(all[i - 1]) && apart(all[i + 1]);
    if (all[i].of_grid || alone) kept.push_back(all[i]);
  }
  return kept;
}

/// By what factor the clock must be slower so that the limits are kept between its knots as well,
/// and on both sides of the places.
double slower(const Motion& motion, const ClockSpline& clock, const std::vector<Place>& places) {
  double longest = 0;
  const auto look_at = [&](std::size_t k, double t) {
    const ClockShares most = shares(motion.moment(t), clock.at(k, t));
    longest = std::max({longest, std::sqrt(most.velocity_squared), std::sqrt(most.acceleration),
                        std::cbrt(most.jerk)});
  };
  auto place = places.begin();
  for (std::size_t k = 0; k < clock.steps(); ++k) {
    const double begin = clock.knots()[k], length = clock.knots()[k + 1] - begin;
    for (const double look : looks) look_at(k, begin + look * length);
    for (; place != places.end() && place->t < begin + length; ++place) {
      if (!(place->t > begin)) continue;
      look_at(k, place->t - side * length);
      look_at(k, place->t + side * length);
    }
  }
  return longest;
}

PathLaw law_of(const Motion& motion, const ClockSpline& clock) {
  const std::vector<Place> places = places_of(motion, clock);
  const double factor = slower(motion, clock, places);
  PathLaw law;
  law.smooth = true;
  std::size_t k = 0;
  double time = 0, before = 0;
  for (const Place& place : places) {
    for (; k + 1 < clock.steps() && clock.knots()[k + 1] <= place.t; ++k) {
      time += seconds(clock, k, before, clock.knots()[k + 1]);
      before = clock.knots()[k + 1];
    }
    time += seconds(clock, k, before, place.t);
    before = place.t;
    const JointState state = at(motion.curve, place.t);
    const ClockRate rate = clock.at(k, place.t);
    law.s.push_back(place.s);
    law.t.push_back(time * factor);
    law.speed.push_back(state.velocity * std::sqrt(rate.b) / factor);
    law.acceleration.push_back((state.acceleration * rate.b + 0.5 * state.velocity * rate.slope) /
                               (factor * factor));
  }
  return law;
}

}  // namespace

PathLaw jerk_limited(const JointPath& path, const PathLimits& limits) {
  check_path(path);
  check_limits(limits, path);
  if (!limits.jerk.array().isFinite().any()) {
    throw Error("a law that keeps limits of jerk needs some: none of the joints has one");
  }
  const Motion motion{path, limits, quickest_s_curve(path, limits)};
  ClockSpline clock(motion.knots());
  std::vector<ClockMoment> moments;
  for (std::size_t k = 0; k < clock.steps(); ++k) {
    // Where the motion stands still, b has no bounds at the step's own end.
    const bool outermost = k == 0 || k + 1 == clock.steps();
    const double begin = clock.knots()[k], length = clock.knots()[k + 1] - begin;
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      if ((share == 0.25 || share == 0.75) && !outermost) continue;
      moments.push_back(motion.moment(begin + std::clamp(share, side, 1 - side) * length));
      moments.back().step = k;
      moments.back().share = share;
    }
  }
  const PathLaw plain = law_of(motion, clock);
  clock.coefficients *= room;
  hasten(clock, moments);
  const PathLaw quintic = scalar_law(ScalarForm::quintic, path, limits);
  PathLaw best = law_of(motion, clock);
  for (const PathLaw* simple : {&plain, &quintic}) {
    if (simple->duration() < best.duration()) best = *simple;
  }
  return best;
}

}  // namespace beeline
