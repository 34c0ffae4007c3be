#include <algorithm>
#include <cmath>
#include <deque>
#include <numeric>

#include <beeline/error.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/timing/internal/blended_path.h>
#include <beeline/timing/internal/possible_rate.h>
#include <beeline/timing/internal/recovery_section.h>
#include <beeline/timing/internal/retimed_paths.h>
#include <beeline/timing/internal/sampled_section.h>
#include <beeline/timing/retime.h>
#include <beeline/trajectory/internal/append.h>
#include <beeline/trajectory/internal/given_duration.h>
#include <beeline/trajectory/internal/interval_polynomial.h>
#include <beeline/trajectory/internal/recovery.h>
#include <beeline/trajectory/internal/tool_speed.h>

namespace beeline {
namespace {

constexpr double repeated = 1e-12;   // radians or metres; nearer positions count as equal
constexpr double rest_speed = 1e-9;  // relative to the largest velocity; slower is rest
constexpr int linear_samples = 200;  // of a section, where joints move linearly between them

/// Returns the positions of each section. A stop ends one section and begins the next.
std::vector<std::vector<Configuration>> positions_between_stops(const Trajectory& trajectory) {
  double largest = 0;
  for (const Configuration& v : trajectory.velocities) {
    largest = std::max(largest, v.lpNorm<Eigen::Infinity>());
  }
  std::vector<std::vector<Configuration>> all{{trajectory.positions.front()}};
  bool stop = false;  // at the last position
  for (std::size_t k = 1; k < trajectory.size(); ++k) {
    const Configuration& q = trajectory.positions[k];
    if ((q - all.back().back()).norm() <= repeated) {
      stop = true;
      continue;
    }
    if (stop && all.back().size() > 1) all.push_back({all.back().back()});
    all.back().push_back(q);
    stop = !trajectory.velocities.empty() &&
           trajectory.velocities[k].lpNorm<Eigen::Infinity>() <= rest_speed * largest;
  }
  return all;
}

std::vector<JointPath> splines(const std::vector<std::vector<Configuration>>& sections) {
  std::vector<JointPath> paths;
  for (const auto& q : sections) paths.push_back(joint_spline(q, chord_length(q)));
  return paths;
}

/// The path parameters that get a sample: the grid points, and for linear joints more.
std::vector<double> required_samples(const JointPath& path, bool linear) {
  std::vector<double> s = path.s;
  const double length = s.back();
  for (int i = 1; linear && i < linear_samples; ++i) s.push_back(length * i / linear_samples);
  std::sort(s.begin(), s.end());
  return s;
}

/// Why the trajectory is not retimed: it has too many samples.
Reason too_long(const Trajectory& trajectory, const RetimeOptions& options) {
  const int most = std::max(options.max_samples, default_max_samples);
  if (trajectory.size() <= static_cast<std::size_t>(most)) return {};
  return {ReasonCode::too_many_samples_given,
          {{ReasonField::count, trajectory.size()},
           {ReasonField::max_samples, static_cast<std::size_t>(most)}}};
}

/// The trajectory in the arm's order, unwrapped unless the options forbid it.
Trajectory path_of(const Arm& arm, const Trajectory& recorded, const RetimeOptions& options,
                   std::vector<UnwrappedJoint>& joints) {
  if (options.no_unwrap) return matched_to(arm, recorded);
  Unwrapped result = unwrapped(arm, recorded);
  joints = std::move(result.joints);
  return std::move(result.trajectory);
}

/// Joint paths from stop to stop. Each gets its time scaling when it is needed.
class Sections {
 public:
  Sections(const Arm& arm, const std::vector<JointPath>& paths, const RetimeOptions& options,
           internal::BudgetMeter& budget)
      : arm_(arm),
        options_{.timing = options, .tool_speeds = options.tool_speed, .budget = budget},
        paths_(paths) {}

  std::size_t count() const { return paths_.size(); }
  std::size_t steps(std::size_t i) const { return paths_[i].size() - 1; }
  std::size_t steps() const {
    std::size_t all = 0;
    for (std::size_t i = 0; i < count(); ++i) all += steps(i);
    return all;
  }

  /// Returns section i with its time scaling, or with the reason why there is none.
  const internal::TimedSection& timed(std::size_t i) {
    while (timed_.size() <= i) {
      timed_.push_back(internal::timed_section(arm_, paths_[timed_.size()], options_));
    }
    return timed_[i];
  }

  /// Returns the samples of section i at a rate. Its first sample is the last of the `samples` of
  /// the motion so far, at `time`.
  internal::SampledSection sampled(std::size_t i, double rate, std::size_t samples, double time) {
    internal::SectionOptions section = options_;
    section.timing.rate = rate;
    section.samples_before = samples;
    section.begin = time;
    section.required =
        required_samples(paths_[i], options_.timing.interpolation == Interpolation::linear);
    return internal::sample_section(arm_, timed(i), section);
  }

