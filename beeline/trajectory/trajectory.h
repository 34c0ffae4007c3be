#pragma once

#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {

/// The velocity limit assumed for a joint without a known one: radians or metres per second.
constexpr double assumed_velocity_limit = 1.0;

/// The velocity limit that motions keep, radians or metres per second: the joint's own where it is
/// known, else the assumed one.
constexpr double velocity_limit_of(const Limits& limits) {
  return limits.velocity < Limits::none ? limits.velocity
                                        : limits.speed_scale * assumed_velocity_limit;
}

/// A joint motion with time, as plain data. Sample k is positions[k] at times[k]; velocities and
/// accelerations are empty where they are not known, else as long as positions.
struct Trajectory {
  std::vector<std::string> joint_names;      ///< one for each coordinate
  std::vector<double> times;                 ///< seconds, strictly increasing
  std::vector<Configuration> positions;      ///< radians, metres
  std::vector<Configuration> velocities;     ///< per second
  std::vector<Configuration> accelerations;  ///< per second squared

  std::size_t size() const { return times.size(); }
};

/// Returns a trajectory of one sample: the arm at rest at q at time zero.
Trajectory at_rest(const Arm& arm, const ConfigurationRef& q);

/// Throws Error when two joints have the same name, the lengths differ, a number is not finite or
/// the times do not increase.
void check_trajectory(const Trajectory& trajectory);

/// Returns the configuration at time t, interpolated linearly between samples, as the certificate
/// of a line assumes. Before the first sample it is the first, after the last the last. Throws
/// Error when there are no samples, or t is NaN.
Configuration sample(const Trajectory& trajectory, double t);

/// Returns the trajectory with its columns in the arm's order, matched by joint name. Throws Error
/// as check_trajectory() does, and for joints that are missing or that the arm does not have.
Trajectory matched_to(const Arm& arm, const Trajectory& trajectory);

}  // namespace beeline
