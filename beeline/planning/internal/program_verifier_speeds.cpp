#include <algorithm>
#include <cmath>

#include <beeline/kinematics/forward.h>
#include <beeline/math/minimise.h>
#include <beeline/planning/internal/program_verifier.h>
#include <beeline/trajectory/internal/append.h>
#include <beeline/trajectory/internal/tool_speed.h>

namespace beeline::internal {
namespace {

constexpr double speed_rounding = 1 + 1e-6;  // of a limit of the tool's speed

/// The motion between samples k and k + 1 from one fraction of this interval to another.
Trajectory part_of_interval(const Trajectory& trajectory, std::size_t k, double from, double to) {
  Trajectory part = samples_between(trajectory, k, k + 1);
  const double begin = part.times[0], duration = part.times[1] - begin;
  const double fractions[] = {from, to};
  for (std::size_t i = 0; i < 2; ++i) {
    if (fractions[i] == static_cast<double>(i)) continue;
    part.times[i] = begin + fractions[i] * duration;
    const TrajectoryState state = sample(trajectory, part.times[i]);
    part.positions[i] = state.position;
    if (!part.velocities.empty()) part.velocities[i] = state.velocity;
    if (!part.accelerations.empty()) part.accelerations[i] = state.acceleration;
  }
  return part;
}

}  // namespace

/// The first interval between two samples in which the tool's speed may exceed a limit. Which
/// intervals are within one is remembered, as several passages ask. None if the budget ends.
std::optional<std::size_t> ProgramVerifier::fast_interval(std::size_t from, std::size_t to,
                                                          const std::optional<double>& limit) {
  if (!limit) return std::nullopt;
  const double largest = *limit * speed_rounding;
  for (std::size_t k = from; k < to; ++k) {
    if (speed_bounds_[k] <= largest) continue;
    if (budget_.ended()) return std::nullopt;
    const double bound =
        tool_speed_bounds(arm_, samples_between(trajectory_, k, k + 1), {largest}).front();
    if (bound > largest) return k;
    speed_bounds_[k] = largest;
  }
  return std::nullopt;
}

bool ProgramVerifier::check_speed(std::size_t move, std::size_t from, std::size_t to,
                                  const std::optional<double>& limit) {
  const std::optional<std::size_t> fast = fast_interval(from, to, limit);
  return !fast || fail_too_fast(move, from, to, *fast, *limit);
}

/// The same for the interval after sample k from one fraction of it to another.
bool ProgramVerifier::check_speed(std::size_t move, std::size_t k, double from, double to,
                                  const std::optional<double>& limit) {
  if (!limit) return true;
  const double largest = *limit * speed_rounding;
  const Trajectory part = part_of_interval(trajectory_, k, from, to);
  return tool_speed_bounds(arm_, part, {largest}).front() <= largest ||
         fail_too_fast(move, k, tool_speed_bound(arm_, part), *limit);
}

/// The same from one time to another.
bool ProgramVerifier::check_speed_between(std::size_t move, SampleTime from, SampleTime to,
                                          const std::optional<double>& limit) {
  // Of an interval. The speed is continuous, so shorter parts have the speed of their neighbours.
  constexpr double shortest = 1e-6;
  const auto check_part = [&](double k, double begin, double end) {
    return end - begin < shortest ||
           check_speed(move, static_cast<std::size_t>(k), begin - k, end - k, limit);
  };
  const double first = std::ceil(from), last = std::floor(to);
  if (first > last) return check_part(last, from, to);
  return check_part(first - 1, from, first) &&
         check_speed(move, static_cast<std::size_t>(first), static_cast<std::size_t>(last),
                     limit) &&
         check_part(last, last, to);
}

/// Fails with the largest speed between two samples or, if the budget ends before it is known, in
/// the interval after sample `fast`.
bool ProgramVerifier::fail_too_fast(std::size_t move, std::size_t from, std::size_t to,
                                    std::size_t fast, double limit) {
  double speed = tool_speed_bound(arm_, samples_between(trajectory_, from, to), budget_);
  if (!budget_.complete()) {
    speed = tool_speed_bound(arm_, samples_between(trajectory_, fast, fast + 1));
  }
  return fail_too_fast(move, from, speed, limit);
}

bool ProgramVerifier::fail_too_fast(std::size_t move, std::size_t k, double speed, double limit) {
  return fail(
      Fault::tool_speed, k, move,
      {ReasonCode::tool_too_fast, {{ReasonField::speed, speed}, {ReasonField::limit, limit}}});
}

/// The distance of the tool from a waypoint, as a fraction of the tolerance.
double ProgramVerifier::offset_at(const Pose& waypoint, SampleTime at) const {
  const auto k = static_cast<std::size_t>(at);
  const double fraction = at - static_cast<double>(k);
  if (fraction == 0) return rests_.offset(waypoint, k);
  const std::vector<double>& t = trajectory_.times;
  const TrajectoryState state = sample(trajectory_, t[k] + fraction * (t[k + 1] - t[k]));
  return rests_.offset(waypoint, forward_kinematics(arm_, state.position));
}

/// Returns the time up to which the tool is within tolerance of a waypoint, from a time at which it
/// is, forwards or backwards to `bound` at most. Looks at eight times in each interval.
ProgramVerifier::SampleTime ProgramVerifier::end_of_neighbourhood(const Pose& waypoint,
                                                                  SampleTime from,
                                                                  SampleTime bound) const {
  constexpr double steps = 8;
  constexpr int bisections = 30;
  double inside = from;
  while (inside != bound) {
    double outside = inside < bound ? std::min((std::floor(inside * steps) + 1) / steps, bound)
                                    : std::max((std::ceil(inside * steps) - 1) / steps, bound);
    if (offset_at(waypoint, outside) > 1) {
      for (int i = 0; i < bisections; ++i) {
        const double middle = (inside + outside) / 2;
        (offset_at(waypoint, middle) > 1 ? outside : inside) = middle;
      }
      return inside;
    }
    inside = outside;
  }
  return bound;
}

/// Returns the interval of sample times from `first` to sample `last` in which the tool is within
/// tolerance of a waypoint that it passes near sample `nearest`; of length 0 if it never is.
ProgramVerifier::NearWaypoint ProgramVerifier::near_waypoint(const Pose& waypoint, SampleTime first,
                                                             std::size_t nearest,
                                                             std::size_t last) const {
  constexpr int intervals = 16, sections = 40;
  const auto end = static_cast<double>(last);
  SampleTime passed = std::max(first, static_cast<double>(nearest));
  if (offset_at(waypoint, passed) > 1) {  // passed between two samples
    const double low = std::max(first, passed - 1), high = std::max(low, std::min(end, passed + 1));
    passed = scan_and_refine(low, high, intervals, sections, [&](double at) {
               return offset_at(waypoint, at);
             }).x;
  }
  return {end_of_neighbourhood(waypoint, passed, first),
          end_of_neighbourhood(waypoint, passed, std::max(passed, end))};
}

/// Checks the speed of move i from a time to sample `reached`, at the end of a segment which the
/// tool passes to the next move; returns the time from which that move's own limit holds. `last` is
/// the move at whose end the tool stops. Within tolerance of the waypoint the largest limit of the
/// moves that meet there holds, as the times at which they begin are only known to the tolerance.
std::optional<ProgramVerifier::SampleTime> ProgramVerifier::check_passing(
    std::size_t i, std::size_t last, const Segment& segment, SampleTime from, std::size_t reached,
    std::size_t end) {
  constexpr double neighbours = 2;  // tolerances between waypoints that the tool may pass at once
  const Pose waypoint = pose_at(segment, 1);
  std::optional<double> largest = program_.moves[i].speed;
  for (std::size_t k = i + 1; k <= last; ++k) {
    const std::optional<double>& next = program_.moves[k].speed;
    largest = largest && next ? std::optional(std::max(*largest, *next)) : std::nullopt;
    if (rests_.offset(waypoint, waypoint_of(arm_, program_.moves[k])) > neighbours) break;
  }
  const NearWaypoint near = near_waypoint(waypoint, from, reached, end);
  if (!check_speed_between(i, from, near.begin, program_.moves[i].speed) ||
      !check_speed_between(i, near.begin, near.end, largest)) {
    return {};
  }
  return near.end;
}

}  // namespace beeline::internal
