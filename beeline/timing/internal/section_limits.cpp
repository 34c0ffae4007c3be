#include <algorithm>
#include <cmath>

#include <beeline/timing/internal/section_limits.h>
#include <beeline/trajectory/internal/limit_fraction.h>
#include <beeline/trajectory/internal/tool_speed.h>
#include <beeline/trajectory/limit_usage.h>

namespace beeline::internal {
namespace {

std::vector<Limits> kept_limits(const Arm& arm, const SectionOptions& options) {
  std::vector<Limits> limits;
  for (const Limits& known : arm.limits()) {
    limits.push_back(motion_limits(known));
    if (!options.keep_jerk) limits.back().jerk = known.jerk;
  }
  return limits;
}

/// The speed ds/dt of a time scaling at s.
double speed_at(const TimeScaling& scaling, double s) {
  const auto next = std::lower_bound(scaling.s.begin() + 1, scaling.s.end() - 1, s);
  const auto k = static_cast<std::size_t>(next - scaling.s.begin());
  const double u = (s - scaling.s[k - 1]) / (scaling.s[k] - scaling.s[k - 1]);
  return (1 - u) * scaling.speed[k - 1] + u * scaling.speed[k];
}

}  // namespace

NeededSlowdown needed_slowdown(const Arm& arm, const Trajectory& trajectory,
                               const SectionOptions& options) {
  const std::vector<Limits> limits = kept_limits(arm, options);
  const auto usage = [&](int order) { return limit_fraction(limits, trajectory, order).fraction; };
  NeededSlowdown needed{slowdown(usage(1), usage(2), 0) / options.speed_scale,
                        slowdown(0, 0, usage(3)) / options.speed_scale};
  if (options.tool_speed < Limits::none) {
    needed.speed = std::max(needed.speed, tool_speed_bound(arm, trajectory) / options.tool_speed);
  }
  return needed;
}

bool lower_speed_limits(const Arm& arm, const SampledSection& samples,
                        const SectionOptions& options, TimedPath& section) {
  constexpr double worthwhile = 1.001;  // smaller excesses are left to a slowdown of the whole
  const std::vector<Limits> limits = kept_limits(arm, options);
  std::vector<double> slower(samples.trajectory.size() - 1, 1.0);
  for (int order = 1; order <= (section.scaling.smooth ? 3 : 2); ++order) {
    const auto fractions = limit_fractions(limits, samples.trajectory, order);
    for (std::size_t k = 0; k < slower.size(); ++k) {
      const double factor = std::pow(fractions[k], 1.0 / order) / options.speed_scale;
      slower[k] = std::max(slower[k], factor);
    }
  }
  bool lowered = false;
  auto& speeds = section.limits.speed;
  if (speeds.empty()) speeds.assign(section.path.size(), Limits::none);
  for (std::size_t k = 0; k < slower.size(); ++k) {
    if (slower[k] < worthwhile) continue;
    // The grid points in the interval, and one on each side.
    const auto& s = section.path.s;
    const auto begin = std::upper_bound(s.begin(), s.end(), samples.progress[k].s);
    const auto end = std::lower_bound(s.begin(), s.end(), samples.progress[k + 1].s);
    const auto first = static_cast<std::size_t>(begin - s.begin()) - 1;
    const auto last = std::min(static_cast<std::size_t>(end - s.begin()), s.size() - 1);
    for (std::size_t g = first; g <= last; ++g) {
      const double speed = speed_at(section.scaling, s[g]);
      if (!(speed > 0)) continue;  // at rest
      speeds[g] = std::min(speeds[g], speed / slower[k]);
      lowered = true;
    }
  }
  return lowered;
}

}  // namespace beeline::internal
