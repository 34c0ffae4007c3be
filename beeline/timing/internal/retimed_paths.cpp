#include <algorithm>
#include <cmath>
#include <deque>

#include <beeline/model/internal/joint_reason.h>
#include <beeline/timing/internal/graded_stop.h>
#include <beeline/timing/internal/possible_rate.h>
#include <beeline/timing/internal/retimed_paths.h>
#include <beeline/timing/internal/sampled_section.h>
#include <beeline/trajectory/internal/append.h>
#include <beeline/trajectory/internal/given_duration.h>
#include <beeline/trajectory/internal/interval_polynomial.h>
#include <beeline/trajectory/internal/limit_fraction.h>
#include <beeline/trajectory/internal/tool_speed.h>

namespace beeline::internal {
namespace {

constexpr int linear_samples = 200;  // of a section, where joints move linearly between them

/// The path parameters that get a sample: the grid points, and for linear joints more.
std::vector<double> required_samples(const JointPath& path, bool linear) {
  std::vector<double> s = path.s;
  const double length = s.back();
  for (int i = 1; linear && i < linear_samples; ++i) s.push_back(length * i / linear_samples);
  std::sort(s.begin(), s.end());
  return s;
}

/// Joint paths from stop to stop. Each gets its time scaling when it is needed.
class Sections {
 public:
  Sections(const Arm& arm, const std::vector<JointPath>& paths, const RetimeOptions& options,
           BudgetMeter& budget, const std::vector<ToolSpeeds>& tool_speeds)
      : arm_(arm),
        options_{.timing = options, .tool_speeds = options.tool_speed, .budget = budget},
        paths_(paths),
        tool_speeds_(tool_speeds) {}

  std::size_t count() const { return paths_.size(); }
  std::size_t steps(std::size_t i) const { return paths_[i].size() - 1; }
  std::size_t steps() const {
    std::size_t all = 0;
    for (std::size_t i = 0; i < count(); ++i) all += steps(i);
    return all;
  }

  /// Returns section i with its time scaling, or with the reason why there is none.
  const TimedSection& timed(std::size_t i) {
    while (timed_.size() <= i) {
      timed_.push_back(timed_section(arm_, paths_[timed_.size()], options_of(timed_.size())));
    }
    return timed_[i];
  }

  /// Returns the samples of section i at a rate. Its first sample is the last of the `samples` of
  /// the motion so far, at `time`.
  SampledSection sampled(std::size_t i, double rate, std::size_t samples, double time) {
    SectionOptions section = options_of(i);
    section.timing.rate = rate;
    section.samples_before = samples;
    section.begin = time;
    section.required = required(i);
    if (is_linear() && rate == 0) grade_stops(i, section.required);
    return sample_section(arm_, timed(i), section);
  }

  /// Whether all sections have samples at the rate.
  bool possible(double rate) {
    std::size_t samples = 1;
    double time = 0;
    for (std::size_t i = 0; i < count(); ++i) {
      if (!timed(i).scaling) return false;
      const SampledSection section = sampled(i, rate, samples, time);
      if (!section) return false;
      samples += section.trajectory.size() - 1;
      time += section.duration();
    }
    return true;
  }

  /// Returns the duration of all time scalings, s; 0 if a section has none.
  double shortest_duration() {
    double duration = 0;
    for (std::size_t i = 0; i < count(); ++i) {
      if (!timed(i).scaling) return 0;
      duration += timed(i).scaling.duration();
    }
    return duration;
  }

 private:
  SectionOptions options_of(std::size_t i) const {
    SectionOptions section = options_;
    if (!tool_speeds_.empty()) section.tool_speeds = tool_speeds_[i];
    return section;
  }

  bool is_linear() const { return options_.timing.interpolation == Interpolation::linear; }
  std::vector<double> required(std::size_t i) const {
    return required_samples(paths_[i], is_linear());
  }

