#pragma once

#include <span>
#include <vector>

#include <beeline/internal/budget_meter.h>
#include <beeline/timing/internal/averaged_scaling.h>
#include <beeline/timing/internal/timed_section.h>

namespace beeline::internal {

/// Required samples nearer to the one before them than this are left out, s.
constexpr double shortest_interval = 1e-5;

/// Samples of a section: times from 0, and the path parameter of each with its time derivatives.
struct SampledSection {
  Trajectory trajectory = {};
  std::vector<ParameterState> progress = {};  ///< along the joint path
  Reason reason = {};                         ///< reason why there are none at the rate

  explicit operator bool() const { return trajectory.size() > 0; }
  /// Whether there are none because there would be more than SectionOptions::samples_left().
  bool too_many() const { return reason.code == ReasonCode::too_many_samples_at_rate; }
  double duration() const { return trajectory.times.back(); }
};

/// Returns the samples of a section, slowed down until the motion that they mean is within the
/// arm's limits times the speed scale, and the tool's speed within its own.
///
/// The acceleration of a quintic or cubic motion cannot jump. AveragedScaling replaces each jump of
/// the time scaling's acceleration, at both ends too, by a ramp. Without a rate there are as many
/// samples as the interpolation needs to agree with the motion along the path, at all kinks of the
/// acceleration first; times are whole nanoseconds. With a rate the samples are k / rate, the last
/// one included: the section lasts a whole number of periods. If the budget ends the search, the
/// motion may take longer than necessary, or there are no samples. Returns no samples, with the
/// reason, if there would be too many or none are found within limits.
SampledSection sample_section(const Arm& arm, const TimedSection& section,
                              const SectionOptions& options);

}  // namespace beeline::internal
