#pragma once

#include <optional>
#include <vector>

#include <beeline/control/internal/resolved_rates.h>

namespace beeline {

struct ServoOptions {
  std::optional<Task> task = std::nullopt;  ///< default: planar for a planar arm, else spatial
  double time_step = 1e-3;                  ///< seconds between two steps
  double gain = 10;  ///< 1/s: how fast step_towards() lets the error fall; at most 1/time_step
  double linear_speed = Limits::none;   ///< most speed that step_towards() asks for, m/s
  double angular_speed = Limits::none;  ///< and rad/s
};

struct ServoStep {
  double share = 1;  ///< of the commanded motion that is done, in [0, 1]
  ServoLimit limit = ServoLimit::none;
  int joint = -1;  ///< the coordinate whose limit it is
};

/// Turns the tool motion asked for, step by step, into joint velocities that keep the arm's limits:
/// for a control loop. No step allocates. One object for each loop; it remembers the velocity that
/// it gave last, from which accelerations are counted.
///
/// All joint velocities that do the command (ResolvedRates) are scaled by the one share that the
/// tightest limit leaves, so the tool keeps its direction and slows down, towards a singularity in
/// proportion to what the limits allow, and never turns back. The share is such that joints can
/// stop before their ends and that accelerations suffice for the way to go on as it bends. After a
/// change of the command the arm takes up the new direction as fast as accelerations let it.
/// Joints to spare move away from their limits (Liegeois 1977).
class Servo {
 public:
  /// Throws Error for an option that makes no sense.
  explicit Servo(const Arm& arm, const ServoOptions& options = {});

  /// The command is a velocity in the task's frame (base or tool axes), m/s and rad/s; rows that
  /// the task leaves out are not looked at. Writes dof numbers into `velocity`.
  /// Throws Error when q or `velocity` do not fit, or a number is not finite.
  ServoStep step(const ConfigurationRef& q, const Twist& command,
                 Eigen::Ref<Eigen::VectorXd> velocity);

  /// The same for a pose to go to: the command is gain * (what leads to world_T_tool).
  ServoStep step_towards(const ConfigurationRef& q, const Pose& world_T_tool,
                         Eigen::Ref<Eigen::VectorXd> velocity);

  /// The arm moves with this velocity: zero at the beginning.
  void set_velocity(const ConfigurationRef& velocity);

 private:
  double share_in_rooms(const Rates& rates, ServoStep& result) const;
  double share_for_bend(const Rates& rates, double share, ServoStep& result) const;
  double max_change(Eigen::Index k) const;
  void fill_spare_motion(const ConfigurationRef& q, const Rates& rates, double share);
  void keep_accelerations(const Rates& rates, double share, double most, ServoStep& result);

  Arm arm_;
  Task task_;
  ServoOptions options_;
  internal::Bounds bounds_;
  ResolvedRates solver_;
  std::vector<Room> rooms_;
  Eigen::VectorXd spare_, drift_;  ///< motions that leave the tool at rest: wanted and there
  Eigen::VectorXd next_, before_;  ///< velocities of this step and the last
};

}  // namespace beeline
