#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/timing/internal/sampled_section.h>
#include <beeline/timing/retime.h>
#include <beeline/trajectory/internal/append.h>
#include <beeline/trajectory/internal/given_duration.h>
#include <beeline/trajectory/internal/tool_speed.h>

namespace beeline {
namespace {

constexpr double repeated = 1e-12;   // radians or metres; nearer positions count as equal
constexpr double rest_speed = 1e-9;  // relative to the largest velocity; slower is rest
constexpr int linear_samples = 200;  // of a section, where joints move linearly between them

/// Returns the positions of each section of the path. A stop ends one section and begins the next.
std::vector<std::vector<Configuration>> sections_between_stops(const Trajectory& trajectory) {
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

/// The number of steps between the positions of all sections.
std::size_t steps_of(const std::vector<std::vector<Configuration>>& sections) {
  std::size_t steps = 0;
  for (const std::vector<Configuration>& positions : sections) steps += positions.size() - 1;
  return steps;
}

/// The path parameters that get a sample: the positions, and for linear joints more.
std::vector<double> required_samples(const std::vector<Configuration>& positions, bool linear) {
  std::vector<double> s = chord_length(positions);
  const double length = s.back();
  for (int i = 1; linear && i < linear_samples; ++i) s.push_back(length * i / linear_samples);
  std::sort(s.begin(), s.end());
  return s;
}

/// The samples that a section may have after its first.
double samples_left(const RetimeOptions& options, const Retimed& timed) {
  const std::size_t before = std::max<std::size_t>(timed.trajectory.size(), 1);
  return static_cast<double>(options.max_samples) - static_cast<double>(before);
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
  timed.tool_speed = internal::tool_speed_bound(arm, timed.trajectory, budget);
  timed.ending = budget.ending();
  if (!budget.complete()) {
    timed.reason = internal::ended_reason(ReasonCode::ended_in_retiming, timed.ending);
    timed.reason.set(ReasonField::count, timed.sections).set(ReasonField::of, sections);
  }
}

}  // namespace

void check_moves(const Trajectory& trajectory) {
  const auto& q = trajectory.positions;
  const auto elsewhere = [&](const Configuration& other) {
    return (other - q.front()).norm() > repeated;
  };
  if (std::any_of(q.begin(), q.end(), elsewhere)) return;
  const std::string found = q.empty()       ? "no samples"
                            : q.size() == 1 ? "one sample"
                                            : std::to_string(q.size()) + " samples at one position";
  throw Error("a trajectory needs two different positions to be retimed; this one has " + found);
}

Retimed retime(const Arm& arm, const Trajectory& recorded, const RetimeOptions& options) {
  Retimed timed;
  timed.profile = options.profile.value_or(default_profile);
  internal::check_options(options);
  const Trajectory trajectory = path_of(arm, recorded, options, timed.unwrapped);
  check_moves(trajectory);
  timed.reason = too_long(trajectory, options);
  if (!timed) return timed;
  timed.trajectory.joint_names = arm.joint_names();
  const bool linear = options.interpolation == Interpolation::linear;
  internal::BudgetMeter budget(options.budget);
  const std::vector<std::vector<Configuration>> sections = sections_between_stops(trajectory);
  const double count = static_cast<double>(steps_of(sections));
  double steps = 0;  // of the sections so far
  for (const std::vector<Configuration>& samples : sections) {
    // The time scaling of a section is about half of its work.
    const auto fraction = [&](double section) {
      return (steps + section * static_cast<double>(samples.size() - 1)) / count;
    };
    if (budget.ended(static_cast<std::int64_t>(samples.size()))) break;
    const internal::SectionOptions section{.timing = options,
                                           .tool_speeds = options.tool_speed,
                                           .samples_left = samples_left(options, timed),
                                           .required = required_samples(samples, linear),
                                           .budget = budget};
    const internal::TimedSection path =
        internal::timed_section(arm, joint_spline(samples, chord_length(samples)), section);
    if (!budget.complete() && !path.scaling) break;
    timed.reason = path.scaling.reason;
    if (!timed) return timed;
    budget.report(fraction(0.5));
    const internal::SampledSection sampled = internal::sample_section(arm, path, section);
    if (!sampled && !sampled.reason) break;  // the budget has ended
    timed.reason = sampled.reason;
    if (!timed) {
      timed.trajectory = {};
      return timed;
    }
    internal::append(timed.trajectory, sampled.trajectory);
    ++timed.sections;
    budget.report(fraction(1));
    steps += static_cast<double>(samples.size() - 1);
  }
  finish(arm, options, sections.size(), budget, timed);
  return timed;
}

}  // namespace beeline
