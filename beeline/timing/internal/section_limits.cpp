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
    if (!options.keeps_jerk()) limits.back().jerk = known.jerk;
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

/// By which factor the tool exceeds its limits along the path between each sample and the next; 1
/// where it does not.
std::vector<double> tool_excess(const Arm& arm, const SampledSection& samples,
                                const ToolSpeeds& tool_speed) {
  constexpr double rounding = 1e-3;  // of an interval: samples at a change of the limit are near it
  std::vector<double> limits;
  for (std::size_t k = 1; k < samples.progress.size(); ++k) {
    const double from = samples.progress[k - 1].s, to = samples.progress[k].s;
    const double margin = rounding * (to - from);
    limits.push_back(tool_speed.lowest(from + margin, to - margin));
  }
  std::vector<double> factors = tool_speed_bounds(arm, samples.trajectory, limits);
  for (std::size_t k = 0; k < factors.size(); ++k) {
    factors[k] = limits[k] < Limits::none ? factors[k] / limits[k] : 1;
  }
  return factors;
}

}  // namespace

NeededSlowdown needed_slowdown(const Arm& arm, const SampledSection& samples,
                               const SectionOptions& options) {
  NeededSlowdown needed = needed_slowdown(arm, samples.trajectory, options);
  if (options.tool_speeds.limits.size() == 1) return needed;
  for (const double factor : tool_excess(arm, samples, options.tool_speeds)) {
    needed.speed = std::max(needed.speed, factor);
  }
  return needed;
}

NeededSlowdown needed_slowdown(const Arm& arm, const Trajectory& trajectory,
                               const SectionOptions& options) {
  const std::vector<Limits> limits = kept_limits(arm, options);
  const auto usage = [&](int order) {
    return limit_fraction(limits, trajectory, order, options.budget).fraction;
  };
  NeededSlowdown needed{slowdown_factor(usage(1), usage(2), 0) / options.timing.speed_scale,
                        slowdown_factor(0, 0, usage(3)) / options.timing.speed_scale};
  const ToolSpeeds& tool = options.tool_speeds;
  if (tool.limits.size() == 1 && tool.lowest() < Limits::none) {
    const double bound = tool_speed_bound(arm, trajectory, options.budget);
    needed.speed = std::max(needed.speed, bound / tool.lowest());
  }
  if (!options.budget.complete()) needed.speed = Limits::none;
  return needed;
}

bool lower_limits(const Arm& arm, const SampledSection& samples, const SectionOptions& options,
                  TimedSection& section) {
  constexpr double worthwhile = 1.001;  // smaller excesses are left to a slowdown of the whole
  const auto excess = [&, limits = kept_limits(arm, options)](int order) {
    std::vector<double> factors =
        limit_fractions(limits, samples.trajectory, order, options.budget);
    for (double& factor : factors) factor /= std::pow(options.timing.speed_scale, order);
    return factors;
  };
  auto velocity = excess(1);
  const auto acceleration = excess(2), jerk = excess(3);
  if (options.budget.ended(0)) return false;
  if (options.tool_speeds.limits.size() > 1) {
    const std::vector<double> tool = tool_excess(arm, samples, options.tool_speeds);
    for (std::size_t k = 0; k < tool.size(); ++k) velocity[k] = std::max(velocity[k], tool[k]);
  }
  const auto& s = section.path.s;
  std::vector<double> slower(s.size(), 1), gentler(s.size(), 1);
  bool lowered = false;
  for (std::size_t k = 0; k < velocity.size(); ++k) {
    // If d2s/dt2 jumps, accelerations are at their limits nearly everywhere, and only a lower speed
    // reduces them.
    const bool smooth = section.scaling.smooth;
    const double speed = smooth ? velocity[k] : std::max(velocity[k], std::sqrt(acceleration[k]));
    const double force = smooth ? std::max(acceleration[k], jerk[k]) : 1;
    if (std::max(speed, force) < worthwhile) continue;
    lowered = true;
    // The grid points in the interval, and one on each side.
    const auto begin = std::upper_bound(s.begin(), s.end(), samples.progress[k].s);
    const auto end = std::lower_bound(s.begin(), s.end(), samples.progress[k + 1].s);
    const auto last = std::min(static_cast<std::size_t>(end - s.begin()), s.size() - 1);
    for (auto g = static_cast<std::size_t>(begin - s.begin()) - 1; g <= last; ++g) {
      slower[g] = std::max(slower[g], speed);
      gentler[g] = std::max(gentler[g], force);
    }
  }
  PathLimits& limits = section.limits;
  if (limits.speed.empty()) limits.speed.assign(s.size(), Limits::none);
  if (limits.fraction.empty()) limits.fraction.assign(s.size(), 1);
  for (std::size_t g = 0; g < s.size(); ++g) {
    const double speed = speed_at(section.scaling, s[g]);
    if (slower[g] > 1 && speed > 0) limits.speed[g] = std::min(limits.speed[g], speed / slower[g]);
    limits.fraction[g] /= gentler[g];
  }
  return lowered;
}

}  // namespace beeline::internal
