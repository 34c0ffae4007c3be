#pragma once

#include <beeline/control/internal/bounded_least_squares.h>
#include <beeline/control/internal/weighted_task.h>
#include <beeline/inverse/numerical/bounds.h>

namespace beeline::internal {

/// How an approach to a pose has ended.
struct GoalStatus {
  Deviation error;             ///< task error at the goal
  bool stationary = false;     ///< no small change within the box reduces the error
  Eigen::Index blocking = -1;  ///< the coordinate whose bound prevents the largest reduction
  bool upwards = false;        ///< that bound is the upper one
};

/// Continues a configuration towards commanded poses, within boxes of configurations: minimises
///   |c(g)|^2,  c = S (task error at g)      (scales S and weights W of weighted_task.h)
/// by Levenberg–Marquardt steps (Marquardt 1963) from the last result, without allocations. Each
/// step is a BoundedLeastSquares. A step that passes the minimum of the error along it is rejected
/// and the damping increased.
class GoalSolver {
 public:
  using Rows = WeightedTask::Rows;

  GoalSolver(const Arm& arm, const Task& task);

  void reset(const ConfigurationRef& q);

  /// Moves the goal towards the pose. Throws Error, and changes nothing, when the error is not
  /// finite or too large.
  GoalStatus approach(const Pose& world_T_tool, const Eigen::VectorXd& lower,
                      const Eigen::VectorXd& upper);

  const Configuration& goal() const { return goal_; }

 private:
  enum class StepOutcome { yes, rejected, none };

  double evaluate_trial(const Pose& world_T_tool);
  void accept_trial(double cost);
  void fill_step(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper);
  StepOutcome improve(const Pose& world_T_tool, const Eigen::VectorXd& lower,
                      const Eigen::VectorXd& upper);
  double determinant(const Jacobian& a) const;
  bool fill_null_direction(double damping);
  double cost_on_same_side(double cost, const Pose& world_T_tool);
  bool leave_saddle(const Pose& world_T_tool, const Eigen::VectorXd& lower,
                    const Eigen::VectorXd& upper);
  GoalStatus status(bool stationary, const Eigen::VectorXd& lower,
                    const Eigen::VectorXd& upper) const;

  WeightedTask task_;
  Task rows_;
  Bounds positions_;
  bool redundant_;
  BoundedLeastSquares least_squares_;
  Configuration goal_, trial_;
  Configuration crossed_;          ///< trial_ on the other side of a singularity
  Jacobian a_;                     ///< A at the goal
  Rows c_;                         ///< c at the goal
  Twist error_, trial_error_;      ///< task error at the goal and at trial_, m and rad
  double cost_ = 0;                ///< |c|^2
  double damping_ = 0;             ///< damping of the next step
  Eigen::VectorXd x_;              ///< the weighted step
  Eigen::VectorXd bias_;           ///< its part in the null space
  Eigen::VectorXd lower_, upper_;  ///< its bounds
};

}  // namespace beeline::internal
