#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/path/joint_spline.h>
#include <beeline/timing/fastest.h>
#include <beeline/timing/internal/timed_path.h>
#include <beeline/timing/jerk_limited.h>
#include <beeline/timing/retime.h>
#include <beeline/timing/scalar_profile.h>

namespace beeline {
namespace {

constexpr const char* profile_names[] = {"fastest", "jerk", "trapezoidal", "quintic", "s-curve"};

constexpr double repeated = 1e-12;     // radians, metres: positions as near as that are one
constexpr double standing = 1e-9;      // of the largest velocity
constexpr double longest_gap = 0.005;  // of a stretch's duration, between its samples
constexpr double max_rate_samples = 1e6;
constexpr double slowest_tool = 1e-9;  // metres per second

/// The positions between the stops, which end one stretch and begin the next.
std::vector<std::vector<Configuration>> stretches(const Trajectory& trajectory) {
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
           trajectory.velocities[k].lpNorm<Eigen::Infinity>() <= standing * largest;
  }
  return all;
}

/// Why the path leaves the arm's position limits; empty when it does not.
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

/// Where the tool is, and how it moves.
struct Tool {
  Vector3 position, velocity;
};
Tool tool_at(const Arm& arm, const Configuration& q, const Configuration& dq, Jacobian& columns) {
  const Pose pose = jacobian(arm, q, columns);
  return {pose.translation(), columns.topRows<3>() * dq};
}

TimeScaling scaling_along(const JointPath& path, const PathLimits& limits, Profile profile) {
  switch (profile) {
    case Profile::jerk:
      return jerk_limited(path, limits);
    case Profile::trapezoidal:
      return scalar_profile(ScalarForm::trapezoidal, path, limits);
    case Profile::quintic:
      return scalar_profile(ScalarForm::quintic, path, limits);
    case Profile::s_curve:
      return scalar_profile(ScalarForm::s_curve, path, limits);
    case Profile::fastest:
      break;
  }
  return fastest(path, limits);
}

void check(const Arm& arm, const RetimeOptions& options, Profile profile) {
  if (!(options.tool_speed >= slowest_tool)) {
    throw Error("the tool's speed must be " + number(slowest_tool) + " m/s at least, not " +
                number(options.tool_speed) + " m/s");
  }
  if (!(options.rate >= 0) || !std::isfinite(options.rate)) {
    throw Error("the rate must be above zero, not " + number(options.rate) + " samples a second");
  }
  if (profile == Profile::jerk && default_profile(arm) != Profile::jerk) {
    throw Error("profile jerk needs an arm with limits of jerk; " + arm.name() +
                " has none: give it some, or ask for profile fastest or s-curve");
  }
}

/// By what factor the trajectory must be slower: samples may show what the profile's own check, at
/// other places, has not seen.
double slower(const Retimed& timed, const RetimeOptions& options) {
  const double fraction = options.speed_limit;
  double factor = std::max({1.0, timed.limits.velocity.fraction / fraction,
                            std::sqrt(timed.limits.acceleration.fraction) / fraction,
                            timed.tool_speed / options.tool_speed});
  if (keeps_jerk(timed.profile))
    factor = std::max(factor, std::cbrt(timed.limits.jerk.fraction) / fraction);
  return factor;
}

void check_rate(const RetimeOptions& options, double duration) {
  const double rate = options.rate, fewest = options.fewest_steps;
  if (rate * duration > max_rate_samples) {
    throw Error(number(rate) + " samples a second make more than " + number(max_rate_samples) +
                " in " + number(duration) + " s");
  }
  if (rate > 0 && rate * duration < fewest) {
    constexpr double up = 1 + 1e-5;  // that number() rounds away
    throw Error(number(rate) + " samples a second lose the way of a motion of " + number(duration) +
                " s; " + number(up * fewest / duration) + " or more would do");
  }
}

void slow_down(TimeScaling& scaling, double factor) {
  for (double& t : scaling.t) t *= factor;
  for (double& v : scaling.speed) v /= factor;
  for (double& a : scaling.acceleration) a /= factor * factor;
}

Trajectory sampled(const Arm& arm, const std::vector<TimedPath>& motions, double rate,
                   std::vector<double>& ways) {
  Trajectory trajectory;
  if (rate > 0) {
    trajectory = at_rate(motions, rate, ways);
  } else {
    for (const TimedPath& motion : motions) {
      append_points(trajectory, motion, longest_gap * motion.scaling.duration());
    }
  }
  trajectory.joint_names = arm.joint_names();
  return trajectory;
}

void measure(const Arm& arm, Retimed& timed) {
  const auto& [names, t, q, v, a] = timed.trajectory;
  timed.limits = limit_usage(timed.trajectory, arm);
  timed.tool_speed = 0;
  Jacobian columns(6, arm.dof());
  Vector3 before = Vector3::Zero();
  for (std::size_t k = 0; k < t.size(); ++k) {
    const auto [position, velocity] = tool_at(arm, q[k], v[k], columns);
    const double way = k == 0 ? 0 : (position - before).norm();
    // What lies between by rounding alone is no speed.
    const double between = way > 1e-9 ? way / (t[k] - t[k - 1]) : 0;
    timed.tool_speed = std::max({timed.tool_speed, velocity.norm(), between});
    before = position;
  }
}

/// Samples the motions, slowed down until the samples keep the limits. Samples at a rate fall on
/// other places each time, and others may then be the worst: a little more than these tell, and
/// more with each pass, though at most as much again as all passes before. So it ends before the
/// motion is slowed down twice as much as would do at any rate.
void settle(const Arm& arm, Retimed& timed, std::vector<TimedPath>& motions,
            const RetimeOptions& options) {
  constexpr double rounding = 1e-12;
  double excess = 0;  // of all passes
  double more = 1.1;
  for (int pass = 0; pass < 100; ++pass, more *= 2) {
    timed.trajectory = sampled(arm, motions, options.rate, timed.ways);
    measure(arm, timed);
    const double left = slower(timed, options) - 1;
    if (!(left > rounding)) return;
    const double step = std::max(1.1 * left, std::min(more * left, excess));
    for (TimedPath& motion : motions) slow_down(motion.scaling, 1 + step);
    excess += (1 + excess) * step;
  }
  throw Error("no samples were found that keep the limits at " + number(options.rate) +
              " samples a second; another rate may do");
}

}  // namespace

