#include <algorithm>

#include <beeline/planning/internal/branch_timing.h>
#include <beeline/planning/internal/track_path.h>
#include <beeline/timing/internal/graded_stop.h>
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

BranchTiming::BranchTiming(const MotionRequest& request, const Branch& branch, std::size_t samples,
                           BudgetMeter& budget)
    : request_(request), budget_(budget), start_(branch.start) {
  const Route& route = request.route;
  const std::size_t segments = branch.segments.size();
  BranchSection section{{branch.start}, {0}};
  std::size_t first = 0;
  for (std::size_t i = 0; i < segments; ++i) {
    add_segment(section, branch.segments[i], i, samples);
    if (i + 1 < segments && !route.stops[i]) continue;
    BranchSection next{{section.samples.back()}, {section.path_parameters.back()}};
    add(std::move(section), first, i);
    first = i + 1;
    if (reason_) {
      set_segment(route.path, i, reason_);
      return;
    }
    section = std::move(next);
    budget_.report(0.5 * static_cast<double>(i + 1) / static_cast<double>(segments));
    if (budget_.ended()) break;
  }
}

ToolSpeeds BranchTiming::tool_speeds(const SectionJointPath& path, std::size_t first,
                                     std::size_t last) const {
  const std::vector<double>& given = request_.route.speeds;
  ToolSpeeds speeds;
  speeds.ends.clear();
  speeds.limits.clear();
  for (std::size_t i = first; i <= last; ++i) {
    const double limit = given.empty() ? request_.timing.tool_speed : given[i];
    if (!speeds.limits.empty() && speeds.limits.back() == limit)
      speeds.ends.pop_back();
    else
      speeds.limits.push_back(limit);
    speeds.ends.push_back(i == last ? path.joint_path().s.back()
                                    : path.parameter_at(static_cast<double>(i + 1)));
  }
  return speeds;
}

void BranchTiming::add(BranchSection samples, std::size_t first, std::size_t last) {
  const double end = samples.path_parameters.back();
  if (samples.samples.size() < 2) {  // the tool is at rest
    (sections_.empty() ? start_parameter_ : sections_.back().end) = end;
    return;
  }
  const auto count = static_cast<double>(samples.samples.size());
  Section section{
      {request_, std::move(samples), budget_}, {.timing = request_.timing, .budget = budget_}, end};
  const JointPath& path = section.path.joint_path();
  SectionOptions& options = section.options;
  options.tool_speeds = tool_speeds(section.path, first, last);
  section.timed = timed_section(request_.arm, path, options);
  if (!section.timed.scaling) {
    reason_ = section.timed.scaling.reason;
    if (reason_) reason_.set(ReasonField::planned, true);
    return;
  }
  options.required = section.path.segment_ends();
  if (options.timing.interpolation == Interpolation::linear) {
    for (double k = 1; k < count; ++k) options.required.push_back(path.s.back() * k / count);
    std::sort(options.required.begin(), options.required.end());
  }
  sections_.push_back(std::move(section));
}

void BranchTiming::grade_stops() {
  for (std::size_t i = 1; i < sections_.size() && budget_.complete(); ++i) {
    Section &before = sections_[i - 1], &after = sections_[i];
    if (!before.timed.scaling || !after.timed.scaling) continue;
    grade_stop({before.timed.scaling, before.options.required},
               {after.timed.scaling, after.options.required}, budget_);
  }
}

TimedBranch BranchTiming::sample(double rate) {
  if (reason_) return {MotionStatus::outside_limits, reason_};
  const bool linear = request_.timing.interpolation == Interpolation::linear;
  if (linear && rate == 0) grade_stops();
  TimedBranch branch{.trajectory = at_rest(request_.arm, start_),
                     .path_parameters = {start_parameter_}};
  keep_columns(branch.trajectory, request_.timing.interpolation);
  double sampled_sections = 0;
  for (Section& section : sections_) {
    if (budget_.ended()) break;
    budget_.report(0.5 + 0.5 * sampled_sections++ / static_cast<double>(sections_.size()));
    section.options.timing.rate = rate;
    section.options.samples_before = branch.trajectory.size();
    section.options.begin = branch.trajectory.times.back();
    const SampledSection sampled = sample_section(request_.arm, section.timed, section.options);
    if (!sampled && !sampled.reason) break;  // the budget has ended
    if (!sampled) {
      return {sampled.too_many() ? MotionStatus::too_many_samples : MotionStatus::outside_limits,
              sampled.reason};
    }
    append(branch.trajectory, sampled.trajectory);
    section.sampled.clear();
    for (std::size_t k = 0; k < sampled.progress.size(); ++k) {
      const ParameterState& now = sampled.progress[k];
      section.sampled.push_back(now.s);
      if (k == 0) continue;
      const bool last = k + 1 == sampled.progress.size();
      const double s = last ? section.end
                            : section.path.path_parameter(sampled.trajectory.positions[k], now.s,
                                                          nanoseconds * now.speed);
      branch.path_parameters.push_back(std::max(s, branch.path_parameters.back()));
    }
  }
  round_times(branch.trajectory);
  return branch;
}

double BranchTiming::shortest_duration() const {
  double duration = 0;
  for (const Section& section : sections_) duration += section.timed.scaling.duration();
  return duration;
}

void BranchTiming::divide(const std::vector<int>& times) {
  std::size_t k = 0;
  for (Section& section : sections_) {
    for (std::size_t i = 1; i < section.sampled.size(); ++i, ++k) {
      const double begin = section.sampled[i - 1], length = section.sampled[i] - begin;
      for (int part = 1; part < times[k]; ++part) {
        section.options.required.push_back(begin + length * part / times[k]);
      }
    }
    std::sort(section.options.required.begin(), section.options.required.end());
  }
}

}  // namespace beeline::internal
