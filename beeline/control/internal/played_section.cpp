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
constexpr double max_slowdown = 2;  // beyond whole periods
constexpr int max_tries = 60;
constexpr double at_once = 0.8;  // of a slowdown with a rate: other samples are the worst later
constexpr double rounding_margin = 1e-6;  // of a slowdown, for the rounding of times

/// The samples at these times; none where the budget ends.
Trajectory samples_at(const PlayedMotion& motion, const std::vector<double>& times,
                      std::span<const Progress> progress) {
  Trajectory played{motion.arm.joint_names(), times, {}, {}, {}};
  const double last = motion.recording.times.back();
  constexpr std::size_t batch = 64;  // samples, of about a microsecond
  for (const Progress& now : progress) {
    if (played.positions.size() % batch == 0 && ended(motion.budget, batch)) return {};
    const bool ends = now.s >= last && motion.recording.size() > 1;
    const TrajectoryState state =
        sample(motion.recording, std::min(now.s, last), ends ? Side::before : Side::after);
    played.positions.push_back(state.position);
    played.velocities.push_back(now.speed * state.velocity);
    played.accelerations.push_back(now.speed * now.speed * state.acceleration +
                                   now.acceleration * state.velocity);
  }
  played.positions.front() = motion.recording.positions.front();
  if (progress.back().s >= last) played.positions.back() = motion.recording.positions.back();
  keep_columns(played, motion.interpolation);
  return played;
}

/// The recorded samples. At another speed than their own their times are rounded to whole
/// nanoseconds, along the motion, unless they are too near to one another.
Trajectory recorded_samples(const PlayedMotion& motion, double speed) {
  constexpr double same = 1e-12, nearest = 4e-9;  // seconds
  const Trajectory& recording = motion.recording;
  Trajectory played = recording;
  double shortest = Limits::none;
  for (std::size_t k = 1; k < recording.size(); ++k) {
    shortest = std::min(shortest, (recording.times[k] - recording.times[k - 1]) / speed);
  }
  for (Configuration& v : played.velocities) v *= speed;
  for (Configuration& a : played.accelerations) a *= speed * speed;
  for (std::size_t k = 0; k < recording.size(); ++k) {
    const double exact = (recording.times[k] - recording.times.front()) / speed;
    const double rounded = round_to_nanoseconds(exact), moved = rounded - exact;
    played.times[k] = exact;
    if (!(shortest > nearest)) continue;
    if (std::abs(moved) > same && speed == 1) continue;
    played.times[k] = rounded;
    if (std::abs(moved) <= same || k + 1 == recording.size()) continue;
    const TrajectoryState state = sample(recording, recording.times[k] + speed * moved);
    played.positions[k] = state.position;
    if (!played.velocities.empty()) played.velocities[k] = speed * state.velocity;
    if (!played.accelerations.empty()) {
      played.accelerations[k] = speed * speed * state.acceleration;
    }
  }
  keep_columns(played, motion.interpolation);
  return played;
}

/// Times at the rate from 0, for a motion that begins at sample `first`.
std::vector<double> times_from(std::size_t first, std::size_t count, double rate) {
  std::vector<double> times;
  for (std::size_t k = 0; k < count; ++k) {
    times.push_back(time_at_rate(first + k, rate) - time_at_rate(first, rate));
  }
  return times;
}

/// Samples at the rate, so many periods long.
Trajectory in_periods_at(const PlayedMotion& motion, double periods, double rate) {
  const double first = motion.recording.times.front(), last = motion.recording.times.back();
  const auto times = times_from(motion.first, static_cast<std::size_t>(periods) + 1, rate);
  const double speed = (last - first) / times.back();
  std::vector<Progress> progress;
  for (const double t : times) progress.push_back({first + t * speed, speed, 0});
  progress.back().s = last;
  return samples_at(motion, times, progress);
}

/// The result of a search for a number of periods.
struct FoundPeriods {
  Trajectory trajectory;  ///< within limits; empty if none was found
  double slowdown = 1;
  std::string first_excess;  ///< of the fewest periods
};

/// Finds a number of periods with which the samples hold the limits, at most `longest` times the
/// duration.
FoundPeriods find_periods(const PlayedMotion& motion, double duration, double rate,
                          double longest) {
  constexpr double first_step = 1e-4, growth = 1.6;  // of the smallest steps of the search
  constexpr double hopeless = 2;                     // times `longest`, of a needed slowdown
  const double asked = std::max(1.0, std::ceil(duration * rate - 1e-6));
  FoundPeriods found;
  double least = first_step;
  for (double periods = asked; periods <= longest * asked + 1; least *= growth) {
    found.trajectory = in_periods_at(motion, periods, rate);
    if (found.trajectory.size() == 0) return found;
    found.slowdown = periods / (duration * rate);
    const auto excess = largest_excess(motion.held, found.trajectory);
    if (!excess) return found;
    if (found.first_excess.empty()) {
      found.first_excess = described(motion.arm, found.trajectory, *excess);
    }
    if (excess->slowdown > hopeless * longest) break;
    const double step = std::max(least, at_once * (excess->slowdown - 1));
    periods = std::max(periods + 1, std::floor(periods * (1 + step)));
  }
  found.trajectory = {};
  return found;
}

