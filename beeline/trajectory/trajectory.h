#pragma once

#include <string>
#include <vector>

#include <beeline/model/arm.h>

namespace beeline {

/// What a joint without a known velocity limit is held to, per second (radians or metres).
constexpr double velocity_when_unknown = 1.0;

/// What a joint is held to, per second: its velocity limit where that is known.
constexpr double held_velocity(const Limits& limits) {
  return limits.velocity < Limits::none ? limits.velocity : velocity_when_unknown;
}

/// A motion with time, as plain data. Sample k is positions[k] at times[k]; velocities and
/// accelerations are empty where they are not known, else as long as positions.
struct Trajectory {
  std::vector<std::string> joint_names;      ///< one for each coordinate
  std::vector<double> times;                 ///< seconds, strictly increasing
  std::vector<Configuration> positions;      ///< radians, metres
  std::vector<Configuration> velocities;     ///< per second
  std::vector<Configuration> accelerations;  ///< per second squared

  std::size_t size() const { return times.size(); }
};

/// One sample: the arm at rest at q at time zero.
Trajectory at_rest(const Arm& arm, const ConfigurationRef& q);

/// Throws Error when two joints have one name, the lengths differ, a number is not finite or time
/// does not increase.
void check_trajectory(const Trajectory& trajectory);

/// The configuration at time t, linear between samples (what a line's certificate assumes); before
/// the first sample the first, after the last the last. Throws Error when there are no samples, or
/// t is no number.
Configuration sample(const Trajectory& trajectory, double t);

/// The trajectory's columns in the arm's order, matched by joint name.
/// Throws Error as check_trajectory(), and naming the joints that are missing or that the arm does
/// not have.
Trajectory matched_to(const Arm& arm, const Trajectory& trajectory);

}  // namespace beeline
