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
  /// Task rows that are followed; default: planar for a planar arm, else spatial.
  std::optional<Task> task = std::nullopt;
  double time_step = 1e-3;  ///< time between two steps, seconds, above 0
  /// Time between two different commands, seconds. The tool approaches each command in a straight
  /// line during this time, so that commands at a lower rate than the steps give a continuous
  /// motion, one period late. If commands differ at every step, it smooths their noise as a
  /// first-order filter with this time constant. With a period up to `time_step`, commands are
  /// followed at once.
  double command_period = 0;
  Deviation tolerance{1e-4, 1e-3};  ///< max error with the status `following`, m and rad, above 0
  const CollisionModel* model = nullptr;  ///< see ServoOptions
  double damper_gain = 10;                ///< see ServoOptions
};

enum class TrackerStatus {
  following,  ///< the tool is at the commanded pose, within the tolerance
  /// A limit of a joint or a clearance leaves an error in this step: see `limit`, `joint` and
  /// `bodies`.
  limited,
  singular,     ///< the error decreases slowly because the arm is near a singularity
  unreachable,  ///< no small motion of the joints brings the tool nearer to the commanded pose
};
std::string name(TrackerStatus status);

/// One step of a Tracker: the configuration at its end.
struct TrackerStep {
  Configuration q;  ///< configuration at the end of the step, rad or m, within the position limits
  /// Joint velocity of the step, rad/s or m/s: (q - the last q) / time_step.
  Configuration velocity;
  TrackerStatus status = TrackerStatus::following;
  /// Error of the tool at q in the task's rows: the deviation from the commanded pose or, within a
  /// command period, from the pose on the line to it.
  Deviation error;
  ServoLimit limit = ServoLimit::none;  ///< limit that leaves an error, with the status `limited`
  /// Coordinate of the limit, from 0, with the status `limited`.
  std::optional<int> joint = std::nullopt;
  bool assumed = false;  ///< whether the limit is assumed
  /// The two bodies with the limit `clearance`; the first is a link's.
  std::optional<BodyNames> bodies = std::nullopt;
  /// Whether the clearance is proved until a stop after this step; true without a model.
  bool proved = true;
};

/// Writes `limited, limit velocity of joint 2 (assumed), error 0.01 m, 0.2 rad`, coordinates
/// counted from 1; at the end `, not proved` if it is not.
std::ostream& operator<<(std::ostream& out, const TrackerStep& step);

/// Follows commanded tool poses, such as the poses of a hand controller, in a control loop. Its
/// input is poses, and its output is configurations. Commands may jump, be out of reach or lead
/// through singularities. For each step of length h and the last velocity v,
///
///   |q̇_k| ≤ velocity limit                   |q̇_k - v_k| ≤ acceleration limit · h
///   q_k is within its position limits, and can stop within them at the acceleration limit
///
/// Unknown limits of velocity and acceleration are assumed (motion_limits()). Jerk is not limited.
///
/// Each step first continues the goal configuration g. It minimises the weighted error of the task
/// (Levenberg–Marquardt) within the position limits, and within four times the distance v²/2a in
/// which each joint can stop around the arm. The arm then moves along the straight line in joint
/// space to g. Its velocity relative to the velocity of g is one from which every joint can stop at
/// g. Hence
///
/// - a command within the limits is reached at the end of each step, without lag;
/// - otherwise all joints lag together, and a command at rest is reached without overshoot; if it
///   stops at once, the joints pass it by v²/2a;
/// - the solution is the one continued from the start. It does not jump to another one, even if
///   only another one reaches the command;
/// - near a singularity the tool deviates from the command and continues. A redundant arm that was
///   stretched out towards commands beyond its reach may bend to the other side afterwards, and
///   stay there if a limit prevents its return; other arms return on the same side in most cases;
/// - a redundant arm moves away from its position limits while the tool moves (Liégeois 1977).
///
/// With a model, the arm keeps the clearances of the model as with Servo: the velocity towards g is
/// replaced by the nearest one, in the tool's motion, that the clearances admit. The tool slides
/// along a body towards the pose that is nearest to the command. It does not look for a way around.
///
/// No step allocates. Equal commands give equal results. One object serves one loop.
class Tracker {
 public:
  /// Starts at rest at `start`. Throws Error for an invalid option, and when `start` does not fit
  /// the arm or is outside its position limits by more than position_slack.
  Tracker(const Arm& arm, const ConfigurationRef& start, const TrackerOptions& options = {});
  Tracker(const Tracker& other);
  Tracker(Tracker&& other) noexcept;  ///< `other` can then only be assigned to or destroyed
  Tracker& operator=(Tracker other) noexcept;
  ~Tracker();

  /// Advances by one time step towards the commanded pose of the tool in the world. The result is
  /// valid until the next call. Throws Error for a pose that is not a rigid motion, and then
  /// changes nothing.
  const TrackerStep& step(const Pose& world_T_tool);

  /// Continues at rest from another configuration. Throws Error as the constructor does.
  void reset(const ConfigurationRef& q);

  const Configuration& configuration() const;  ///< configuration after the last step, rad or m
  const Configuration& velocity()
      const;  ///< joint velocity of the last step, rad/s or m/s, zero at first

 private:
  std::unique_ptr<internal::TrackerLoop> loop_;
};

}  // namespace beeline
