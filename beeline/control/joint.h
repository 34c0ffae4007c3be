#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include <beeline/budget.h>
#include <beeline/error.h>
#include <beeline/model/arm.h>
#include <beeline/planning/branch.h>
#include <beeline/timing/point_to_point.h>
#include <beeline/trajectory/limit_usage.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// The jump of velocity with which a motion begins that does not begin at rest, in the joint for
/// which it is the largest fraction of the velocity limit.
struct StartJump {
  double velocity = 0;   ///< velocity after the jump, rad/s or m/s
  double fraction = 0;   ///< its magnitude as a fraction of the velocity limit; 0: at rest
  std::string joint;     ///< name of the joint; empty if the motion begins at rest
  bool assumed = false;  ///< whether the limit is unknown and assumed: see motion_limits()
};

/// A motion simulated with a feedback controller, or planned by move_joints().
struct ControlledMotion {
  MotionStatus status = MotionStatus::reached;
  Reason reason = {};                 ///< why; none if reached
  Trajectory trajectory;              ///< all steps of the motion, also if the goal was not reached
  std::vector<std::size_t> arrivals;  ///< index of the sample at which each goal was reached
  int steps = 0;                      ///< number of steps
  int slowed = 0;        ///< number of steps that were scaled down for the velocity limits
  double overshoot = 0;  ///< largest distance beyond a goal, relative to the distance to it
  double error = 0;      ///< remaining error at the last goal, radians or metres
  /// Fractions of the limits that the trajectory uses, and which of them are assumed, if the goal
  /// was reached. A controller keeps limits of position and velocity only: its first step changes
  /// the velocity at once, and accelerations and jerks may be far beyond their limits.
  LimitUsage limits = {};
  StartJump start_jump = {};  ///< jump of velocity at the start, if the goal was reached
  /// The beginning of the motion of move_joints() that leads back within the position limits; of a
  /// motion that starts within them none.
  std::optional<Recovery> recovery = std::nullopt;

  /// Returns whether the goal was reached.
  explicit operator bool() const { return status == MotionStatus::reached; }
  /// Returns the duration of the trajectory, s.
  double duration() const { return trajectory.duration(); }
};

/// Prints the status with its reason, or the duration, the samples and the remaining error.
std::ostream& operator<<(std::ostream& out, const ControlledMotion& motion);

struct SimulationOptions {
  /// Max error at a goal that counts as reached, metres and radians, above 0.
  double tolerance = 1e-6;
  int max_steps = 100'000;  ///< max steps of the whole motion, 1 to 1e7; beyond it `not_converged`
  double time_step = 0.02;  ///< time step of the controller, seconds, above 0
  Budget budget = {};       ///< budget of the whole motion
};

/// Gains of a discrete PID controller: each step is kp e + ki Σe + kd (e − last e) with the error
/// e = goal − q. With ki = kd = 0 this is eq. 1.3 of Dellaert, *Serial Link Manipulators*: it
/// approaches the goal monotonically for kp < 1, overshoots and oscillates for 1 < kp < 2, and does
/// not converge for kp ≥ 2.
struct PidGains {
  double kp = 0.1;  ///< proportional gain, above 0
  double ki = 0;    ///< integral gain, 0 or more
  double kd = 0;    ///< derivative gain, 0 or more
};

/// A PID controller in joint space, with its state: the sum of the errors and the last error.
/// Joint values are plain numbers; angles are not wrapped. No step allocates.
class Pid {
 public:
  /// Throws Error unless kp > 0, ki >= 0, kd >= 0, and the gains and the goal are finite.
  Pid(const PidGains& gains, const ConfigurationRef& goal);

  /// Resets the state to q: the sum is zero, and q is the reference of the next difference.
  /// Throws Error when the size of q is not the goal's or a value is not finite.
  void start(const ConfigurationRef& q);

  /// Changes the goal and keeps the state. The change of the goal does not enter the difference of
  /// the error. Throws Error when its size is not the old goal's size or a value is not finite.
  void set_goal(const ConfigurationRef& goal);

  /// Returns the change of q, valid until the next step. Without start() the first step starts at
  /// q. Throws Error, and keeps the state, when the size of q is not the goal's size or a value is
  /// not finite.
  const Configuration& step(const ConfigurationRef& q);

 private:
  void check(const ConfigurationRef& q) const;

  PidGains gains_;
  Configuration goal_, sum_, last_error_, change_;
  bool started_ = false;
};

/// Simulates joint-space motion control from `start` to `goal`. With kp alone the motion is a
/// straight line in joint space and a curve of the tool. Joint values are plain numbers; angles are
/// not wrapped.
/// Throws Error for gains that Pid refuses, and for a start that does not fit the arm or is outside
/// its limits. A goal outside the limits has the status `outside_limits`.
ControlledMotion control_joints(const Arm& arm, const Configuration& start,
                                const Configuration& goal, const PidGains& gains = {},
                                const SimulationOptions& options = {});

struct JointMoveOptions {
  Synchronise synchronise = Synchronise::time;  ///< synchronisation of the joints' motions
  double rate = 100;                            ///< samples per second, at least 0.001
  /// Duration, seconds, a whole number of periods of the rate; default: the shortest that the
  /// limits allow.
  std::optional<double> duration = std::nullopt;
  /// Largest excess of the start over a position limit, 0 to 0.1 rad or m, from which the motion
  /// leads back in; default: the largest.
  double recover = max_recover;
  Budget budget = {};
};

/// Moves the joints from rest at `start` to rest at `goal` in minimum time under the limits of
/// velocity, acceleration and jerk, or in options.duration; see point_to_point() and sampled(). The
/// start may be outside the position limits, see options.recover. Each joint moves in one direction
/// only, so the excess of a joint over its limit falls until it is within (recovery).
/// The status is `outside_limits` for a goal outside the limits, and for a duration that is too
/// short, whose reason has the shortest one. Throws Error for a start farther outside, a
/// configuration that does not fit the arm, and a duration that is not a whole number of periods.
ControlledMotion move_joints(const Arm& arm, const Configuration& start, const Configuration& goal,
                             const JointMoveOptions& options = {});

/// Returns the largest distance of any joint beyond the goal, relative to its distance from the
/// first sample to the goal; 0 if no joint overshoots.
double joint_overshoot(std::span<const Configuration> samples, const Configuration& goal);

}  // namespace beeline
