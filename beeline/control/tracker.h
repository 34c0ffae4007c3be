#pragma once

#include <iosfwd>
#include <memory>
#include <optional>
#include <string>

#include <beeline/control/servo.h>
#include <beeline/error.h>
#include <beeline/kinematics/task.h>

namespace beeline {

namespace internal {
class TrackerLoop;
}

struct TrackerOptions {
  /// Rows that matter; default: planar for a planar arm, else spatial.
  std::optional<Task> task = std::nullopt;
  double time_step = 1e-3;  ///< between two steps, seconds, above 0
  /// Between two commands that differ, seconds. Each is approached in a straight line during this
  /// time, so that commands that come at a lower rate than the steps give a continuous motion, one
  /// period late. Where commands differ at every step it smooths their noise, as a first-order
  /// filter with this time constant. Up to `time_step`: commands are followed at once.
  double command_period = 0;
  Deviation tolerance{1e-4, 1e-3};  ///< of the status `following`, m and rad, above 0
};

enum class TrackerStatus {
  following,    ///< the tool is at the commanded pose, within the tolerance
  limited,      ///< a joint limit of this step leaves an error: see `limit` and `joint`
  singular,     ///< the error decreases slowly because the arm is near a singularity
  unreachable,  ///< no small motion of the joints brings the tool nearer to the commanded pose
};
std::string name(TrackerStatus status);

/// One step of a Tracker: the configuration at its end.
struct TrackerStep {
  Configuration q;         ///< rad or m, within the position limits
  Configuration velocity;  ///< of the step, rad/s or m/s: (q - the last q) / time_step
  TrackerStatus status = TrackerStatus::following;
  /// Of the tool at q from the commanded pose, within a command period from the pose on the line to
  /// it; in the task's rows.
  Deviation error;
  ServoLimit limit = ServoLimit::none;  ///< with the status `limited`: the limit
  /// With the status `limited`: the coordinate, from 0.
  std::optional<int> joint = std::nullopt;
  bool assumed = false;  ///< whether the limit is assumed
};

/// Writes `limited, limit velocity of joint 2 (assumed), error 0.01 m, 0.2 rad`, coordinates
/// counted from 1.
std::ostream& operator<<(std::ostream& out, const TrackerStep& step);

/// Follows commanded tool poses, as a hand controller sends them, in a control loop: poses in,
/// configurations out. Commands may jump, be out of reach or lead through singularities. For each
/// step of length h and the last velocity v,
///
///   |q̇_k| ≤ velocity limit                   |q̇_k - v_k| ≤ acceleration limit · h
///   q_k is within its position limits, and can stop within them at the acceleration limit
///
/// where unknown limits of velocity and acceleration are the assumed ones (motion_limits()). Jerk
/// is not limited.
///
/// Each step first continues the goal configuration g, which minimises the weighted error of the
/// task (Levenberg–Marquardt) within the position limits and, around the arm, within four times the
/// distance v²/2a in which each joint can stop. The arm then moves along the straight line in joint
/// space to g, at a velocity relative to that of g from which every joint can stop at g. Hence
///
/// - a command within the limits is reached at the end of each step, without lag;
/// - otherwise all joints lag together, and a command at rest is reached without overshoot; if it
///   stops at once, the joints pass it by v²/2a;
/// - the solution is the one continued from the start. It does not jump to another one, also where
///   only another one reaches the command;
/// - near a singularity the tool deviates from the command and continues; a redundant arm that was
///   stretched out towards commands beyond its reach may bend to the other side afterwards, and
///   stay where a limit prevents that; others return on the same side in most cases;
/// - a redundant arm moves away from its position limits while the tool moves (Liégeois 1977).
///
/// No step allocates. Equal commands give equal results. One object serves one loop.
class Tracker {
 public:
  /// Starts at rest at `start`. Throws Error for an invalid option, and when `start` does not fit
  /// the arm or is outside its position limits by more than position_slack.
  Tracker(const Arm& arm, const ConfigurationRef& start, const TrackerOptions& options = {});
  Tracker(const Tracker& other);
  Tracker(Tracker&& other) noexcept;  ///< `other` may then only be assigned to or destroyed
  Tracker& operator=(Tracker other) noexcept;
  ~Tracker();

  /// Advances by one time step towards the commanded pose of the tool in the world. The result is
  /// valid until the next call. Throws Error for a pose that is not a rigid motion, which changes
  /// nothing.
  const TrackerStep& step(const Pose& world_T_tool);

  /// Continues at rest from another configuration. Throws Error as the constructor does.
  void reset(const ConfigurationRef& q);

  const Configuration& configuration() const;  ///< q of the last step
  const Configuration& velocity() const;       ///< of the last step, zero at first

 private:
  std::unique_ptr<internal::TrackerLoop> loop_;
};

}  // namespace beeline
