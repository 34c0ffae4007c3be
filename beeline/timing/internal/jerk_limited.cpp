#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/timing/internal/ended_scaling.h>
#include <beeline/timing/internal/fastest.h>
#include <beeline/timing/internal/jerk_limited.h>
#include <beeline/timing/internal/minimise_duration.h>
#include <beeline/timing/internal/quintic_motion.h>
#include <beeline/timing/internal/scalar_profile.h>
#include <beeline/timing/internal/timed_section.h>
#include <beeline/trajectory/limit_usage.h>

namespace beeline::internal {
namespace {

// Min number of steps of the spline. The computing time is linear in their number; with fewer, the
// result differs from the optimum by more than 1e-3.
constexpr double min_steps = 256;
constexpr double steps_per_point = 0.6;  // of the path's grid, at least
constexpr double min_jump = 1e-3;        // of a jerk limit: larger jumps of d3q/ds3 get a knot
constexpr double smallest_distance =
    0.3;                           // between knots, in steps: closer ones are badly conditioned
constexpr double distinct = 0.05;  // of a step: a knot nearer to a grid point gets no point
constexpr double side = 1e-6;      // of a step: on both sides of grid points, where jerk jumps

// The starting point as a fraction of the velocity limits: strictly inside them.
constexpr double start_fraction = 0.7;

// Refinement where the limits are violated between the constrained times. The whole motion is
// slowed down by the largest violation, so large ones justify more knots.
constexpr double acceptable = 1.02;  // slowdown of the motion
constexpr double kept = 1.003;       // slowdown of a step that counts as within the limits
constexpr int refined_parts = 4;     // into which a violating step and its neighbours are divided
constexpr int max_attempts = 5;
// On longer grids attempts take seconds each, and refined knots rarely help: d3q/ds3 jumps at the
// many ends of short segments.
constexpr std::size_t large_grid = 2000;  // grid points
constexpr int max_large_attempts = 2;

// Stops are tried at minima of the speed if the motion is much slower than without jerk limits.
constexpr double slow = 1.3;       // times the duration of fastest()
constexpr double deep = 0.25;      // of the speed on both sides: a minimum that may be a stop
constexpr double similar = 2;      // ratio of two such depths that are taken as equal
constexpr int max_bisections = 8;  // of the path, each with another stop

/// Returns knots at the path's grid points where d3q/ds3 is discontinuous, so that the third
/// derivative of the time scaling can be too, and at equal distances between them.
std::vector<double> knots_for(const QuinticMotion& motion) {
  const std::vector<double> jumps = motion.jerk_jumps();
  const std::vector<double>& times = motion.times();
  const double steps = std::max(min_steps, steps_per_point * double(times.size()));
  const double step = motion.duration() / steps;
  std::vector<double> knots{0};
  const auto add_until = [&](double end) {
    const double begin = knots.back(), parts = std::round((end - begin) / step);
    for (double part = 1; part < parts; ++part) {
      knots.push_back(begin + part / parts * (end - begin));
    }
    knots.push_back(end);
  };
  const double gap = smallest_distance * step;
  for (std::size_t k = 1; k + 1 < times.size(); ++k) {
    const bool apart = times[k] > knots.back() + gap && times[k] < motion.duration() - gap;
    if (jumps[k] > min_jump && apart) add_until(times[k]);
  }
  add_until(motion.duration());
  return knots;
}

/// Whether the result is no longer wanted; where another limit ended the search, it is.
bool cancelled(BudgetMeter& budget) {
  return budget.ended(0) && budget.ending() == Ending::cancelled;
}

/// The same, asked at some of the steps k.
bool cancelled(BudgetMeter& budget, std::size_t k) { return k % 64 == 0 && cancelled(budget); }

/// Minimises the duration over the splines with these knots.
SquaredRateSpline optimal_rate(QuinticMotion& motion, std::vector<double> knots,
                               BudgetMeter& budget) {
  SquaredRateSpline spline(std::move(knots));
  DurationProblem problem(spline, motion.limits().acceleration, motion.limits().jerk);
  double largest = 1;
  for (std::size_t k = 0; k < problem.times().size() && !cancelled(budget, k); ++k) {
    const MotionSample& sample = motion.at(problem.times()[k]);
    largest = std::max(largest, sample.inverse_max);
    problem.set(k, sample);
  }
  spline.coefficients.setConstant(start_fraction / largest);
  if (!cancelled(budget)) minimise_duration(spline, problem, budget);
  return spline;
}

/// Returns the factor by which the motion must be slowed down at tau to keep the limits.
double slowdown_at(QuinticMotion& motion, double tau, const SquaredRate& rate) {
  const PathLimits& limits = motion.limits();
  const MotionSample& sample = motion.at(tau);
  if (!(rate.b > 0)) return Limits::none;  // not a time scaling
  const double root = std::sqrt(rate.b);
  double acceleration = 1, jerk = 1;
  for (std::size_t i = 0; i < sample.jerk.size(); ++i) {
    const double v = sample.half_velocity[i], a = sample.acceleration[i];
    const double ddq = std::abs(a * rate.b + v * rate.db);
    const double dddq = sample.jerk[i] * rate.b + 1.5 * a * rate.db + v * rate.ddb;
    const auto joint = static_cast<Eigen::Index>(i);
    acceleration = std::max(acceleration, ddq / limits.acceleration[joint]);
    jerk = std::max(jerk, root * std::abs(dddq) / limits.jerk[joint]);
  }
  return slowdown_factor(root * std::sqrt(sample.inverse_max), acceleration, jerk);
}

/// The same for each step of the spline: the largest at its ends, three times between them, and on
/// both sides of the path's grid points.
std::vector<double> slowdowns(QuinticMotion& motion, const SquaredRateSpline& spline,
                              BudgetMeter& budget) {
  std::vector<double> factors(spline.steps());
  auto passed = motion.times().begin();
  for (std::size_t k = 0; k < spline.steps() && !cancelled(budget, k); ++k) {
    const double begin = spline.knots()[k], length = spline.knots()[k + 1] - begin;
    const SquaredRate first = spline.begin_of(k);
    double& factor = factors[k];
    const auto check = [&](double tau) {
      factor = std::max(factor, slowdown_at(motion, tau, first.after(tau - begin)));
    };
    for (const double u : {side, 0.25, 0.5, 0.75, 1 - side}) check(begin + u * length);
    for (; passed != motion.times().end() && *passed < begin + length; ++passed) {
      if (!(*passed > begin)) continue;
      check(*passed - side * length);
      check(*passed + side * length);
    }
  }
  return factors;
}

/// The knots of the spline, and more in and beside the steps that violate a limit.
std::vector<double> refined_knots(const SquaredRateSpline& spline,
                                  const std::vector<double>& factors) {
  std::vector<double> knots{0};
  for (std::size_t k = 0; k < spline.steps(); ++k) {
    const auto here = factors.begin() + std::ptrdiff_t(k);
    const auto end = here + (k + 1 < spline.steps() ? 2 : 1);
    const bool violated = *std::max_element(here - (k > 0 ? 1 : 0), end) > kept;
    const double begin = spline.knots()[k], length = spline.knots()[k + 1] - begin;
    for (int part = 1; violated && part < refined_parts; ++part) {
      knots.push_back(begin + length * part / refined_parts);
    }
    knots.push_back(spline.knots()[k + 1]);
  }
  return knots;
}

struct ScalingPoint {
  double tau, s;
};

/// The points of the time scaling: the path's grid points and the knots of the spline, in order.
std::vector<ScalingPoint> scaling_points(const QuinticMotion& motion,
                                         const SquaredRateSpline& spline) {
  std::vector<ScalingPoint> all;
  const std::vector<double>& times = motion.times();
  const std::vector<double>& knots = spline.knots();
  std::size_t k = 0;
  for (std::size_t i = 0; i < knots.size(); ++i) {
    const double tau = knots[i];
    const double near = distinct * (i == 0 ? knots[1] : tau - knots[i - 1]);
    for (; k < times.size() && times[k] < tau + near; ++k) {
      all.push_back({times[k], motion.path().s[k]});
    }
    const double s = motion.along(tau).position;
    const bool after = tau > all.back().tau + near && s > all.back().s;
    if (after && k < times.size() && s < motion.path().s[k]) all.push_back({tau, s});
  }
  return all;
}

/// The integral of b^(-1/2) over part of a step, by the Gauss rule of three points: seconds.
double seconds(const SquaredRate& first, double from, double to) {
  const double half = 0.5 * (to - from), middle = 0.5 * (from + to), node = std::sqrt(0.6) * half;
  const auto f = [&](double dtau) { return 1 / std::sqrt(first.after(dtau).b); };
  return half / 9 * (5 * f(middle - node) + 8 * f(middle) + 5 * f(middle + node));
}

TimeScaling scaling_of(const QuinticMotion& motion, const SquaredRateSpline& spline,
                       BudgetMeter& budget) {
  TimeScaling scaling;
  scaling.smooth = true;
  const std::vector<double>& knots = spline.knots();
  std::size_t k = 0;
  SquaredRate first = spline.begin_of(0);
  double time = 0, before = 0;
  for (const auto& [tau, s] : scaling_points(motion, spline)) {
    if (cancelled(budget, scaling.s.size())) return ended_scaling(budget);
    for (; k + 1 < spline.steps() && knots[k + 1] <= tau; before = knots[++k]) {
      time += seconds(first, before - knots[k], knots[k + 1] - knots[k]);
      first = spline.begin_of(k + 1);
    }
    time += seconds(first, before - knots[k], tau - knots[k]);
    before = tau;
    const JointState state = motion.along(tau);
    const SquaredRate rate = first.after(tau - knots[k]);
    scaling.s.push_back(s);
    scaling.t.push_back(time);
    scaling.speed.push_back(state.velocity * std::sqrt(rate.b));
    scaling.acceleration.push_back(state.acceleration * rate.b + 0.5 * state.velocity * rate.db);
  }
  return scaling;
}

/// Returns the best time scaling of the whole path by one spline among several attempts. Each has
/// more knots where the previous one violates limits, because slowing the whole motion down
/// increases the duration everywhere.
TimeScaling without_stops(const JointPath& path, const PathLimits& limits, BudgetMeter& budget) {
  TimeScaling best = scalar_profile(ScalarForm::quintic, path, limits, budget);
  if (!best) return best;
  QuinticMotion motion(path, limits, best);
  std::vector<double> knots = knots_for(motion);
  const int attempts = path.size() > large_grid ? max_large_attempts : max_attempts;
  for (int attempt = 0; attempt < attempts && !budget.ended(); ++attempt) {
    const SquaredRateSpline spline = optimal_rate(motion, std::move(knots), budget);
    const std::vector<double> factors = slowdowns(motion, spline, budget);
    const double factor = *std::max_element(factors.begin(), factors.end());
    TimeScaling scaling = scaling_of(motion, spline, budget);
    if (cancelled(budget)) break;
    slow_down(scaling, factor);
    if (scaling.duration() < best.duration()) best = std::move(scaling);
    if (factor < acceptable) break;
    knots = refined_knots(spline, factors);
  }
  return best;
}

/// Returns the grid point at which a stop increases the duration least: a minimum of the speed that
/// is deep relative to the speeds on both sides. Among minima of similar depth it is the one
/// nearest to the middle, which makes both parts short. Returns 0 if there is none.
std::size_t best_stop(const std::vector<double>& speed) {
  const std::size_t points = speed.size();
  std::vector<double> depth(points);  // the speed as a fraction of the largest on either side
  double largest = 0, smallest = 1;
  for (std::size_t k = 0; k < points; ++k) {
    largest = std::max(largest, speed[k]);
    depth[k] = largest;
  }
  largest = 0;
  for (std::size_t k = points - 2; k > 0; --k) {  // both ends are at rest
    largest = std::max(largest, speed[k]);
    depth[k] = speed[k] / std::min(depth[k], largest);
    smallest = std::min(smallest, depth[k]);
  }
  const double enough = std::min(deep, similar * smallest);
  const auto longer_part = [&](std::size_t k) { return std::max(k, points - 1 - k); };
  std::size_t best = 0;
  for (std::size_t k = 1; k + 1 < points; ++k) {
    const bool minimum = speed[k] <= speed[k - 1] && speed[k] <= speed[k + 1];
    if (minimum && depth[k] <= enough && longer_part(k) < longer_part(best)) best = k;
  }
  return best;
}

/// A path from one of its grid points to another, with its limits.
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
  if (!limits.fraction.empty()) part.limits.fraction = cut(limits.fraction);
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

/// Returns the time scaling without stops or, if that is slow because of a tight corner, the faster
/// of it and the one that stops there. Both parts are computed by recursion, to this depth.
TimeScaling with_stops(const JointPath& path, const PathLimits& limits, int bisections,
                       BudgetMeter& budget) {
  TimeScaling scaling = without_stops(path, limits, budget);
  if (!scaling || bisections == 0 || budget.ended() || best_stop(scaling.speed) == 0)
    return scaling;
  const TimeScaling bound = fastest(path, limits, {}, budget);
  if (!bound || scaling.duration() < slow * bound.duration()) return scaling;
  const std::size_t stop = best_stop(bound.speed);
  if (stop == 0) return scaling;
  const Part first = part_of(path, limits, 0, stop);
  const Part second = part_of(path, limits, stop, path.size() - 1);
  TimeScaling both = with_stops(first.path, first.limits, bisections - 1, budget);
  if (!both || both.duration() > scaling.duration()) return scaling;
  const TimeScaling rest = with_stops(second.path, second.limits, bisections - 1, budget);
  if (!rest) return scaling;
  append(both, rest);
  return both.duration() < scaling.duration() ? both : scaling;
}

}  // namespace

TimeScaling jerk_limited(const JointPath& path, const PathLimits& limits, BudgetMeter& budget) {
  check_path(path);
  check_limits(limits, path);
  if (!limits.jerk.array().isFinite().any()) {
    throw Error("profile jerk needs a limit of jerk: none of the joints has one");
  }
  return with_stops(path, limits, max_bisections, budget);
}

}  // namespace beeline::internal
