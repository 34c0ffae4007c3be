#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/kinematics/task.h>

namespace beeline {

/// Measures of a Jacobian's distance from singularity (Lynch & Park, *Modern Robotics*, 2017,
/// section 5.4).
struct ManipulabilityMeasures {
  Eigen::VectorXd singular_values;  ///< singular values in decreasing order, (min(m, n),)
  /// The product of the singular values, sqrt(det(J J^T)); 0 with fewer columns than rows
  /// (Yoshikawa, 1985).
  double manipulability = 0;
  /// The condition number: largest over smallest singular value; infinite at a singularity. Branch
  /// and PathMotion have its reciprocal, the inverse condition number.
  double condition = 1;
};

/// Returns the measures of a Jacobian, or of some of its rows. Linear and angular rows have
/// different units: scale one kind first if the condition number matters (task_jacobian()). Throws
/// Error for an empty matrix, one of more than six rows, or one that is not finite.
ManipulabilityMeasures manipulability_measures(const Eigen::Ref<const Eigen::MatrixXd>& jacobian);

/// The velocities J dq of all joint velocities with |dq| = 1, and the forces F of all joint torques
/// with |J^T F| = 1 (Lynch & Park, section 5.4). Both ellipsoids have the same axes.
struct ManipulabilityEllipsoids {
  Eigen::MatrixXd axes;      ///< principal axes: orthonormal columns, as many as the rows of J
  Eigen::VectorXd velocity;  ///< semi-axes, in decreasing order; 0 along which nothing moves
  /// Semi-axes of the forces, the reciprocals of `velocity`; infinite if it is 0.
  Eigen::VectorXd force;
};

/// Returns the ellipsoids of a Jacobian, or of some of its rows; take linear or angular rows, as
/// their units differ. Throws Error as manipulability_measures() does.
ManipulabilityEllipsoids manipulability_ellipsoids(
    const Eigen::Ref<const Eigen::MatrixXd>& jacobian);

/// Yoshikawa's measure and its derivatives.
struct ManipulabilityGradient {
  double manipulability = 0;  ///< Yoshikawa's measure, as in ManipulabilityMeasures
  /// Derivatives of the measure with respect to the coordinates, per radian or metre. Zero if the
  /// measure is 0, because in general it has no derivatives there.
  Configuration gradient;
};

/// Returns the manipulability of the task's rows and its gradient: of all rows Task::spatial(), of
/// the translational ones Task::position(), of the rotational ones the mask 000111. The gradient is
/// w tr(J^+ dJ/dq), by Jacobi's formula for the derivative of det(J J^T). Throws Error as
/// jacobian() and check_task() do.
ManipulabilityGradient manipulability_gradient(const Arm& arm, const ConfigurationRef& q,
                                               const Task& task);
/// The same for default_task(): the planar rows of a planar arm, all six rows of any other arm.
ManipulabilityGradient manipulability_gradient(const Arm& arm, const ConfigurationRef& q);

/// The outcome of joint_rates().
enum class RatesStatus {
  solved,         ///< the rates move the tool at the velocity
  damped,         ///< the rates are the damped least-squares solution
  singular,       ///< the velocity has a component in a direction that is lost at a singularity
  too_few_joints  ///< the velocity has a component in a direction that no joint moves
};
std::string name(RatesStatus status);

struct JointRatesOptions {
  /// The rows of the velocity: spatial, position, planar, direction, approach:xy, a mask such as
  /// 111010, of a planar arm also 110 for x and y; default: default_task().
  std::optional<Task> task = std::nullopt;
  /// Frame of the velocity, as for jacobian(); default: the task's frame.
  std::optional<Frame> frame = std::nullopt;
  /// The damping lambda of damped least squares, 0 or more: minimise |J dq - v|^2 + lambda^2
  /// |dq|^2. With 0 the least |dq| among the minimisers of |J dq - v|.
  double damping = 0;
};

/// A joint rate above the velocity limit of its joint.
struct RateExcess {
  int coordinate = 0;  ///< index of the coordinate, from 0
  double rate = 0;     ///< joint rate, rad/s or m/s
  double limit = 0;    ///< velocity limit, rad/s or m/s
};

/// Joint rates dq of a velocity v of the tool. All velocities of the tool are in the order of v, in
/// m/s and rad/s.
struct JointRates {
  RatesStatus status = RatesStatus::solved;
  Configuration rates;  ///< joint rates dq, rad/s or m/s, (n,); if not solved, the nearest
  Eigen::VectorXd tool_velocity;  ///< velocity J dq of the tool, (m,)
  double residual = 0;            ///< |J dq - v|, m/s and rad/s
  bool singular = false;          ///< whether J has a smaller rank than its size allows
  /// Orthonormal basis, one velocity in each column, of the complement of the range of J.
  Eigen::MatrixXd lost_directions;
  std::vector<RateExcess> excesses = {};  ///< rates above their limits, by coordinate
  /// Coordinates whose velocity limit is not known, from 0: their rates are not compared.
  std::vector<int> without_limit = {};
  /// The largest factor of v, at most 1, with which all rates keep the known velocity limits.
  double scale = 1;
  Reason reason = {};  ///< why; none if solved or damped

  /// Whether the rates are solved or damped.
  explicit operator bool() const {
    return status == RatesStatus::solved || status == RatesStatus::damped;
  }
};

/// Computes the joint rates that move the tool at the velocity v, which has the task's rows:
/// J dq = v (Whitney, "Resolved motion rate control", 1969). Singular values up to 1e-8 of the
/// largest count as zero. Throws Error as jacobian() does; for a velocity that is not finite or has
/// another number of rows; and for a task in the tool's axes with another frame.
JointRates joint_rates(const Arm& arm, const ConfigurationRef& q, const Eigen::VectorXd& velocity,
                       const JointRatesOptions& options = {});

}  // namespace beeline
