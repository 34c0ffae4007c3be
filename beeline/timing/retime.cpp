#include <algorithm>
#include <cmath>
#include <numeric>

#include <beeline/error.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/timing/internal/blended_path.h>
#include <beeline/timing/internal/recovery_section.h>
#include <beeline/timing/internal/retimed_paths.h>
#include <beeline/timing/internal/timed_section.h>
#include <beeline/timing/retime.h>
#include <beeline/trajectory/internal/given_duration.h>
#include <beeline/trajectory/internal/recovery.h>
#include <beeline/trajectory/internal/tool_speed.h>

namespace beeline {
namespace {

constexpr double repeated = 1e-12;   // radians or metres; nearer positions count as equal
constexpr double rest_speed = 1e-9;  // relative to the largest velocity; slower is rest

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

/// Counts the section that recovers as one more of the motion, also if the budget ended it.
void count_recovery(Retimed& timed) {
  ++timed.sections;
  const ReasonValue* const all = timed.reason.find(ReasonField::of);
  if (all == nullptr) return;
  timed.reason.set(ReasonField::of, std::get<std::size_t>(*all) + 1);
  timed.reason.set(ReasonField::count, timed.sections);
}

/// Removes the samples of a recovery from a recording of a motion that has one: behind the first
/// sample those outside the limits, if they are different, in order on the straight line to the
/// nearest configuration within the limits, and others follow.
void remove_recovery(const Arm& arm, Trajectory& trajectory) {
  constexpr double rounding = 1e-9;  // radians or metres
  std::vector<Configuration>& q = trajectory.positions;
  const Configuration change = nearest_within_limits(arm, q.front()) - q.front();
  double done = 0;  // part of the change
  std::size_t end = 1;
  for (; end < q.size(); ++end) {
    const Configuration moved = q[end] - q.front();
    const double part = moved.dot(change) / change.squaredNorm();
    const bool is_straight = (moved - part * change).lpNorm<Eigen::Infinity>() <= rounding;
    if (!is_straight || part <= done || internal::largest_excess(arm, q[end]) <= 0) break;
    done = part;
  }
  if (end == q.size() || internal::largest_excess(arm, q[end]) > 0) return;
  const auto erase = [end](auto& samples) {
    if (!samples.empty()) samples.erase(samples.begin() + 1, samples.begin() + end);
  };
  erase(trajectory.times);
  erase(trajectory.positions);
  erase(trajectory.velocities);
  erase(trajectory.accelerations);
}

/// The motion of a trajectory that starts outside the limits: first back to them, then along its
/// positions. If the budget ends it, what is retimed so far begins with the recovery, too.
Retimed retimed_from_outside(const Arm& arm, Trajectory trajectory, const RetimeOptions& options,
                             internal::BudgetMeter& budget) {
  Retimed section = internal::recovery_section(arm, trajectory.positions.front(), options, budget);
  if (!section) {
    if (section.trajectory.size() > 0) section.recovery = recovery_of(arm, section.trajectory);
    return section;
  }
  trajectory.positions.front() = section.trajectory.positions.back();
  Retimed timed = section;
  if (moves(trajectory)) {
    RetimeOptions after = options;
    after.duration.reset();
    if (options.rate > 0) {
      internal::SamplesBehind behind =
          internal::samples_behind(section.trajectory, options.max_samples);
      if (behind.reason) {
        timed.reason = std::move(behind.reason);
        return internal::without_motion(std::move(timed));
      }
      after.max_samples = behind.max_samples;
    }
    timed = retimed_positions(arm, trajectory, after, budget);
    internal::set_max_samples(options.max_samples, timed.reason);
    if (!timed && timed.ending == Ending::complete) return timed;
    if (timed.trajectory.size() == 0) {
      timed.trajectory = section.trajectory;
    } else {
      internal::put_before(section.trajectory, timed.trajectory);
    }
    count_recovery(timed);
    if (options.joint_blend) timed.blends.insert(timed.blends.begin(), 0);
  }
  timed.recovery = recovery_of(arm, timed.trajectory);
  if (timed.ending != Ending::complete) return timed;
  if (options.duration) {
    timed.reason = internal::set_duration(timed.trajectory, *options.duration);
    if (!timed) return internal::without_motion(std::move(timed));
    timed.recovery = recovery_of(arm, timed.trajectory);
  }
  timed.limits = limit_usage(arm, timed.trajectory, budget.part());
  timed.tool_speed = internal::tool_speed_bound(arm, timed.trajectory, budget);
  internal::end_with(budget, timed.sections, timed);
  return timed;
}

}  // namespace

Retimed retime(const Arm& arm, const Trajectory& recorded, const RetimeOptions& options) {
  Retimed given;
  given.profile = options.profile.value_or(default_profile);
  internal::check_options(options);
  internal::check_recover(options.recover);
  Trajectory trajectory = path_of(arm, recorded, options, given.unwrapped);
  check_moves(trajectory);
  given.reason = too_long(trajectory, options);
  if (!given) return given;
  internal::BudgetMeter budget(options.budget);
  const double excess = internal::largest_excess(arm, trajectory.positions.front());
  const bool recovers = internal::may_recover(excess, options.recover);
  // Waypoints have no velocities, and each is a position of the path.
  if (recovers && !trajectory.velocities.empty()) remove_recovery(arm, trajectory);
  Retimed timed = recovers ? retimed_from_outside(arm, std::move(trajectory), options, budget)
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
