#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/internal/thread_scratch.h>
#include <beeline/timing/internal/ended_scaling.h>
#include <beeline/timing/internal/fastest.h>
#include <beeline/timing/internal/step_constraints.h>
#include <beeline/timing/internal/timed_section.h>

namespace beeline::internal {
namespace {

constexpr double simply_slower = 1.001;     // a violation up to this is removed without a new pass
constexpr double shortest_duration = 1e-3;  // seconds, if nothing moves; times must increase

constexpr std::size_t steps_between_asks = 64;  // steps of the path; then the budget is asked

double squared(double x) { return x * x; }

/// Calls f(from, to) for parts of the steps in their order until f returns false or the budget ends
/// the computation.
template <class F>
void for_parts(std::size_t steps, BudgetMeter& budget, const F& f) {
  for (std::size_t from = 0; from < steps && !budget.ended(0); from += steps_between_asks) {
    if (!f(from, std::min(steps, from + steps_between_asks))) return;
  }
}

/// Computes the constraints of a path whose limits have been set.
void prepare(const JointPath& path, const PathLimits& limits, BudgetMeter& budget,
             StepConstraints& constraints) {
  const double fastest = squared((path.s.back() - path.s.front()) / shortest_duration);
  for_parts(path.size() - 1, budget, [&](std::size_t from, std::size_t to) {
    set_constraints(path, limits, fastest, from, to, constraints);
    return true;
  });
}

/// Divides the velocity limits by the factor.
void lower_velocity_limits(const JointPath& path, const PathLimits& limits, double factor,
                           BudgetMeter& budget, StepConstraints& constraints) {
  for (double& slowness : constraints.slowness) slowness *= factor;
  const double begin = constraints.largest.front(), end = constraints.largest.back();
  prepare(path, limits, budget, constraints);
  constraints.largest.front() = begin;  // the given speeds stay
  constraints.largest.back() = end;
}

/// The largest fraction of a velocity limit that is used between the quarters of the steps.
double velocity_fraction(const JointPath& path, const StepConstraints& constraints,
                         BudgetMeter& budget, const std::vector<double>& b) {
  double largest = 0;
  for_parts(path.size() - 1, budget, [&](std::size_t from, std::size_t to) {
    largest = std::max(largest, squared_velocity_fraction(path, constraints, from, to, b.data()));
    return true;
  });
  return std::sqrt(largest);
}

/// The backward pass: the intervals of the squared speeds at the grid points from which the end can
/// be reached. Returns why there are none, or no reason.
Reason controllable_speeds(const JointPath& path, double end_speed,
                           const StepConstraints& constraints, BudgetMeter& budget,
                           std::vector<SquaredSpeeds>& controllable) {
  std::size_t to = path.size() - 1;
  controllable.resize(path.size());
  controllable[to].min = controllable[to].max = squared(end_speed);
  while (to > 0 && !budget.ended(0)) {
    const std::size_t from = to - std::min(to, steps_between_asks);
    const std::size_t failed = controllable_speeds(constraints, from, to, controllable.data());
    if (failed < to) {
      return {ReasonCode::end_speed_unreachable, {{ReasonField::s, path.s[failed]}}};
    }
    to = from;
  }
  return {};
}

/// The backward and the forward pass. Writes the squared speeds at the grid points into b. Returns
/// why there are none; no reason when there are, or the budget has ended the computation.
Reason squared_speeds(const JointPath& path, const EndSpeeds& ends,
                      const StepConstraints& constraints, BudgetMeter& budget,
                      std::vector<double>& b) {
  if (budget.ended(0)) return {};
  const std::size_t last = path.size() - 1;
  const double within = 1 + 1e-9;  // rounding of a speed computed as the largest
  const double largest = constraints.largest[last];
  if (squared(ends.end) > largest * within) {
    return {ReasonCode::end_speed_too_high,
            {{ReasonField::speed, ends.end}, {ReasonField::needed_speed, std::sqrt(largest)}}};
  }
  std::vector<SquaredSpeeds> controllable;
  Reason reason = controllable_speeds(path, ends.end, constraints, budget, controllable);
  if (reason || budget.ended(0)) return reason;
  b.assign(last + 1, 0);
  b[0] = squared(ends.begin);
  if (b[0] > controllable[0].max * within || b[0] * within < controllable[0].min) {
    const bool high = b[0] > controllable[0].max;
    return {
        high ? ReasonCode::begin_speed_too_high : ReasonCode::begin_speed_too_low,
        {{ReasonField::speed, ends.begin},
         {ReasonField::needed_speed, std::sqrt(high ? controllable[0].max : controllable[0].min)}}};
  }
  for_parts(last, budget, [&](std::size_t from, std::size_t to) {
    const std::size_t k = largest_speeds(constraints, from, to, controllable.data(), b.data());
    if (k < to) reason = {ReasonCode::path_not_traversable, {{ReasonField::s, path.s[k]}}};
    return k == to;
  });
  return reason;
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
  ThreadScratch<StepConstraints> scratch;
  StepConstraints& constraints = *scratch;
  begin_constraints(path, limits, constraints);
  prepare(path, limits, budget, constraints);
  std::vector<double> b;
  Reason reason = squared_speeds(path, ends, constraints, budget, b);
  const double found = reason ? 0 : velocity_fraction(path, constraints, budget, b);
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
    lower_velocity_limits(path, limits, over * (1 + 1e-9), budget, constraints);
    reason = squared_speeds(path, ends, constraints, budget, b);
  }
  if (budget.ended(0)) return ended_scaling(budget);
  if (!reason) return scaling_of(path, b);
  TimeScaling none;
  none.reason = std::move(reason);
  return none;
}

}  // namespace beeline::internal
