#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/timing/fastest.h>
#include <beeline/timing/internal/minimise_duration.h>
#include <beeline/timing/internal/quintic_motion.h>
#include <beeline/timing/jerk_limited.h>
#include <beeline/timing/scalar_profile.h>

namespace beeline {
namespace {

constexpr double least_steps = 256;      // of the clock's spline
constexpr double steps_for_point = 0.6;  // of the path's grid, at least
constexpr double least_jump = 1e-3;      // of a limit of jerk: what the clock's knots go to
constexpr double nearest = 0.3;          // of a step: how near knots may be
constexpr double room = 0.7;             // of what limits of velocity leave to b, at the begin
constexpr double side = 1e-6;            // of a step: how far beside grid points one looks
constexpr double distinct = 0.05;        // of a step: knots nearer to a grid point are no places
constexpr double rough = 1.02;           // times slower: for what the clock gets more knots
constexpr double kept = 1.003;           // times slower: what steps with enough knots break limits
constexpr int pieces = 4;                // of a step with too few
constexpr int max_attempts = 5;          // with more and more knots
constexpr double slow = 1.3;             // of the fastest scaling's duration: what stops may better
constexpr double shallowest = 0.25;      // of the speed on both sides, where a stop may do good
constexpr double alike = 2;              // times: two such shares
constexpr int max_halvings = 8;

/// Where the path makes the jerk jump, as the clock can follow that at its knots; in between times
/// a like way apart.
std::vector<double> knots_for(const QuinticMotion& motion) {
  const std::vector<double> jumps = motion.jumps();
  const std::vector<double>& times = motion.times();
  const double steps = std::max(least_steps, steps_for_point * double(times.size()));
  const double step = motion.duration() / steps;
  std::vector<double> knots{0};
  const auto go_to = [&](double end) {
    const double begin = knots.back(), parts = std::round((end - begin) / step);
    for (double part = 1; part < parts; ++part) {
      knots.push_back(begin + part / parts * (end - begin));
    }
    knots.push_back(end);
  };
  for (std::size_t k = 1; k + 1 < times.size(); ++k) {
    const bool apart =
        times[k] > knots.back() + nearest * step && times[k] < motion.duration() - nearest * step;
    if (jumps[k] > least_jump && apart) go_to(times[k]);
  }
  go_to(motion.duration());
  return knots;
}

/// The clock that makes the motion quick.
SquaredRateSpline quick_clock(QuinticMotion& motion, std::vector<double> knots) {
  SquaredRateSpline clock(std::move(knots));
  DurationProblem problem(clock, motion.limits().acceleration, motion.limits().jerk);
  double most = 1;
  for (std::size_t k = 0; k < problem.moments().size(); ++k) {
    const MotionSample& moment = motion.at(problem.moments()[k]);
    most = std::max(most, moment.inverse_most);
    problem.set(k, moment);
  }
  clock.coefficients.setConstant(room / most);
  minimise_duration(clock, problem);
  return clock;
}

/// By what factor the clock must be slower in each of its steps so that the limits are kept between
/// the moments of its problem as well, and on both sides of the path's grid points.
std::vector<double> slower(QuinticMotion& motion, const SquaredRateSpline& clock) {
  const PathLimits& limits = motion.limits();
  std::vector<double> factors(clock.steps());
  auto passed = motion.times().begin();
  for (std::size_t k = 0; k < clock.steps(); ++k) {
    const double begin = clock.knots()[k], length = clock.knots()[k + 1] - begin;
    const SquaredRate first = clock.begin_of(k);
    double velocity = 1, acceleration = 1, jerk = 1;
    const auto look_at = [&](double t) {
      const MotionSample& moment = motion.at(t);
      const SquaredRate rate = first.after(t - begin);
      if (!(rate.b > 0)) velocity = Limits::none;  // a clock that stops is none
      const double root = std::sqrt(rate.b);
      velocity = std::max(velocity, rate.b * moment.inverse_most);
      for (std::size_t i = 0; i < moment.jerk.size(); ++i) {
        const double v = moment.half_velocity[i], a = moment.acceleration[i];
        const double rise = std::abs(a * rate.b + v * rate.slope);
        const double change = moment.jerk[i] * rate.b + 1.5 * a * rate.slope + v * rate.bend;
        const auto joint = static_cast<Eigen::Index>(i);
        acceleration = std::max(acceleration, rise / limits.acceleration[joint]);
        jerk = std::max(jerk, root * std::abs(change) / limits.jerk[joint]);
      }
    };
    for (const double share : {side, 0.25, 0.5, 0.75, 1 - side}) look_at(begin + share * length);
    for (; passed != motion.times().end() && *passed < begin + length; ++passed) {
      if (!(*passed > begin)) continue;
      look_at(*passed - side * length);
      look_at(*passed + side * length);
    }
    factors[k] = std::max({std::sqrt(velocity), std::sqrt(acceleration), std::cbrt(jerk)});
  }
  return factors;
}

/// More knots for the clock, around its steps that break a limit.
std::vector<double> closer(const SquaredRateSpline& clock, const std::vector<double>& factors) {
  std::vector<double> knots{0};
  for (std::size_t k = 0; k < clock.steps(); ++k) {
    const auto near = factors.begin() + std::ptrdiff_t(k);
    const auto end = near + (k + 1 < clock.steps() ? 2 : 1);
    const bool broken = *std::max_element(near - (k > 0 ? 1 : 0), end) > kept;
    const double begin = clock.knots()[k], length = clock.knots()[k + 1] - begin;
    for (int part = 1; broken && part < pieces; ++part) {
      knots.push_back(begin + length * part / pieces);
    }
    knots.push_back(clock.knots()[k + 1]);
  }
  return knots;
}

struct Place {
  double t, s;  ///< the motion's own time
};

/// The path's grid points and the clock's knots, in order.
std::vector<Place> places_of(const QuinticMotion& motion, const SquaredRateSpline& clock) {
  std::vector<Place> all;
  const std::vector<double>& times = motion.times();
  const std::vector<double>& knots = clock.knots();
  std::size_t k = 0;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const double t = knots[i];
    const double hair = distinct * (i == 0 ? knots[1] : t - knots[i - 1]);
    for (; k < times.size() && times[k] < t + hair; ++k) {
      all.push_back({times[k], motion.path().s[k]});
    }
    const double s = motion.along(t).position;
    const bool after = t > all.back().t + hair && s > all.back().s;
    if (after && k < times.size() && s < motion.path().s[k]) all.push_back({t, s});
  }
  return all;
}

/// The seconds that the clock takes for some of the motion's time: Gauss's rule of three points.
double seconds(const SquaredRate& first, double from, double to) {
  const double half = 0.5 * (to - from), middle = 0.5 * (from + to), aside = std::sqrt(0.6) * half;
  const auto pace = [&](double t) { return 1 / std::sqrt(first.after(t).b); };
  return half / 9 * (5 * pace(middle - aside) + 8 * pace(middle) + 5 * pace(middle + aside));
}

TimeScaling law_of(QuinticMotion& motion, const SquaredRateSpline& clock, double factor) {
  TimeScaling scaling;
  scaling.smooth = true;
  const std::vector<double>& knots = clock.knots();
  std::size_t k = 0;
  SquaredRate first = clock.begin_of(0);
  double time = 0, before = 0;
  for (const auto& [t, s] : places_of(motion, clock)) {
    for (; k + 1 < clock.steps() && knots[k + 1] <= t; before = knots[++k]) {
      time += seconds(first, before - knots[k], knots[k + 1] - knots[k]);
      first = clock.begin_of(k + 1);
    }
    time += seconds(first, before - knots[k], t - knots[k]);
    before = t;
    const JointState state = motion.along(t);
    const SquaredRate rate = first.after(t - knots[k]);
    scaling.s.push_back(s);
    scaling.t.push_back(time * factor);
    scaling.speed.push_back(state.velocity * std::sqrt(rate.b) / factor);
    scaling.acceleration.push_back(
        (state.acceleration * rate.b + 0.5 * state.velocity * rate.slope) / (factor * factor));
  }
  return scaling;
}

/// The quickest that one clock for the whole path finds, where it breaks limits with more knots
/// there, so that the whole need not be slowed down for it.
TimeScaling without_a_stop(const JointPath& path, const PathLimits& limits) {
  TimeScaling best = scalar_profile(ScalarForm::quintic, path, limits);
  QuinticMotion motion(path, limits, best);
  std::vector<double> knots = knots_for(motion);
  for (int left = max_attempts; left > 0; --left) {
    const SquaredRateSpline clock = quick_clock(motion, std::move(knots));
    const std::vector<double> factors = slower(motion, clock);
    const double factor = *std::max_element(factors.begin(), factors.end());
    TimeScaling scaling = law_of(motion, clock, factor);
    if (scaling.duration() < best.duration()) best = std::move(scaling);
    if (factor < rough) break;
    knots = closer(clock, factors);
  }
  return best;
}

/// The point at which a stop costs little, as a scaling is slow there and quicker on both sides: of
/// the valleys of its speed that are nearly as deep as the deepest, the one nearest to the middle,
/// which leaves the fewest points to both parts. 0: there is none.
std::size_t tightest(const std::vector<double>& speed) {
  const std::size_t points = speed.size();
  std::vector<double> depth(points);  // speed as a share of what is reached on both sides
  double most = 0, least = 1;
  for (std::size_t k = 0; k < points; depth[k++] = most) most = std::max(most, speed[k]);
  most = 0;
  for (std::size_t k = points - 2; k > 0; --k) {  // both ends are at rest
    most = std::max(most, speed[k]);
    depth[k] = speed[k] / std::min(depth[k], most);
    least = std::min(least, depth[k]);
  }
  const double enough = std::min(shallowest, alike * least);
  const auto aside = [&](std::size_t k) { return std::max(k, points - 1 - k); };
  std::size_t best = 0;
  for (std::size_t k = 1; k + 1 < points; ++k) {
    const bool bottom = speed[k] <= speed[k - 1] && speed[k] <= speed[k + 1];
    if (bottom && depth[k] <= enough && aside(k) < aside(best)) best = k;
  }
  return best;
}

/// From one grid point of the path to another.
struct Part {
  JointPath path;
  PathLimits limits;
};
Part part_of(const JointPath& path, const PathLimits& limits, std::size_t from, std::size_t to) {
  const auto cut = [&](auto& column) {
    using Column = std::decay_t<decltype(column)>;
    return Column(column.begin() + std::ptrdiff_t(from), column.begin() + std::ptrdiff_t(to) + 1);
  };
  Part part{{cut(path.s), cut(path.q), cut(path.dq), cut(path.ddq)}, limits};
  if (!limits.speed.empty()) part.limits.speed = cut(limits.speed);
  return part;
}

void append(TimeScaling& scaling, const TimeScaling& next) {
  const double begin = scaling.duration();
  for (std::size_t k = 1; k < next.s.size(); ++k) {
    scaling.s.push_back(next.s[k]);
    scaling.t.push_back(begin + next.t[k]);
    scaling.speed.push_back(next.speed[k]);
    scaling.acceleration.push_back(next.acceleration[k]);
  }
}

/// The quicker of the scaling without a stop and, where that is slow as the path has a tight spot,
/// of those of both parts that meet at rest there: each again with stops, but for `halvings` times.
TimeScaling with_stops(const JointPath& path, const PathLimits& limits, int halvings) {
  TimeScaling scaling = without_a_stop(path, limits);
  if (halvings == 0 || tightest(scaling.speed) == 0) return scaling;
  const TimeScaling quickest = fastest(path, limits);
  if (scaling.duration() < slow * quickest.duration()) return scaling;
  const std::size_t stop = tightest(quickest.speed);
  if (stop == 0) return scaling;
  const Part first = part_of(path, limits, 0, stop);
  const Part second = part_of(path, limits, stop, path.size() - 1);
  TimeScaling both = with_stops(first.path, first.limits, halvings - 1);
  if (both.duration() > scaling.duration()) return scaling;
  append(both, with_stops(second.path, second.limits, halvings - 1));
  return both.duration() < scaling.duration() ? both : scaling;
}

}  // namespace

TimeScaling jerk_limited(const JointPath& path, const PathLimits& limits) {
  check_path(path);
  check_limits(limits, path);
  if (!limits.jerk.array().isFinite().any()) {
    throw Error("a scaling that keeps limits of jerk needs some: none of the joints has one");
  }
  return with_stops(path, limits, max_halvings);
}

}  // namespace beeline