  /// Whether all sections have samples at the rate.
  bool possible(double rate) {
    std::size_t samples = 1;
    double time = 0;
    for (std::size_t i = 0; i < count(); ++i) {
      if (!timed(i).scaling) return false;
      const internal::SampledSection section = sampled(i, rate, samples, time);
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
  const Arm& arm_;
  internal::SectionOptions options_;
  const std::vector<JointPath>& paths_;
  std::deque<internal::TimedSection> timed_;
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
  const internal::Extremes between =
      internal::extremes(internal::interval_polynomial(trajectory, k, static_cast<int>(joint)));
  Configuration q = trajectory.positions[k];
  for (const double extreme : {between.smallest, between.largest}) {
    q[joint] = extreme;
    std::vector<Reason> violations = limit_violations(arm, q);
    if (violations.empty()) continue;
    violations.front().code = ReasonCode::spline_outside_limits;
    return violations.front();
  }
  return {};
}

/// Sets how the computation of a motion of this many sections ended.
void end_with(const internal::BudgetMeter& budget, std::size_t sections, Retimed& timed) {
  timed.ending = budget.ending();
  if (budget.complete()) return;
  timed.reason = internal::ended_reason(ReasonCode::ended_in_retiming, timed.ending);
  timed.reason.set(ReasonField::count, timed.sections).set(ReasonField::of, sections);
}

/// Sets the duration, and the use of the limits, of a trajectory whose sections are timed.
void finish(const Arm& arm, const RetimeOptions& options, std::size_t sections,
            internal::BudgetMeter& budget, Retimed& timed) {
  internal::round_times(timed.trajectory);
  if (options.duration && budget.complete()) {
    timed.reason = internal::set_duration(timed.trajectory, *options.duration);
    if (!timed) {
      timed.trajectory = {};
      return;
    }
  }
  timed.limits = limit_usage(arm, timed.trajectory, budget.part());
  if (budget.complete()) {
    timed.reason = left_limits(arm, timed.trajectory, timed.limits.position);
    if (!timed) {
      timed.trajectory = {};
      return;
    }
  }
  timed.tool_speed = internal::tool_speed_bound(arm, timed.trajectory, budget);
  end_with(budget, sections, timed);
}

/// Whether a trajectory has two different positions.
bool moves(const Trajectory& trajectory) {
  const auto& q = trajectory.positions;
  return std::any_of(q.begin(), q.end(), [&](const Configuration& other) {
    return (other - q.front()).norm() > repeated;
  });
}

}  // namespace

void check_moves(const Trajectory& trajectory) {
  const auto& q = trajectory.positions;
  if (moves(trajectory)) return;
  const std::string found = q.empty()       ? "no samples"
                            : q.size() == 1 ? "one sample"
                                            : std::to_string(q.size()) + " samples at one position";
  throw Error("a trajectory needs two different positions to be retimed; this one has " + found);
}

Retimed internal::retimed_paths(const Arm& arm, const std::vector<JointPath>& paths,
                                const RetimeOptions& options, BudgetMeter& budget) {
  Retimed timed;
  timed.profile = options.profile.value_or(default_profile);
  timed.trajectory.joint_names = arm.joint_names();
  Sections sections(arm, paths, options, budget);
  const double count = static_cast<double>(sections.steps());
  double steps = 0;  // of the sections so far
  for (std::size_t i = 0; i < sections.count(); ++i) {
    const double here = static_cast<double>(sections.steps(i));
    if (budget.ended(static_cast<std::int64_t>(sections.steps(i) + 1))) break;
    const TimedSection& section = sections.timed(i);
    if (!budget.complete() && !section.scaling) break;
    timed.reason = section.scaling.reason;
    if (!timed) {
      timed.trajectory = {};
      return timed;
    }
    // The time scaling of a section is about half of its work.
    budget.report((steps + 0.5 * here) / count);
    const bool begun = timed.trajectory.size() > 0;
    const SampledSection sampled =
        sections.sampled(i, options.rate, begun ? timed.trajectory.size() : 1,
                         begun ? timed.trajectory.times.back() : 0);
    if (!sampled && !sampled.reason) break;  // the budget has ended
    timed.reason = sampled.reason;
    if (!timed) {
      timed.trajectory = {};
      set_possible_rate(
          options, sections.shortest_duration(),
          [&](double rate) { return sections.possible(rate); }, timed.reason);
      return timed;
    }
    append(timed.trajectory, sampled.trajectory);
    ++timed.sections;
    steps += here;
    budget.report(steps / count);
  }
  finish(arm, options, sections.count(), budget, timed);
  return timed;
}

namespace {

/// The motion along straight joint motions with blends of these radii, a list for each section.
Retimed retimed_with(const std::vector<std::vector<double>>& radii, const Arm& arm,
                     const std::vector<std::vector<Configuration>>& sections,
                     const RetimeOptions& options, internal::BudgetMeter& budget) {
  std::vector<JointPath> paths;
  std::vector<double> blends;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    for (JointPath& path : internal::blended_paths(sections[i], radii[i])) {
      paths.push_back(std::move(path));
    }
    if (i > 0) blends.push_back(0);
    blends.insert(blends.end(), radii[i].begin(), radii[i].end());
  }
  Retimed timed = internal::retimed_paths(arm, paths, options, budget);
  timed.blends = std::move(blends);
  return timed;
}

/// The shortest duration of a motion that is refused because it takes longer; infinite if it is
/// refused otherwise, s.
double shortest_duration(const Retimed& refused) {
  const ReasonValue* shortest = refused.reason.find(ReasonField::shortest_duration);
  return shortest != nullptr ? std::get<double>(*shortest) : Limits::none;
}

/// The motion with the largest blends or, if that is quicker, with stops in place of small ones.
Retimed retimed_with_blends(const Arm& arm, const std::vector<std::vector<Configuration>>& sections,
                            const RetimeOptions& options, internal::BudgetMeter& budget) {
  std::vector<std::vector<double>> radii, stopping;
  for (const std::vector<Configuration>& section : sections) {
    radii.push_back(internal::largest_blends(section, *options.joint_blend));
    stopping.push_back(internal::with_stops_below(internal::small_blend, radii.back()));
  }
  Retimed timed = retimed_with(radii, arm, sections, options, budget);
  if (stopping == radii || !budget.complete()) return timed;
  Retimed stopped = retimed_with(stopping, arm, sections, options, budget);
  if (!budget.complete()) return stopped;
  const bool quicker = stopped ? !timed || stopped.duration() < timed.duration()
                               : !timed && shortest_duration(stopped) < shortest_duration(timed);
  return quicker ? std::move(stopped) : std::move(timed);
}

/// The motion along the trajectory's positions, from rest to rest.
Retimed retimed_positions(const Arm& arm, const Trajectory& trajectory,
                          const RetimeOptions& options, internal::BudgetMeter& budget) {
  const std::vector<std::vector<Configuration>> sections = positions_between_stops(trajectory);
  return options.joint_blend ? retimed_with_blends(arm, sections, options, budget)
                             : internal::retimed_paths(arm, splines(sections), options, budget);
}

/// The motion of a trajectory that starts outside the limits: first back to them, then along its
/// positions.
Retimed retimed_from_outside(const Arm& arm, Trajectory trajectory, const RetimeOptions& options,
                             internal::BudgetMeter& budget) {
  const Retimed section =
      internal::recovery_section(arm, trajectory.positions.front(), options, budget);
  if (!section) return section;
  trajectory.positions.front() = section.trajectory.positions.back();
  Retimed timed = section;
  if (moves(trajectory)) {
    RetimeOptions after = options;
    after.duration.reset();
    timed = retimed_positions(arm, trajectory, after, budget);
    if (!timed) return timed;
    internal::put_before(section.trajectory, timed.trajectory);
    timed.sections += section.sections;
    if (options.joint_blend) timed.blends.insert(timed.blends.begin(), 0);
  }
  if (options.duration) timed.reason = internal::set_duration(timed.trajectory, *options.duration);
  if (!timed) {
    timed.trajectory = {};
    return timed;
  }
  timed.recovery = recovery_of(arm, timed.trajectory);
  timed.limits = limit_usage(arm, timed.trajectory, budget.part());
  timed.tool_speed = internal::tool_speed_bound(arm, timed.trajectory, budget);
  end_with(budget, timed.sections, timed);
  return timed;
}

}  // namespace

Retimed retime(const Arm& arm, const Trajectory& recorded, const RetimeOptions& options) {
  Retimed given;
  given.profile = options.profile.value_or(default_profile);
  internal::check_options(options);
  internal::check_recover(options.recover);
  const Trajectory trajectory = path_of(arm, recorded, options, given.unwrapped);
  check_moves(trajectory);
  given.reason = too_long(trajectory, options);
  if (!given) return given;
  internal::BudgetMeter budget(options.budget);
  Retimed timed = internal::may_recover(internal::largest_excess(arm, trajectory.positions.front()),
                                        options.recover)
                      ? retimed_from_outside(arm, trajectory, options, budget)
                      : retimed_positions(arm, trajectory, options, budget);
  timed.unwrapped = std::move(given.unwrapped);
  return timed;
}

Retimed move_through(const Arm& arm, std::span<const Configuration> waypoints,
                     const RetimeOptions& options) {
  for (const Configuration& q : waypoints) check_configuration(arm, q);
  RetimeOptions as_given = options;
  as_given.no_unwrap = true;
  Trajectory path;
  path.joint_names = arm.joint_names();
  path.positions.assign(waypoints.begin(), waypoints.end());
  path.times.resize(waypoints.size());
  std::iota(path.times.begin(), path.times.end(), 0.0);  // retime() ignores them
  return retime(arm, path, as_given);
}

}  // namespace beeline
