#include <algorithm>

#include <beeline/planning/internal/timed_plan.h>
#include <beeline/timing/internal/timed_path.h>
#include <beeline/trajectory/internal/append.h>
#include <beeline/trajectory/internal/interval_polynomial.h>

namespace beeline::internal {
namespace {

constexpr double nanoseconds = 2e-9;  // by which times of samples have been rounded

/// Adds at most so many samples of segment i of a branch to the section. Of samples at one position
/// only the last is kept: the path is at rest there in the task's rows.
void add_segment(BranchSection& section, const TrackedSegment& segment, std::size_t i,
                 std::size_t samples) {
  constexpr double still = 1e-12;  // radians or metres
  const std::size_t last = segment.samples.size() - 1, stride = 1 + last / samples;
  for (std::size_t k = 1; k <= last; ++k) {
    if (k % stride != 0 && k < last) continue;
    const bool moves = (segment.samples[k] - section.samples.back()).norm() > still;
    if (moves) {
      section.samples.push_back(segment.samples[k]);
      section.path_parameters.push_back(0);
    }
    section.path_parameters.back() = static_cast<double>(i) + segment.fractions[k];
  }
  // A segment at rest has no sample of its own.
  section.path_parameters.back() = static_cast<double>(i + 1);
}

}  // namespace

PlanTiming::PlanTiming(const Arm& arm, const Route& route, const Branch& plan, const Task& task,
                       const Deviation& tolerance, std::size_t samples,
                       const RetimeOptions& options, BudgetMeter& budget)
    : arm_(arm),
      route_(route),
      task_(task),
      options_(options),
      budget_(budget),
      start_(plan.start) {
  check_options(options.tool_speed, options.rate);
  BranchSection section{{plan.start}, {0}};
  std::size_t first = 0;
  for (std::size_t i = 0; i < plan.segments.size(); ++i) {
    add_segment(section, plan.segments[i], i, samples);
    if (i + 1 < plan.segments.size() && !route.stops[i]) continue;
    BranchSection next{{section.samples.back()}, {section.path_parameters.back()}};
    add(std::move(section), tolerance, first, i);
    first = i + 1;
    if (status != MotionStatus::reached) {
      reason.set(ReasonField::segment, i + 1);
      reason.set(ReasonField::segment_name, route.path.names.empty()
                                                ? "segment " + std::to_string(i + 1)
                                                : segment_name(route.path, i));
      return;
    }
    section = std::move(next);
    budget_.report(0.5 * static_cast<double>(i + 1) / static_cast<double>(plan.segments.size()));
    if (budget_.ended()) break;
  }
}

ToolSpeeds PlanTiming::tool_speeds(const SectionPath& path, std::size_t first,
                                   std::size_t last) const {
  const double end = path.joint_path().s.back();
  ToolSpeeds speeds;
  speeds.ends.clear();
  speeds.limits.clear();
  for (std::size_t i = first; i <= last; ++i) {
    const double limit = route_.speeds.empty() ? options_.tool_speed : route_.speeds[i];
    if (!speeds.limits.empty() && speeds.limits.back() == limit)
      speeds.ends.pop_back();
    else
      speeds.limits.push_back(limit);
    speeds.ends.push_back(i == last ? end : path.parameter_at(static_cast<double>(i + 1)));
  }
  return speeds;
}

void PlanTiming::add(BranchSection samples, const Deviation& tolerance, std::size_t first,
                     std::size_t last) {
  const double end = samples.path_parameters.back();
  if (samples.samples.size() < 2) {  // the tool is at rest
    (sections_.empty() ? start_parameter_ : sections_.back().end) = end;
    return;
  }
  const auto count = static_cast<double>(samples.samples.size());
  Section section{
      {arm_, route_.path, task_, std::move(samples), tolerance, budget_}, {}, {}, end, {}, {}};
  const JointPath& path = section.path.joint_path();
  section.tool_speeds = tool_speeds(section.path, first, last);
  const ToolSpeeds& speeds = section.tool_speeds;
  section.timed = timed_path(arm_, path, options_.profile.value_or(default_profile),
                             options_.speed_scale, speeds, budget_);
  if (!section.timed.scaling) {
    status = MotionStatus::outside_limits;
    reason = section.timed.scaling.reason;
    reason.set(ReasonField::planned, true);
    return;
  }
  section.required = section.path.segment_ends();
  if (options_.interpolation == Interpolation::linear) {
    for (double k = 1; k < count; ++k) {
      section.required.push_back(path.s.back() * k / count);
    }
    std::sort(section.required.begin(), section.required.end());
  }
  sections_.push_back(std::move(section));
}

TimedPlan PlanTiming::sample() {
  TimedPlan plan{at_rest(arm_, start_), {start_parameter_}};
  keep_columns(plan.trajectory, options_.interpolation);
  double sampled_sections = 0;
  for (Section& section : sections_) {
    if (budget_.ended()) break;
    budget_.report(0.5 + 0.5 * sampled_sections++ / static_cast<double>(sections_.size()));
    const SectionOptions options{
        .interpolation = options_.interpolation,
        .keep_jerk = keeps_jerk(options_.profile.value_or(default_profile)),
        .speed_scale = options_.speed_scale,
        .tool_speed = section.tool_speeds,
        .rate = options_.rate,
        .max_samples =
            static_cast<double>(options_.max_samples) - static_cast<double>(plan.trajectory.size()),
        .required = section.required,
        .budget = &budget_};
    const SampledSection sampled = sample_section(arm_, section.timed, options);
    if (!sampled && !sampled.reason) break;  // the budget has ended
    if (!sampled) {
      status = sampled.too_many() ? MotionStatus::too_many_samples : MotionStatus::outside_limits;
      reason = sampled.reason;
      return {};
    }
    append(plan.trajectory, sampled.trajectory);
    section.sampled.clear();
    for (std::size_t k = 0; k < sampled.progress.size(); ++k) {
      const ParameterState& now = sampled.progress[k];
      section.sampled.push_back(now.s);
      if (k == 0) continue;
      const bool last = k + 1 == sampled.progress.size();
      const double s = last ? section.end
                            : section.path.path_parameter(sampled.trajectory.positions[k], now.s,
                                                          nanoseconds * now.speed);
      plan.path_parameters.push_back(std::max(s, plan.path_parameters.back()));
    }
  }
  round_times(plan.trajectory);
  return plan;
}

void PlanTiming::divide(const std::vector<int>& times) {
  std::size_t k = 0;
  for (Section& section : sections_) {
    for (std::size_t i = 1; i < section.sampled.size(); ++i, ++k) {
      const double begin = section.sampled[i - 1], length = section.sampled[i] - begin;
      for (int part = 1; part < times[k]; ++part) {
        section.required.push_back(begin + length * part / times[k]);
      }
    }
    std::sort(section.required.begin(), section.required.end());
  }
}

}  // namespace beeline::internal
