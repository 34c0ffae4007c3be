#pragma once

#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {

/// The motion of the joints between two samples, as ros2_control's joint trajectory controller
/// plays it: polynomials of degree 1, 3 or 5 in time that agree with both samples.
enum class Interpolation {
  linear,   ///< of positions alone
  cubic,    ///< of positions and velocities
  quintic,  ///< of positions, velocities and accelerations
};
std::string name(Interpolation interpolation);
std::vector<std::string> interpolation_names();

/// Throws Error listing the names for another name.
Interpolation interpolation_named(const std::string& name);

/// A motion of the joints with time, as plain data. Sample k is positions[k] at times[k];
/// velocities and accelerations are empty where they are not known, else as long as positions.
/// These columns determine the motion between the samples: see Interpolation and sample().
struct Trajectory {
  std::vector<std::string> joint_names;      ///< one for each coordinate
  std::vector<double> times;                 ///< seconds, strictly increasing
  std::vector<Configuration> positions;      ///< radians, metres
  std::vector<Configuration> velocities;     ///< per second
  std::vector<Configuration> accelerations;  ///< per second squared

  std::size_t size() const { return times.size(); }
  Interpolation interpolation() const {
    if (velocities.empty()) return Interpolation::linear;
    return accelerations.empty() ? Interpolation::cubic : Interpolation::quintic;
  }
};

/// The state of the joints at one time: radians or metres per second and its powers.
struct TrajectoryState {
  Configuration position, velocity, acceleration, jerk;
};

/// The side of a time at which derivatives are taken. They may differ at a sample: the velocity of
/// a linear motion, the acceleration of a cubic one, the jerk of a quintic one.
enum class Side { before, after };

/// Returns a trajectory of one sample: the arm at rest at q at time zero.
Trajectory at_rest(const Arm& arm, const ConfigurationRef& q);

/// Throws Error when two joints have the same name, the lengths differ, a number is not finite, the
/// times do not increase, or there are accelerations without velocities.
void check_trajectory(const Trajectory& trajectory);

/// Returns the state at time t of the motion that the columns mean. Before the first sample and
/// after the last the joints are at rest there. Throws Error when there are no samples, or t is
/// NaN.
TrajectoryState sample(const Trajectory& trajectory, double t, Side side = Side::after);

/// Returns the trajectory with its columns in the arm's order, matched by joint name. Throws Error
/// as check_trajectory() does, and for joints that are missing or that the arm does not have.
Trajectory matched_to(const Arm& arm, const Trajectory& trajectory);

}  // namespace beeline
