#pragma once

#include <array>
#include <optional>
#include <string_view>

#include <beeline/collision/collision_model.h>
#include <beeline/control/internal/bounded_list.h>
#include <beeline/control/internal/constrained_velocity.h>
#include <beeline/control/internal/stop_proof.h>
#include <beeline/control/internal/velocity_bounds.h>
#include <beeline/control/internal/weighted_task.h>
#include <beeline/inverse/numerical/bounds.h>

namespace beeline::internal {

/// The cause for which a velocity was changed most: a pair of bodies, or a joint that has to stop
/// before its position limit. Without both, the velocity stays as it is.
struct VelocityChange {
  std::optional<std::size_t> pair = std::nullopt;  ///< index for names()
  std::optional<int> joint = std::nullopt;         ///< coordinate
  bool proved = true;  ///< whether the clearances are proved for the step and the stop after it
};

/// Keeps the clearance of a CollisionModel in a control loop.
///
/// The invariant: from each configuration, the arm can stop on a straight line in joint space that
/// is proved to keep every clearance. With the velocity v at q the joints move to q + h v, and then
/// stop in proportion, v falling by the same fraction of itself in each step as the acceleration
/// limits allow; the line ends at q + σ v (stopping_time()). A pair of bodies that is closer than
/// its clearance at q must not come closer on the line.
///
/// A velocity that the proof does not admit is replaced by the nearest one, in the tool's motion,
/// that satisfies a velocity damper for each pair in reach (Faverjon and Tournassoud 1987): the
/// distance d falls at most by gain · (d − clearance), and to first order about the part of the
/// line that comes closest, the line keeps the clearance. If the proof does not admit it either, it
/// is mixed with the velocity that stops the arm on the line of the last step, down to this
/// velocity itself, which is proved already if the arm is where the last step left it.
class VelocityDamper {
 public:
  /// Throws Error if the model has another arm, and for a gain that is not above 0 and at most
  /// 1 / time_step.
  VelocityDamper(const Arm& arm, const Task& task, const CollisionModel& model, double time_step,
                 double gain);

  /// Changes the velocity of this step, which is within the box, so that the clearance is kept. If
  /// it has to change, it becomes the admitted velocity nearest to `wanted`, which may be beyond
  /// the box, in this step and in the next ones until `wanted` is reached: a velocity that keeps
  /// the direction of the command within the acceleration limits could not leave the direction of a
  /// wall. `last` is the velocity of the step before.
  VelocityChange keep_clearance(const ConfigurationRef& q, const Eigen::VectorXd& last,
                                const VelocityBox& box, const Eigen::VectorXd& wanted,
                                Eigen::VectorXd& velocity);

  /// Continues from another configuration as a new object does.
  void reset();

  /// Whether a clearance has changed the velocity, and the wanted one has not been reached since.
  bool is_changing() const { return is_changing_; }

  /// Returns the names of the bodies of a pair. They live as long as the model.
  std::array<std::string_view, 2> names(std::size_t pair) const { return proof_.names(pair); }

 private:
  double stopping_time(const Eigen::VectorXd& velocity) const;
  double braking_fraction(const Eigen::VectorXd& velocity) const;
  std::optional<int> joint_beyond_limits(const ConfigurationRef& q,
                                         const Eigen::VectorXd& velocity) const;
  std::optional<int> stop_within_limits(const ConfigurationRef& q, Eigen::VectorXd& velocity) const;

  bool prove(const ConfigurationRef& q, const Eigen::VectorXd& velocity, StopProof::Effort effort);
  void fill_rows(const ConfigurationRef& q, const Eigen::VectorXd& about);
  void project(const ConfigurationRef& q, const VelocityBox& box, const Eigen::VectorXd& wanted);
  VelocityChange admit(const ConfigurationRef& q, const VelocityBox& box,
                       const Eigen::VectorXd& wanted, Eigen::VectorXd& velocity);
  bool is_brake_proved(const ConfigurationRef& q, const Eigen::VectorXd& last);
  bool is_reached(const Eigen::VectorXd& wanted) const;

  Arm arm_;
  double time_step_, gain_;
  Bounds positions_;
  WeightedTask task_;
  StopProof proof_;
  Eigen::VectorXd line_;
  bool is_changing_ = false;
  bool last_proved_ = false;            ///< whether the last step was proved
  Eigen::VectorXd expected_, stepped_;  ///< where the last step leads, and its velocity
  Eigen::VectorXd brake_, trial_, gradient_, row_;
  ConstrainedVelocity constrained_;
  BoundedList<std::size_t> row_pairs_;
  Eigen::MatrixXd weights_;
  VelocityBox scaled_;
};

}  // namespace beeline::internal
