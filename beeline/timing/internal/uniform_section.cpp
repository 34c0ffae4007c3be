#include <algorithm>
#include <cmath>

#include <beeline/timing/internal/joint_motion.h>
#include <beeline/timing/internal/section_limits.h>
#include <beeline/timing/internal/uniform_section.h>
#include <beeline/trajectory/internal/append.h>

namespace beeline::internal {
namespace {

constexpr int max_tries = 60;  // of numbers of periods

/// No samples, because the motion would have too many up to the end of this section.
SampledSection too_many(double duration, const SectionOptions& options) {
  SampledSection none;
  none.reason = {ReasonCode::too_many_samples_at_rate,
                 {{ReasonField::rate, options.timing.rate},
                  {ReasonField::max_samples, static_cast<std::size_t>(options.timing.max_samples)},
                  {ReasonField::duration, options.begin + duration}}};
  return none;
}

/// Periods of a section: those in which the time scaling takes place, and by how many the moving
/// average lengthens it.
struct Periods {
  double scaling = 1;
  double average = 1;
  double all() const { return scaling + average; }
};

/// The given time scaling, slowed down to so many periods of `period` seconds, its speed linear
/// between them.
TimeScaling in_whole_periods(const TimeScaling& given, double periods, double period) {
  const double slower = periods * period / given.duration();
  const AveragedScaling exact(given, 0);
  TimeScaling uniform =
      uniform_scaling(periods, period, given.s.back() - given.s.front(),
                      [&](double t) { return exact.at(t / slower).speed / slower; });
  for (double& s : uniform.s) s += given.s.front();
  uniform.s.back() = given.s.back();
  return uniform;
}

/// Returns no samples if the budget ends the computation.
SampledSection in_periods(const Arm& arm, const TimedSection& section,
                          const SectionOptions& options, const Periods& periods) {
  const double period = 1 / options.timing.rate;
  const TimeScaling uniform = in_whole_periods(section.scaling, periods.scaling, period);
  const AveragedScaling scaling(uniform, periods.average * period);
  const JointMotion motion(section.path, scaling);
  std::vector<Sample> samples;
  constexpr std::size_t batch = 64;  // samples
  for (double k = 0; k <= periods.all(); ++k) {
    if (samples.size() % batch == 0 && options.budget.ended(batch)) return {};
    const double t = round_to_nanoseconds(k / options.timing.rate);
    samples.push_back({t, motion.at(k == periods.all() ? scaling.duration() : t)});
  }
  return with_columns(arm, samples, options.timing.interpolation);
}

/// The ends of a section of one period.
SampledSection in_one_period(const Arm& arm, const TimedSection& section,
                             const SectionOptions& options) {
  const AveragedScaling scaling(section.scaling, section.scaling.duration());
  const JointMotion motion(section.path, scaling);
  return with_columns(
      arm,
      {{0, motion.at(0.0)},
       {round_to_nanoseconds(1 / options.timing.rate), motion.at(scaling.duration())}},
      options.timing.interpolation);
}

SampledSection sampled(const Arm& arm, const TimedSection& section, const SectionOptions& options,
                       const Periods& periods) {
  return periods.scaling < 2 ? in_one_period(arm, section, options)
                             : in_periods(arm, section, options, periods);
}

Periods fewest_periods(const TimedSection& section, const SectionOptions& options) {
  const bool linear = options.timing.interpolation == Interpolation::linear;
  return {std::max(1.0, std::ceil(section.scaling.duration() * options.timing.rate - 1e-6)),
          linear ? 0.0 : 1.0};
}

}  // namespace

TimeScaling uniform_scaling(double periods, double period, double length,
                            const std::function<double(double)>& speed) {
  TimeScaling uniform;
  uniform.s = uniform.t = uniform.speed = {0};
  for (double k = 1; k <= periods; ++k) {
    const double before = uniform.speed.back();
    uniform.t.push_back(k * period);
    uniform.speed.push_back(k == periods ? 0 : speed(k * period));
    uniform.s.push_back(uniform.s.back() + period * (before + uniform.speed.back()) / 2);
  }
  const double scale = length / uniform.s.back();
  for (double& s : uniform.s) s *= scale;
  for (double& v : uniform.speed) v *= scale;
  uniform.s.back() = length;
  uniform.acceleration.assign(uniform.s.size(), 0);
  return uniform;
}

SampledSection shortest_uniform_section(const Arm& arm, const TimedSection& section,
                                        const SectionOptions& options) {
  return sampled(arm, section, options, fewest_periods(section, options));
}

SampledSection uniform_section(const Arm& arm, const TimedSection& section,
                               const SectionOptions& options) {
  Periods periods = fewest_periods(section, options);
  bool widen = periods.average > 0;  // while it lowers the jerk
  double jerk_before = 0;            // of the average before it was widened
  double average_before = 0;
  for (int tries = 0; tries < max_tries; ++tries) {
    if (options.budget.ended()) return {};
    const double count = periods.all();
    if (!(count <= options.samples_left())) return too_many(count / options.timing.rate, options);
    SampledSection tried = sampled(arm, section, options, periods);
    if (!tried) return {};
    const NeededSlowdown needed = needed_slowdown(arm, tried, options);
    if (options.budget.ended()) return {};
    if (!(needed.both() > 1)) return tried;
    // Most of the slowdown at once: the excess is at few samples, and others are the worst later.
    constexpr double at_once = 0.7;
    const auto slower = [&](double factor) {
      const double excess = std::min(factor - 1, 1e3);
      return std::max(periods.scaling + 1, std::floor(periods.scaling * (1 + at_once * excess)));
    };
    // At jumps of d2s/dt2 a wider average lowers its jerk in proportion, often for less time than a
    // slowdown. One that saved less time than it takes is taken back.
    if (average_before > 0) {
      if (!(periods.scaling * (jerk_before - needed.jerk) > periods.average - average_before)) {
        widen = false;
        periods.average = average_before;
      }
      average_before = 0;
    }
    const double cubed = needed.jerk * needed.jerk * needed.jerk;
    const double wider = std::max(periods.average + 1, std::ceil(periods.average * cubed));
    if (widen && needed.jerk > needed.speed &&
        wider - periods.average < slower(needed.jerk) - periods.scaling) {
      average_before = periods.average;
      jerk_before = needed.jerk;
      periods.average = wider;
    } else {
      periods.scaling = slower(needed.both());
    }
  }
  SampledSection none;
  none.reason = {ReasonCode::no_motion_at_rate, {{ReasonField::rate, options.timing.rate}}};
  return none;
}

}  // namespace beeline::internal