  /// Adds the samples of section i next to its stops that linear joints need.
  void grade_stops(std::size_t i, std::vector<double>& samples) {
    const auto samples_of = [this](std::size_t k, std::vector<double>& list) {
      return LinearSamples{timed(k).scaling, list};
    };
    for (const std::size_t other : {i - 1, i + 1}) {  // i - 1 of the first is no section
      if (other >= count() || !timed(other).scaling || !timed(i).scaling) continue;
      std::vector<double> others = required(other);
      const auto here = samples_of(i, samples), there = samples_of(other, others);
      grade_stop(other < i ? there : here, other < i ? here : there, options_.budget);
    }
  }

  const Arm& arm_;
  SectionOptions options_;
  const std::vector<JointPath>& paths_;
  const std::vector<ToolSpeeds>& tool_speeds_;
  std::deque<TimedSection> timed_;
};

/// Returns the reason if the trajectory leaves the position limits where it uses most of them:
/// between two grid points of its path, which are tested before.
Reason left_limits(const Arm& arm, const Trajectory& trajectory, const LimitFraction& used) {
  if (used.fraction <= 1) return {};
  const std::vector<double>& times = trajectory.times;
  const auto after = std::upper_bound(times.begin(), times.end() - 1, used.time);
  const auto k = static_cast<std::size_t>(after - times.begin()) - 1;
  const std::vector<std::string>& names = trajectory.joint_names;
  const auto joint = std::find(names.begin(), names.end(), used.joint) - names.begin();
  const Extremes between = extremes(interval_polynomial(trajectory, k, static_cast<int>(joint)));
  Configuration q = trajectory.positions[k];
  for (const double extreme : {between.smallest, between.largest}) {
    q[joint] = extreme;
    const std::vector<Reason> violations = limit_violations(arm, q);
    if (violations.empty()) continue;
    return computed_violation(violations, ReasonCode::spline_outside_limits);
  }
  return {};
}

/// Sets the duration, and the use of the limits, of a trajectory whose sections are timed. It gets
/// a reason if the duration is too short, or if it leaves the limits.
Retimed finished(const Arm& arm, const RetimeOptions& options, std::size_t sections,
                 BudgetMeter& budget, Retimed timed) {
  round_times(timed.trajectory);
  if (options.duration && budget.complete()) {
    timed.reason = set_duration(timed.trajectory, *options.duration);
    if (!timed) return timed;
  }
  timed.limits = limit_usage(arm, timed.trajectory, budget.part());
  if (budget.complete()) {
    timed.reason = left_limits(arm, timed.trajectory, timed.limits.position);
    if (!timed) return timed;
  }
  timed.tool_speed = tool_speed_bound(arm, timed.trajectory, budget);
  end_with(budget, sections, timed);
  return timed;
}

/// The sections of a motion along the paths, joined; fewer if the budget has ended or there is a
/// reason.
Retimed joined_sections(const Arm& arm, const std::vector<JointPath>& paths,
                        const RetimeOptions& options, BudgetMeter& budget,
                        const std::vector<ToolSpeeds>& tool_speeds) {
  Retimed timed;
  timed.profile = options.profile.value_or(default_profile);
  timed.trajectory.joint_names = arm.joint_names();
  Sections sections(arm, paths, options, budget, tool_speeds);
  const double count = static_cast<double>(sections.steps());
  double steps = 0;  // of the sections so far
  for (std::size_t i = 0; i < sections.count(); ++i) {
    const double here = static_cast<double>(sections.steps(i));
    if (budget.ended(static_cast<std::int64_t>(sections.steps(i) + 1))) break;
    const TimedSection& section = sections.timed(i);
    if (!budget.complete() && !section.scaling) break;
    timed.reason = section.scaling.reason;
    if (!timed) return timed;
    // The time scaling of a section is about half of its work.
    budget.report((steps + 0.5 * here) / count);
    const bool begun = timed.trajectory.size() > 0;
    const SampledSection sampled =
        sections.sampled(i, options.rate, begun ? timed.trajectory.size() : 1,
                         begun ? timed.trajectory.times.back() : 0);
    if (!sampled && !sampled.reason) break;  // the budget has ended
    timed.reason = sampled.reason;
    if (!timed) {
      set_possible_rate(
          options, sections.shortest_duration(),
          [&](double rate) { return sections.possible(rate); }, timed.reason);
      return timed;
    }
    internal::append(timed.trajectory, sampled.trajectory);
    ++timed.sections;
    steps += here;
    budget.report(steps / count);
  }
  return timed;
}

/// Returns the factor, 1 or more, by which the speed must fall so that the known limits of jerk are
/// kept where sections meet. Each section keeps them alone; at a stop between two, cubics and
/// linear motions have the jumps of both.
double slowdown_at_stops(const Arm& arm, const RetimeOptions& options, const Retimed& timed,
                         BudgetMeter& budget) {
  constexpr double slack = 1e-5, margin = 1e-3;
  const bool is_quintic = options.interpolation == Interpolation::quintic;
  if (!timed || timed.sections < 2 || is_quintic) return 1;
  const double used = limit_fraction(arm.limits(), timed.trajectory, 3, budget).fraction;
  const double factor = std::cbrt(used) / options.speed_scale;
  return factor > 1 + slack ? (1 + margin) * factor : 1;
}

}  // namespace

Retimed without_motion(Retimed timed) {
  timed.trajectory = {};
  timed.recovery.reset();
  return timed;
}

void end_with(const BudgetMeter& budget, std::size_t sections, Retimed& timed) {
  timed.ending = budget.ending();
  if (budget.complete()) return;
  timed.reason = ended_reason(ReasonCode::ended_in_retiming, timed.ending);
  timed.reason.set(ReasonField::count, timed.sections).set(ReasonField::of, sections);
}

std::vector<std::size_t> intervals_outside_limits(const Arm& arm, const Trajectory& trajectory) {
  std::vector<std::size_t> outside;
  for (std::size_t k = 0; k + 1 < trajectory.size(); ++k) {
    for (int i = 0; i < arm.dof(); ++i) {
      const Limits& limits = arm.limits(i);
      const auto inside = [&](const Extremes& q) {
        return within_position_limits(limits, q.smallest) &&
               within_position_limits(limits, q.largest);
      };
      const Polynomial between = interval_polynomial(trajectory, k, i);
      if (inside(enclosure(between)) || inside(extremes(between))) continue;
      outside.push_back(k);
      break;
    }
  }
  return outside;
}

Retimed retimed_paths(const Arm& arm, const std::vector<JointPath>& paths,
                      const RetimeOptions& options, BudgetMeter& budget,
                      const std::vector<ToolSpeeds>& tool_speeds) {
  Retimed timed = timed_paths(arm, paths, options, budget, tool_speeds);
  return timed || timed.ending != Ending::complete ? timed : without_motion(std::move(timed));
}

Retimed timed_paths(const Arm& arm, const std::vector<JointPath>& paths,
                    const RetimeOptions& options, BudgetMeter& budget,
                    const std::vector<ToolSpeeds>& tool_speeds) {
  Retimed timed = joined_sections(arm, paths, options, budget, tool_speeds);
  constexpr int max_attempts = 5;
  constexpr double least = 0.2;  // of the speed; a stop that needs less keeps what it needs
  RetimeOptions slower = options;
  for (int i = 0; i < max_attempts && budget.complete(); ++i) {
    const double factor = slowdown_at_stops(arm, options, timed, budget);
    slower.speed_scale /= factor;
    if (factor == 1 || slower.speed_scale < least * options.speed_scale) break;
    Retimed tried = joined_sections(arm, paths, slower, budget, tool_speeds);
    if (budget.complete()) timed = std::move(tried);
  }
  if (!timed) return timed;
  return finished(arm, options, paths.size(), budget, std::move(timed));
}

}  // namespace beeline::internal