/// The largest of usual rates at which the motion can be played with at most a tenth more duration;
/// 0: none.
double possible_rate(const PlayedMotion& motion, double duration, double rate) {
  constexpr double little = 1.1;
  for (const double tried : {1000., 500., 250., 200., 125., 100., 60., 50., 25., 20., 10.}) {
    if (tried >= rate || tried * duration < 1) continue;
    if (find_periods(motion, duration, tried, little).trajectory.size() > 0) return tried;
  }
  return 0;
}

PlayedSection ended_section(const PlayedMotion& motion) {
  const Ending ending = motion.budget->ending();
  return {.trajectory = {},
          .reason = ended_by(ending) + " before samples within the limits were found" +
                    how_to_continue(ending)};
}

PlayedSection at_rate(const PlayedMotion& motion, double duration, double rate) {
  FoundPeriods found = find_periods(motion, duration, rate, max_slowdown);
  PlayedSection section{std::move(found.trajectory), found.slowdown, ""};
  if (section.trajectory.size() > 0) return section;
  if (ended(motion.budget)) return ended_section(motion);
  const double possible = possible_rate(motion, duration, rate);
  section.reason = "with " + number(rate) + " samples per second " + found.first_excess + "; " +
                   (possible > 0 ? "a rate of " + number(possible) + " keeps it"
                                 : "the recorded samples, without a rate, keep it");
  return section;
}

}  // namespace

double time_at_rate(std::size_t k, double rate) {
  return round_to_nanoseconds(static_cast<double>(k) / rate);
}

void check_samples(double samples, double duration, double rate) {
  if (samples < max_samples) return;
  throw Error("replaying " + number(duration) + " s at " + number(rate) +
              " samples per second makes more than " + number(max_samples) + " samples");
}

PlayedSection at_constant_speed(const PlayedMotion& motion, double speed, double rate) {
  const Trajectory& recording = motion.recording;
  const double duration = (recording.times.back() - recording.times.front()) / speed;
  check_samples(duration * rate + static_cast<double>(recording.size()), duration, rate);
  if (rate > 0 && duration > 0) return at_rate(motion, duration, rate);
  PlayedSection section;
  std::optional<LimitExcess> excess;
  for (int tries = 0; tries < max_tries && section.slowdown <= max_slowdown; ++tries) {
    if (ended(motion.budget)) return ended_section(motion);
    section.trajectory = recorded_samples(motion, speed / section.slowdown);
    excess = largest_excess(motion.held, section.trajectory);
    if (!excess) return section;
    section.slowdown *= excess->slowdown * (1 + rounding_margin);
  }
  section.reason = described(motion.arm, section.trajectory, *excess);
  section.trajectory = {};
  return section;
}

PlayedSection with_speed_changes(const PlayedMotion& motion, const ReplayOptions& options,
                                 double rate) {
  PlayedSection section;
  std::string first_excess;
  for (double scale = 1; scale * max_slowdown >= 1;) {
    if (ended(motion.budget)) return ended_section(motion);
    std::vector<Progress> progress =
        scheduled_progress(motion.arm, motion.recording, {options, rate, motion.first, scale});
    const auto times = times_from(motion.first, progress.size(), rate);
    for (std::size_t k = 1; k + 1 < progress.size(); ++k) {
      progress[k].s += (times[k] - static_cast<double>(k) / rate) * progress[k].speed;
    }
    section.trajectory = samples_at(motion, times, progress);
    if (section.trajectory.size() == 0) return ended_section(motion);
    section.slowdown = 1 / scale;
    const auto excess = largest_excess(motion.held, section.trajectory);
    if (!excess) return section;
    if (first_excess.empty()) first_excess = described(motion.arm, section.trajectory, *excess);
    constexpr double least = 1.002;
    scale /= std::max(least, 1 + at_once * std::min(excess->slowdown - 1, 1.0));
  }
  section.reason = "with " + number(rate) + " samples per second " + first_excess +
                   "; lower speeds, a longer ramp or another rate keep it";
  section.trajectory = {};
  return section;
}

}  // namespace beeline::internal
