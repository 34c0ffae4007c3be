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
  const double speed = tool_speed_bound(arm_, part_of_interval(trajectory_, k, from, to));
  return speed <= *limit * speed_rounding || fail_too_fast(move, k, speed, *limit);
}

/// The same from one time to another.
bool ProgramVerifier::check_speed_between(std::size_t move, SampleTime from, SampleTime to,
                                          const std::optional<double>& limit) {
  constexpr double shortest = 1e-6;  // of an interval: shorter parts belong to their neighbours
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

/// The time up to which the tool stays within tolerance of a waypoint where it is at `from`,
/// forwards or backwards to sample `limit` at most.
ProgramVerifier::SampleTime ProgramVerifier::end_of_stay(const Pose& waypoint, SampleTime from,
                                                         std::size_t limit) const {
  constexpr int bisections = 30;
  const auto bound = static_cast<double>(limit);
  double inside = from;
  while (inside != bound) {
    double outside = inside < bound ? std::floor(inside) + 1 : std::ceil(inside) - 1;
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

/// The time between samples `first` and `last` in which the tool is within tolerance of a waypoint,
/// which it passes near sample `nearest`.
ProgramVerifier::NearWaypoint ProgramVerifier::near_waypoint(const Pose& waypoint,
                                                             std::size_t first, std::size_t nearest,
                                                             std::size_t last) const {
  constexpr int sections = 40;
  const auto at_sample = static_cast<double>(nearest);
  SampleTime passed = at_sample;
  if (offset_at(waypoint, at_sample) > 1) {  // passed between two samples
    passed = golden_section(std::max(static_cast<double>(first), at_sample - 1),
                            std::min(static_cast<double>(last), at_sample + 1), sections,
                            [&](double at) { return offset_at(waypoint, at); })
                 .x;
  }
  return {end_of_stay(waypoint, passed, first), end_of_stay(waypoint, passed, last)};
}

/// Checks the speed of move i from sample `from` to `reached`, at the end of a segment which the
/// tool passes to the next move; returns the sample from which that move's own limit holds. Within
/// tolerance of the waypoint the larger of both limits does, as the time at which the next move
/// begins is only known to the tolerance.
std::optional<std::size_t> ProgramVerifier::check_passing(std::size_t i, const Segment& segment,
                                                          std::size_t from, std::size_t reached,
                                                          std::size_t end) {
  const NearWaypoint near = near_waypoint(pose_at(segment, 1), from, reached, end);
  const auto &limit = program_.moves[i].speed, &next = program_.moves[i + 1].speed;
  const std::optional<double> larger =
      limit && next ? std::optional(std::max(*limit, *next)) : std::nullopt;
  const double after = std::ceil(near.end);
  if (!check_speed_between(i, static_cast<double>(from), near.begin, limit) ||
      !check_speed_between(i, near.begin, near.end, larger) ||
      !check_speed_between(i + 1, near.end, after, next)) {
    return {};
  }
  return static_cast<std::size_t>(after);
}

}  // namespace beeline::internal
