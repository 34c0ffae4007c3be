#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/path/joint_path.h>
#include <beeline/timing/internal/timed_path.h>
#include <beeline/timing/retime.h>

namespace beeline {
namespace {

using internal::TimedPath;

constexpr double repeated = 1e-12;        // radians or metres; nearer positions count as equal
constexpr double rest_speed = 1e-9;       // relative to the largest velocity; slower is rest
constexpr double longest_gap = 0.005;     // of a part's duration, between its samples
constexpr double max_rate_samples = 1e6;  // at a rate: some 300 MB for seven joints
constexpr double slowest_tool = 1e-9;     // metres per second

/// Returns the positions of each part of the path. A stop ends one part and begins the next.
std::vector<std::vector<Configuration>> parts_between_stops(const Trajectory& trajectory) {
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

/// Returns the reason if the path leaves the arm's position limits, otherwise an empty text.
std::string outside(const Arm& arm, const JointPath& path,
                    const std::vector<Configuration>& samples) {
  for (const Configuration& q : samples) {
    const auto violations = limit_violations(arm, q);
    if (!violations.empty()) return violations.front();
  }
  for (const Configuration& q : path.q) {
    const auto violations = limit_violations(arm, q);
    if (!violations.empty()) {
      return "between two samples the spline through them leaves the limits: " +
             violations.front() + "; samples closer together would guide it";
    }
  }
  return {};
}

/// The tool origin: its position, and its derivative with respect to the parameter of dq.
struct Tool {
  Vector3 position, velocity;
};
Tool tool_at(const Arm& arm, const Configuration& q, const Configuration& dq, Jacobian& columns) {
  const Pose pose = jacobian(arm, q, columns);
  return {pose.translation(), columns.topRows<3>() * dq};
}

void check(const Arm& arm, const RetimeOptions& options, Profile profile) {
  if (!(options.tool_speed >= slowest_tool)) {
    throw Error("the tool's speed must be " + number(slowest_tool) + " m/s at least, not " +
                number(options.tool_speed) + " m/s");
  }
  if (!(options.rate >= 0) || !std::isfinite(options.rate)) {
    throw Error("the rate must be above zero, or 0 for the samples of the path, not " +
                number(options.rate) + " samples a second");
  }
  if (profile == Profile::jerk && default_profile(arm) != Profile::jerk) {
    throw Error("profile jerk needs an arm with limits of jerk; " + arm.name() +
                " has none: give it some, or use profile fastest or s-curve");
  }
}

/// The factor by which the trajectory must be slowed down. Its samples may exceed limits that the
/// profile has checked at other times.
double slowdown_of(const Retimed& timed, const RetimeOptions& options) {
  const double jerk = keeps_jerk(timed.profile) ? timed.limits.jerk.fraction : 0;
  const double joints =
      slowdown(timed.limits.velocity.fraction, timed.limits.acceleration.fraction, jerk);
  return std::max({1.0, joints / options.speed_scale, timed.tool_speed / options.tool_speed});
}

void check_rate(const RetimeOptions& options, double duration) {
  const double rate = options.rate, fewest = options.min_steps;
  if (rate * duration > max_rate_samples) {
    throw Error(number(rate) + " samples a second make more than " + number(max_rate_samples) +
                " in " + number(duration) + " s");
  }
  if (rate > 0 && rate * duration < fewest) {
    constexpr double up = 1 + 1e-5;  // number() rounds to six digits
    throw Error(number(rate) + " samples a second leave fewer than " + number(fewest) +
                " steps in a motion of " + number(duration) + " s; the rate must be at least " +
                number(up * fewest / duration));
  }
}

Trajectory sampled(const Arm& arm, const std::vector<TimedPath>& motions, double rate,
                   std::vector<double>& arc_lengths) {
  Trajectory trajectory;
  if (rate > 0) {
    trajectory = internal::at_rate(motions, rate, arc_lengths);
  } else {
    for (const TimedPath& motion : motions) {
      internal::append_points(trajectory, motion, longest_gap * motion.scaling.duration());
    }
  }
  trajectory.joint_names = arm.joint_names();
  return trajectory;
}

void measure(const Arm& arm, Retimed& timed) {
  const auto& [names, t, q, v, a] = timed.trajectory;
  timed.limits = limit_usage(arm, timed.trajectory);
  timed.tool_speed = 0;
  Jacobian columns(6, arm.dof());
  Vector3 before = Vector3::Zero();
  for (std::size_t k = 0; k < t.size(); ++k) {
    const auto [position, velocity] = tool_at(arm, q[k], v[k], columns);
    const double distance = k == 0 ? 0 : (position - before).norm();
    // The speed over a distance of the size of rounding is not defined.
    const double between = distance > 1e-9 ? distance / (t[k] - t[k - 1]) : 0;
    timed.tool_speed = std::max({timed.tool_speed, velocity.norm(), between});
    before = position;
  }
}

/// Samples the motions, slowed down until the samples keep the limits. Samples at a rate have other
/// path parameters in each pass, and others may then be the worst. So each pass slows down by a
/// little more than its samples need: by 10 %, twice that in the next pass and so on, but by at
/// most the sum of all passes before. The total then stays below twice the slowdown that suffices
/// at any rate.
void slow_down_to_limits(const Arm& arm, Retimed& timed, std::vector<TimedPath>& motions,
                         const RetimeOptions& options) {
  constexpr double rounding = 1e-12;
  constexpr int max_passes = 100;  // `more` overflows no sooner; a few passes are usual
  double excess = 0;               // of all passes
  double more = 1.1;
  for (int pass = 0; pass < max_passes; ++pass, more *= 2) {
    timed.trajectory = sampled(arm, motions, options.rate, timed.arc_lengths);
    measure(arm, timed);
    const double needed = slowdown_of(timed, options) - 1;
    if (!(needed > rounding)) return;
    const double step = std::max(1.1 * needed, std::min(more * needed, excess));
    for (TimedPath& motion : motions) internal::slow_down(motion.scaling, 1 + step);
    excess += (1 + excess) * step;
  }
  throw Error("no samples were found that keep the limits at " + number(options.rate) +
              " samples a second; try another rate");
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
  timed.profile = options.profile.value_or(default_profile(arm));
  check(arm, options, timed.profile);
  const Trajectory trajectory = matched_to(arm, recorded);
  PathLimits limits = path_limits(arm, options.speed_scale);
  check_moves(trajectory);
  Jacobian columns(6, arm.dof());
  std::vector<TimedPath> motions;
  double duration = 0;
  for (const std::vector<Configuration>& samples : parts_between_stops(trajectory)) {
    TimedPath& motion = motions.emplace_back();
    motion.path = refined(joint_spline(samples, chord_length(samples)));
    timed.reason = outside(arm, motion.path, samples);
    if (!timed) return timed;
    limits.speed.clear();
    for (std::size_t k = 0; k < motion.path.size() && options.tool_speed < Limits::none; ++k) {
      const Tool tool = tool_at(arm, motion.path.q[k], motion.path.dq[k], columns);
      limits.speed.push_back(options.tool_speed / tool.velocity.norm());
    }
    motion.scaling = time_scaling(motion.path, limits, timed.profile);
    timed.reason = motion.scaling.reason;
    if (!timed) return timed;
    duration += motion.scaling.duration();
  }
  check_rate(options, duration);
  timed.sections = motions.size();
  slow_down_to_limits(arm, timed, motions, options);
  return timed;
}

}  // namespace beeline
