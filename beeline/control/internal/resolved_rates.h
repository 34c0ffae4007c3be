#pragma once

#include <vector>

#include <beeline/control/internal/velocity_bounds.h>
#include <beeline/control/internal/six_rows.h>
#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// Joint velocities that do a command, as if only positions had limits.
struct Rates {
  Eigen::VectorXd velocity;  ///< does `share` of the command
  Eigen::VectorXd bend;      ///< how this velocity changes along the command's own way, per second
  double share = 1;          ///< below 1 only where `regular` is false
  bool regular = true;       ///< no direction of the tool's motion is lost
};

/// Resolved motion rates (Whitney 1969) without allocations: of all joint velocities that do the
/// command the least, weighed by the velocity limits (1 where there is none); lengths count in
/// units of the arm's reach. What a coordinate may not do for its position limit the others do,
/// where there are enough of them (after Flacco, De Luca & Khatib 2015).
///
/// At a singularity the tool's direction u that is lost moves no more in proportion to the joints,
/// but bends: along the null motion n it is u'' = curve n^2. A command along u is done by n where
/// the bend has its sign; where it has the other one the arm is stretched out: nothing is done. In
/// between, as with a wrist, n does not move the tool and turns u, until the command needs it no
/// more.
class ResolvedRates {
 public:
  ResolvedRates(const Arm& arm, const Task& task);

  /// q's Jacobian and the command, m/s and rad/s, are taken up. Returns whether something is asked.
  /// Throws Error when the command's rows are not finite.
  bool take(const ConfigurationRef& q, const Twist& command);

  /// `before` is the velocity of the arm, which breaks ties at a singularity.
  const Rates& solve(const ConfigurationRef& q, const std::vector<Room>& rooms,
                     const Eigen::VectorXd& before, double time_step);

  /// Takes from a motion of the joints all that moves the tool or a held coordinate.
  void keep_tool(Eigen::VectorXd& motion);

  /// How much of the command this velocity does: along its direction.
  double share_done(const Eigen::VectorXd& velocity) const;

  Eigen::VectorXd weight;  ///< velocity limits, or 1
  std::vector<char> held;  ///< coordinates that go as fast as their position limit lets them

 private:
  using Rows = SixByRoots::Rows;  ///< those that the task leaves out are zero

  Rows turn_along(const ConfigurationRef& q, const Eigen::VectorXd& velocity);
  bool solve_least_squares();
  bool solve_with_others(const std::vector<Room>& rooms);
  void fill_bend(const ConfigurationRef& q);
  double solve_singular(const ConfigurationRef& q, const Eigen::VectorXd& before, double time_step);
  bool fill_null_motion(Eigen::Index which);
  double turn_of_lost(const Rows& u) const;

  Arm arm_;
  Task task_;
  Rows scale_;  ///< one over the length that counts like a radian; 0 for rows left out
  Jacobian columns_;
  Jacobian rows_;  ///< columns_ times scale_ and the weights
  Rows command_;   ///< the rows asked for
  SixByRoots factors_;
  SixDirections directions_;
  Eigen::VectorXd way_;   ///< velocity / weight
  Eigen::VectorXd kept_;  ///< the way before one more coordinate was held; a place ahead
  Eigen::VectorXd null_;  ///< the motion that is lost, over the weights
  double ahead_ = 0;
  Rates rates_;
};

}  // namespace beeline::internal
