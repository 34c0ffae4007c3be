#pragma once

#include <span>
#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/path/joint_path.h>
#include <beeline/timing/retime.h>
#include <beeline/timing/time_scaling.h>

namespace beeline::internal {

/// Limits of the tool's speed along a joint path, m/s: limits[i] up to the path parameter ends[i]
/// and from the end before it.
struct ToolSpeeds {
  std::vector<double> ends;  ///< increasing; the last is the path's end or beyond
  std::vector<double> limits;

  /// One limit for the whole path.
  ToolSpeeds(double limit = Limits::none)
      : ends{Limits::none}, limits{limit} {}  // NOLINT: implicit

  /// The lowest between two path parameters, from <= to.
  double lowest(double from, double to) const;
  double lowest() const { return lowest(-Limits::none, Limits::none); }
};

/// The options of one section: the timing options and the requirements of the section.
struct SectionOptions {
  RetimeOptions timing = {};
  ToolSpeeds tool_speeds = {};        ///< along the section, in place of timing.tool_speed
  std::size_t samples_before = 1;     ///< samples of the motion up to the section's first
  double begin = 0;                   ///< time of the section's first sample in the motion, s
  std::vector<double> required = {};  ///< path parameters that get a sample, without a rate
  BudgetMeter& budget = unlimited();  ///< in place of timing.budget

  /// Max samples of the section after its first, with a rate.
  double samples_left() const {
    return static_cast<double>(timing.max_samples) - static_cast<double>(samples_before);
  }
  Profile profile() const { return timing.profile.value_or(default_profile); }
  bool keeps_jerk() const { return beeline::keeps_jerk(profile()); }
};

/// The joint path of a section, from one stop to the next, with its time scaling. The points of the
/// scaling include the grid points of the path.
struct TimedSection {
  JointPath path;
  Profile profile = default_profile;
  PathLimits limits;
  TimeScaling scaling;
};

/// Slows the scaling down by the factor k.
void slow_down(TimeScaling& scaling, double k);

/// Returns a joint path between two stops, with more grid points, and its time scaling within the
/// arm's limits times the speed scale and within the limits of the tool's speed. If there is no
/// scaling, it has a reason and no points.
TimedSection timed_section(const Arm& arm, const JointPath& path, const SectionOptions& options);

/// Throws Error for a tool speed, rate, duration or number of samples out of range, and for a
/// duration with a rate.
void check_options(const RetimeOptions& options);

}  // namespace beeline::internal
