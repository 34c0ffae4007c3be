#include <algorithm>
#include <array>
#include <cmath>

#include <beeline/control/internal/played_section.h>
#include <beeline/control/internal/speed_schedule.h>
#include <beeline/error.h>
#include <beeline/trajectory/internal/append.h>
#include <beeline/trajectory/internal/interval_polynomial.h>

namespace beeline::internal {
namespace {

constexpr double max_samples = 1'000'000;
constexpr int max_tries = 60;
constexpr double rounding_margin = 1e-6;  // fraction of a slowdown, for the rounding of times

/// Returns the stop of the motion at this time of the recording; its ends count as stops.
std::optional<std::size_t> stop_at(const PlayedMotion& motion, double s) {
  const auto& times = motion.recording.times;
  if (s <= times.front()) return 0;
  const auto found = std::lower_bound(
      motion.sections.begin(), motion.sections.end(), s,
      [&](const RecordedSection& section, double t) { return times[section.end] < t; });
  if (found == motion.sections.end()) return times.size() - 1;
  if (times[found->end] == s) return found->end;
  return {};
}

/// Returns the state of the recording at a sample, from its columns.
TrajectoryState recorded_state(const Trajectory& recording, std::size_t k) {
  const Configuration zero = Configuration::Zero(recording.positions[k].size());
  return {recording.positions[k], recording.velocities.empty() ? zero : recording.velocities[k],
          recording.accelerations.empty() ? zero : recording.accelerations[k], zero};
}

/// Whether two samples are so near that rounding their times to nanoseconds changes the motion.
bool has_near_samples(const Trajectory& recording, double speed) {
  constexpr double nearest = 4e-9;  // seconds
  for (std::size_t k = 1; k < recording.size(); ++k) {
    if (!((recording.times[k] - recording.times[k - 1]) / speed > nearest)) return true;
  }
  return false;
}

/// Returns times from 0, rounded to nanoseconds if they differ from whole nanoseconds only by
/// rounding.
Trajectory from_zero(const Trajectory& recording, bool round) {
  constexpr double same = 1e-12;  // seconds
  Trajectory played = recording;
  for (double& t : played.times) {
    t -= recording.times.front();
    const double rounded = round_to_nanoseconds(t);
    if (round && std::abs(rounded - t) <= same) t = rounded;
  }
  return played;
}

}  // namespace

Trajectory samples_at(const PlayedMotion& motion, const std::vector<double>& times,
                      std::span<const ParameterState> progress) {
  Trajectory played{motion.arm.joint_names(), times, {}, {}, {}};
  constexpr std::size_t batch = 64;  // samples, which take about a microsecond
  for (const ParameterState& now : progress) {
    if (played.positions.size() % batch == 0 && motion.budget.ended(batch)) return {};
    const auto stop = stop_at(motion, now.s);
    const TrajectoryState state =
        stop ? recorded_state(motion.recording, *stop) : sample(motion.recording, now.s);
    played.positions.push_back(state.position);
    played.velocities.push_back(now.speed * state.velocity);
    played.accelerations.push_back(now.speed * now.speed * state.acceleration +
                                   now.acceleration * state.velocity);
  }
  keep_columns(played, motion.interpolation);
  return played;
}

Trajectory recorded_samples(const PlayedMotion& motion, double speed, double slowdown) {
  constexpr double rounding = 1e-3;  // nanoseconds
  const Trajectory& recording = motion.recording;
  const bool round = !has_near_samples(recording, speed / slowdown);
  Trajectory played = from_zero(recording, round);
  if (speed == 1 && slowdown == 1) return played;
  const auto set = [&](std::size_t k, double t, double own, const TrajectoryState& state) {
    played.times[k] = t;
    played.positions[k] = state.position;
    if (!played.velocities.empty()) played.velocities[k] = own * state.velocity;
    if (!played.accelerations.empty()) played.accelerations[k] = own * own * state.acceleration;
  };
  double begin = 0, before = Limits::none;  // the limit is the speed before the stop
  for (const auto& [first, last, rests] : motion.sections) {
    const double t0 = recording.times[first], length = recording.times[last] - t0;
    double own = rests ? std::min(1.0, speed) : speed / slowdown;
    double end = begin + length / own;
    if (round) {
      end = std::ceil(end * 1e9 - rounding) / 1e9;
      own = length / (end - begin);
    }
    set(first, begin, std::min(before, own), recorded_state(recording, first));
    for (std::size_t k = first + 1; k < last; ++k) {
      const double exact = begin + (recording.times[k] - t0) / own;
      const double t = round ? round_to_nanoseconds(exact) : exact;
      const bool moved = t != exact;
      set(k, t, own,
          moved ? sample(recording, recording.times[k] + own * (t - exact))
                : recorded_state(recording, k));
    }
    set(last, end, own, recorded_state(recording, last));
    before = own;
    begin = end;
  }
  return played;
}

double time_at_rate(std::size_t k, double rate) {
  return round_to_nanoseconds(static_cast<double>(k) / rate);
}

std::vector<double> times_from(std::size_t first, std::size_t count, double rate) {
  std::vector<double> times;
  for (std::size_t k = 0; k < count; ++k) {
    times.push_back(time_at_rate(first + k, rate) - time_at_rate(first, rate));
  }
  return times;
}

void check_samples(double samples, double duration, double rate) {
  if (samples < max_samples) return;
  throw Error::of("rate", "replaying " + number(duration) + " s at " + number(rate) +
                              " samples per second makes more than " + number(max_samples) +
                              " samples");
}

PlayedSection ended_section(const PlayedMotion& motion) {
  const Ending ending = motion.budget.ending();
  return {.trajectory = {}, .reason = ended_reason(ReasonCode::ended_before_samples, ending)};
}

PlayedSection at_constant_speed(const PlayedMotion& motion, double speed, double rate) {
  if (rate > 0 && !motion.sections.empty()) return in_periods(motion, speed, rate);
  PlayedSection section;
  const double asked = recorded_samples(motion, speed, 1).times.back();
  std::optional<LimitExcess> excess;
  double slowdown = 1;
  for (int tries = 0; tries < max_tries && slowdown <= motion.max_slowdown; ++tries) {
    if (motion.budget.ended()) return ended_section(motion);
    section.trajectory = recorded_samples(motion, speed, slowdown);
    excess = largest_excess(motion.held, section.trajectory);
    if (!excess) {
      if (asked > 0) section.slowdown = section.trajectory.times.back() / asked;
      return section;
    }
    slowdown *= excess->slowdown * (1 + rounding_margin);
  }
  section.reason = exceeded_limit(motion.arm, section.trajectory, *excess);
  section.trajectory = {};
  return section;
}

PlayedSection with_speed_changes(const PlayedMotion& motion, const ReplayOptions& options,
                                 double rate) {
  // Fraction of a slowdown taken at once: other samples are the worst later.
  constexpr double at_once = 0.8;
  PlayedSection section;
  Reason first_excess;
  double smallest_step = 0;
  for (double scale = 1; scale * motion.max_slowdown >= 1;) {
    if (motion.budget.ended()) return ended_section(motion);
    std::vector<ParameterState> progress =
        scheduled_progress(motion.arm, motion.recording,
                           {options, rate, motion.first, scale, motion.sections, motion.budget});
    const auto times = times_from(motion.first, progress.size(), rate);
    for (std::size_t k = 1; k + 1 < progress.size(); ++k) {
      if (stop_at(motion, progress[k].s)) continue;
      progress[k].s += (times[k] - static_cast<double>(k) / rate) * progress[k].speed;
    }
    section.trajectory = samples_at(motion, times, progress);
    if (section.trajectory.size() == 0) return ended_section(motion);
    section.slowdown = 1 / scale;
    const auto excess = largest_excess(motion.held, section.trajectory);
    if (!excess) return section;
    if (!first_excess) first_excess = exceeded_limit(motion.arm, section.trajectory, *excess);
    // The steps grow, so that a motion that no slowdown helps is refused after few steps.
    constexpr double least = 0.002, growth = 1.6;
    smallest_step = std::max(smallest_step * growth, least);
    scale /= 1 + std::max(smallest_step, at_once * std::min(excess->slowdown - 1, 1.0));
  }
  section.reason = first_excess.set(ReasonField::rate, rate);
  section.trajectory = {};
  return section;
}

}  // namespace beeline::internal
