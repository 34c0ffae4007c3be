#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {

/// The motion of the joints between two samples, as ros2_control's joint trajectory controller
/// plays it: polynomials of degree 1, 3 or 5 in time that agree with both samples.
enum class Interpolation {
  linear,   ///< polynomial of degree 1, from positions only
  cubic,    ///< polynomial of degree 3, from positions and velocities
  quintic,  ///< polynomial of degree 5, from positions, velocities and accelerations
};
std::string name(Interpolation interpolation);
std::vector<std::string> interpolation_names();

/// Throws Error listing the names for another name.
Interpolation interpolation_named(const std::string& name);

/// The lowest rate of samples, per second.
constexpr double lowest_rate = 1e-3;

/// A motion of n joints as N samples: positions[k] at times[k]. The columns determine the motion
/// between the samples, as ros2_control's joint trajectory controller plays it: it is linear for
/// positions only, the cubic polynomial for positions and velocities, and the quintic polynomial
/// with accelerations too. See sample().
struct Trajectory {
  std::vector<std::string> joint_names;      ///< names of the joints, one for each coordinate, (n,)
  std::vector<double> times;                 ///< times of the samples, s, strictly increasing, (N,)
  std::vector<Configuration> positions;      ///< rad, or m for prismatic joints
  std::vector<Configuration> velocities;     ///< rad/s or m/s; empty if unknown
  std::vector<Configuration> accelerations;  ///< rad/s^2 or m/s^2; empty if unknown

  std::size_t size() const { return times.size(); }
  /// Returns the time from the first sample to the last, s; 0 without samples.
  double duration() const { return times.empty() ? 0 : times.back() - times.front(); }
  Interpolation interpolation() const {
    if (velocities.empty()) return Interpolation::linear;
    return accelerations.empty() ? Interpolation::cubic : Interpolation::quintic;
  }
};

/// Prints `7 joints, 43 samples, 0.42 s, quintic`.
std::ostream& operator<<(std::ostream& out, const Trajectory& trajectory);

/// State of the joints at one time.
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

/// Returns the state at time t of the motion that the columns mean. Before the first sample the
/// joints are at rest at its position, and after the last sample at the position of the last.
/// Throws Error when there are no samples, or t is NaN.
TrajectoryState sample(const Trajectory& trajectory, double t, Side side = Side::after);

/// A joint of a recording that is a coordinate of an arm:
///     coordinate = unit * (sign * recorded + offset).
struct MappedJoint {
  std::string name;   ///< name of the joint in the recording
  double sign = 1;    ///< sign of its values, 1 or -1
  double offset = 0;  ///< offset in the recording's unit
  /// Radians or metres per unit of the recording; default: MatchOptions::column_units, else
  /// MatchOptions::angle_unit for angles, 1 for metres.
  std::optional<double> unit = std::nullopt;
};

/// A joint of a recording for each coordinate of an arm.
using JointMap = std::vector<MappedJoint>;

struct MatchOptions {
  /// Joints of the recording; empty: joints are matched by name. With a map all other columns are
  /// dropped.
  JointMap joint_map = {};
  double angle_unit = 1;  ///< radians per unit of the recording: pi / 180 for degrees
  /// Radians or metres per unit of the values of each of the trajectory's joints, if known; empty:
  /// none is known.
  std::vector<std::optional<double>> column_units = {};
};

/// Returns the trajectory with its columns in the arm's order, matched by joint name: the arm's own
/// names, one of the lists of BuiltInArm::joint_names of a built-in arm, or either with the same
/// text in front of all of them, as `left_joint1`, or with `position`, and for rates `velocity` and
/// `acceleration`, before or behind it, as /joint_states/joint1/position and velocity_joint1; other
/// columns are dropped only in the last case. Upper and lower case are alike. A text in front that
/// names another quantity, as torque_joint1, is not matched. Throws Error for
/// columns that do not fit together (check_trajectory()), for joints that are missing or that the
/// arm does not have, for a joint map of another length, sign or unit, and for another number of
/// units.
Trajectory matched_to(const Arm& arm, const Trajectory& trajectory,
                      const MatchOptions& options = {});

/// A joint whose recorded values jumped by whole revolutions.
struct UnwrappedJoint {
  std::string joint;      ///< name of the joint
  int wraps = 0;          ///< number of jumps
  double first_time = 0;  ///< time of the sample after the first jump, s
};

/// A trajectory without the jumps of sensors whose values wrap after a revolution.
struct Unwrapped {
  Trajectory trajectory;               ///< trajectory with its columns in the arm's order
  std::vector<UnwrappedJoint> joints;  ///< joints that were changed
};

/// Returns the trajectory, matched_to() the arm, without the jumps of sensors whose values wrap
/// after a revolution. Only continuous joints are unwrapped: revolute ones without position limits,
/// whose followers repeat after a revolution too. Their values are within one or two revolutions,
/// and jump by as many. If the mean velocity from one sample to the next
/// exceeds the joint's velocity limit, known or assumed, but without whole revolutions it is within
/// the limit, or as slow as the motion just before or after, these revolutions are taken from all
/// later samples.
Unwrapped unwrapped(const Arm& arm, const Trajectory& trajectory);

/// The difference of one coordinate between two trajectories.
struct JointDifference {
  double largest = 0;  ///< largest difference, rad or m
  double time = 0;     ///< time of the largest difference since the first samples, s
  double rms = 0;      ///< root mean square of the difference over the common duration, rad or m
};

/// The difference of two trajectories of an arm.
struct TrajectoryDifference {
  std::vector<JointDifference> joints;  ///< differences of the coordinates
  double largest_position = 0;          ///< largest distance between the tools, m
  double position_time = 0;             ///< time of the largest distance, s
  double largest_orientation = 0;       ///< largest angle between the tools, rad
  double orientation_time = 0;          ///< time of the largest angle, s
  double overlap = 0;                   ///< common duration, s
  double longer = 0;                    ///< duration of b minus duration of a, s
};

/// Compares two trajectories of an arm, each from its own first sample on, joints linear between
/// samples, at the samples of both. Whole revolutions of a continuous joint are ignored: the joint
/// of b begins within half a revolution of the joint of a. The joints' largest differences are
/// exact; the tool's differences are the largest at the samples. Throws Error if a trajectory does
/// not fit the arm or has no samples.
TrajectoryDifference difference(const Arm& arm, const Trajectory& a, const Trajectory& b);

}  // namespace beeline