bool keeps_jerk(Profile profile) {
  return profile != Profile::fastest && profile != Profile::trapezoidal;
}

std::string name(Profile profile) { return profile_names[static_cast<int>(profile)]; }

Profile profile_named(const std::string& name) {
  const std::vector<std::string> names(std::begin(profile_names), std::end(profile_names));
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) throw unknown_name("profile", name, names);
  return static_cast<Profile>(found - names.begin());
}

Profile default_profile(const Arm& arm) {
  const auto has_jerk = [](const Limits& limits) { return limits.jerk < Limits::none; };
  return std::any_of(arm.limits().begin(), arm.limits().end(), has_jerk) ? Profile::jerk
                                                                         : Profile::fastest;
}

void check_moves(const Trajectory& trajectory) {
  const auto& q = trajectory.positions;
  const auto elsewhere = [&](const Configuration& other) {
    return (other - q.front()).norm() > repeated;
  };
  if (std::any_of(q.begin(), q.end(), elsewhere)) return;
  const std::string found = q.empty()       ? "no samples"
                            : q.size() == 1 ? "one sample"
                                            : std::to_string(q.size()) + " samples at one place";
  throw Error("a trajectory needs two different positions to be timed; this one has " + found);
}

Retimed retime(const Arm& arm, const Trajectory& recorded, const RetimeOptions& options) {
  Retimed timed;
  timed.profile = options.profile.value_or(default_profile(arm));
  check(arm, options, timed.profile);
  const Trajectory trajectory = matched_to(arm, recorded);
  PathLimits limits = path_limits(arm, options.speed_limit);
  check_moves(trajectory);
  Jacobian columns(6, arm.dof());
  std::vector<TimedPath> motions;
  double duration = 0;
  for (const std::vector<Configuration>& samples : stretches(trajectory)) {
    TimedPath& motion = motions.emplace_back();
    motion.path = refined(joint_spline(samples, chord_length(samples)));
    timed.reason = outside(arm, motion.path, samples);
    if (!timed.found()) return timed;
    limits.speed.clear();
    for (std::size_t k = 0; k < motion.path.size() && options.tool_speed < Limits::none; ++k) {
      const Tool tool = tool_at(arm, motion.path.q[k], motion.path.dq[k], columns);
      limits.speed.push_back(options.tool_speed / tool.velocity.norm());
    }
    motion.scaling = scaling_along(motion.path, limits, timed.profile);
    timed.reason = motion.scaling.reason;
    if (!timed.found()) return timed;
    duration += motion.scaling.duration();
  }
  check_rate(options, duration);
  timed.stretches = motions.size();
  settle(arm, timed, motions, options);
  return timed;
}

}  // namespace beeline
