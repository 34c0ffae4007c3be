#pragma once

#include <array>
#include <iosfwd>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <beeline/collision/collision_model.h>
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
  /// Shapes of the arm in a scene, whose clearances the loop keeps; null: none. It must outlive the
  /// loop. Its arm has the same links and base; the limits of the loop's arm count.
  const CollisionModel* model = nullptr;
  /// Max rate at which a distance falls towards its clearance, relative to the distance that is
  /// left, 1/s, above 0 and at most 1 / time_step. Used with a model.
  double damper_gain = 10;
};

/// The limit that determines the scale of a step.
enum class ServoLimit {
  none,          ///< the command is achieved
  velocity,      ///< a joint's velocity limit
  acceleration,  ///< a joint's acceleration limit
  position,      ///< a joint must stop before its position limit
  singular,      ///< the arm is at or near a singularity
  clearance,     ///< two bodies must keep their clearance
};
std::string name(ServoLimit limit);

/// The names of two bodies of a CollisionModel, which owns them.
using BodyNames = std::array<std::string_view, 2>;

/// One step of a Servo.
struct ServoStep {
  /// α: the fraction of the command that the step achieves, in [0, 1]. With the limit
  /// `acceleration`, while the velocity still changes, the fraction that it approaches.
  double scale = 1;
  ServoLimit limit = ServoLimit::none;      ///< the limit that determines the scale
  std::optional<int> joint = std::nullopt;  ///< coordinate whose limit determines the scale, from 0
  /// The two bodies with the limit `clearance`; the first is a link's.
  std::optional<BodyNames> bodies = std::nullopt;
  /// Whether the clearance is proved until a stop after this step; true without a model.
  bool proved = true;
};

/// Writes `scale 0.5, limit velocity of joint 2`, coordinates counted from 1, or
/// `scale 0.5, limit clearance of hand and wall`; at the end `, not proved` if it is not.
std::ostream& operator<<(std::ostream& out, const ServoStep& step);

/// Cartesian velocity control: converts tool velocities into joint velocities within the arm's
/// limits, in a control loop. Each step solves
///
///   q̇ = α q̇_1 + null-space motion, so that J q̇ = α v,
///   with J q̇_1 = v and the largest α ∈ [0, 1] for which
///               |q̇_k| ≤ velocity limit
///               |q̇_k − last q̇_k| ≤ acceleration limit · time_step
///               q_k can stop within its position limits at the acceleration limit
///               half the acceleration limit suffices for J̇ q̇ as the motion continues
///
/// The tool keeps the direction of the command v and slows down; α is never negative. Among the
/// solutions of J q̇_1 = v, q̇_1 has the least norm weighted by the velocity limits; of a redundant
/// arm another solution may permit a larger α. A redundant arm adds null-space motion away from the
/// position limits (Liégeois 1977). If the last velocity
/// leaves no feasible q̇, for example after a change of the command, q̇ changes towards the command
/// as fast as the acceleration limits allow.
///
/// With a model, the arm keeps the clearances of the model, and it moves freely along and away from
/// the bodies. The solution above is replaced, if necessary, by the velocity nearest to it in the
/// tool's motion with which each distance d falls at most by damper_gain · (d − clearance)
/// (velocity damper, Faverjon and Tournassoud 1987) and the arm can stop in front of the clearance.
/// While the arm brakes because no such velocity is found, d may fall faster than by the damper.
///
/// - If the joints move linearly by q̇ · time_step from each step to the next, no distance falls
///   below its clearance, between the steps too. It is proved in each step for the motion to the
///   next one and the stop after it; a velocity that is not proved is not used. If the joints do
///   otherwise, each step proves what follows from the q that it gets, and brakes if it cannot:
///   if the stop is not proved either, ServoStep::proved is false.
///   Without acceleration limits, the stop after the motion takes one step, as q̇ may jump to zero.
/// - A pair of bodies that is below its clearance does not come closer: its distance along the
///   direction between its nearest points does not fall. Of bodies that overlap, this direction is
///   the one in which the model finds that they separate soonest, and how far they overlap along it
///   does not grow; they may overlap more in other directions. The arm can move out.
/// - The tool may leave the commanded direction: it slides along a body. `scale` is the part of the
///   command that is left.
/// - All joints stop in the same time, so that the arm stops on a straight line in joint space. In
///   front of position limits they move slower than without a model.
///
/// No step allocates. One object serves one loop; it keeps the last velocity.
class Servo {
 public:
  /// Throws Error for an invalid option, and for a model of another arm.
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

  /// Sets the arm's current velocity, rad/s or m/s. It is zero at first. Throws Error, and keeps
  /// the last velocity, when the size is wrong, a number is not finite, or a velocity exceeds its
  /// joint's limit by more than a millionth: the steps after it would exceed the limit too. Clamp a
  /// measured velocity to the limits first.
  void set_velocity(const ConfigurationRef& velocity);

 private:
  std::unique_ptr<internal::ServoLoop> loop_;
};

}  // namespace beeline
