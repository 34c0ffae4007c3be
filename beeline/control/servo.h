#pragma once

#include <iosfwd>
#include <memory>
#include <optional>
#include <string>

#include <beeline/error.h>
#include <beeline/kinematics/task.h>

namespace beeline {

namespace internal {
class ServoLoop;
}

struct ServoOptions {
  /// Task rows that are controlled; default: planar for a planar arm, else spatial.
  std::optional<Task> task = std::nullopt;
  double time_step = 1e-3;  ///< time step of the control loop, seconds, above 0
  /// Decay rate of the error in step_towards(), 1/s, above 0 and at most 1 / time_step.
  double gain = 10;
  /// Max linear speed of the command in step_towards(), m/s, above 0.
  double linear_speed = Limits::none;
  /// Max angular speed of the command in step_towards(), rad/s, above 0.
  double angular_speed = Limits::none;
};

/// The limit that determines the scale of a step.
enum class ServoLimit {
  none,          ///< the command is achieved
  velocity,      ///< a joint's velocity limit
  acceleration,  ///< a joint's acceleration limit
  position,      ///< a joint must stop before its position limit
  singular,      ///< the arm is at or near a singularity
};
std::string name(ServoLimit limit);

/// One step of a Servo.
struct ServoStep {
  double scale = 1;  ///< α: the fraction of the command that the step achieves, in [0, 1]
  ServoLimit limit = ServoLimit::none;      ///< the limit that determines the scale
  std::optional<int> joint = std::nullopt;  ///< coordinate whose limit determines the scale, from 0
};

/// Writes `scale 0.5, limit velocity of joint 2`, coordinates counted from 1.
std::ostream& operator<<(std::ostream& out, const ServoStep& step);

/// Cartesian velocity control: converts tool velocities into joint velocities within the arm's
/// limits, in a control loop. Each step solves
///
///   maximise    α ∈ [0, 1]
///   subject to  J q̇ = α v
///               |q̇_k| ≤ velocity limit
///               |q̇_k − last q̇_k| ≤ acceleration limit · time_step
///               q_k can stop within its position limits at the acceleration limit
///               half the acceleration limit suffices for J̇ q̇ as the motion continues
///
/// The tool keeps the direction of the command v and slows down; α is never negative. Among the
/// solutions of J q̇ = α v, q̇ has the least norm weighted by the velocity limits. A redundant arm
/// adds null-space motion away from the position limits (Liégeois 1977). If the last velocity
/// leaves no feasible q̇, for example after a change of the command, q̇ changes towards the command
/// as fast as the acceleration limits allow.
///
/// No step allocates. One object serves one loop; it keeps the last velocity.
class Servo {
 public:
  /// Throws Error for an invalid option.
  explicit Servo(const Arm& arm, const ServoOptions& options = {});
  Servo(const Servo& other);
  Servo(Servo&& other) noexcept;  ///< `other` can then only be assigned to or destroyed
  Servo& operator=(Servo other) noexcept;
  ~Servo();

  /// Converts a command into joint velocities. The command is a tool velocity in the task's frame
  /// (world or tool axes), m/s and rad/s; rows that the task excludes are ignored. Writes dof
  /// numbers into `velocity`, rad/s or m/s. Throws Error when the size of q or `velocity` is wrong,
  /// or a number is not finite.
  ServoStep step(const ConfigurationRef& q, const Twist& command,
                 Eigen::Ref<Eigen::VectorXd> velocity);

  /// Moves towards a pose with the command gain · (pose error), bounded by the options' speeds.
  ServoStep step_towards(const ConfigurationRef& q, const Pose& world_T_tool,
                         Eigen::Ref<Eigen::VectorXd> velocity);

  /// Sets the arm's current velocity, rad/s or m/s. It is zero at first.
  void set_velocity(const ConfigurationRef& velocity);

 private:
  std::unique_ptr<internal::ServoLoop> loop_;
};

}  // namespace beeline
