#include <algorithm>
#include <cmath>
#include <utility>

#include <beeline/inverse/numerical/linear_model.h>
#include <beeline/inverse/numerical/singular_gauss_newton.h>
#include <beeline/math/six_row_svd.h>

namespace beeline::internal {
namespace {

/// The steps of one run, with their buffers.
class SingularSteps {
 public:
  SingularSteps(const NumericalGoal& goal, double tolerance)
      : goal_(goal), solved_(0.1 * tolerance / std::max(1.0, goal.length)) {
    const int dof = goal.arm.dof();
    svd_.scaled_right.resize(dof, 6);
    wanted_.resize(dof);
    step_.resize(dof);
    held_.resize(static_cast<std::size_t>(dof));
  }

  /// Returns q after a step within the bounds. Joints that would pass a bound stop there, and the
  /// step of the others is computed again for the remaining error.
  Configuration after_step(const Configuration& q, const LinearModel& at) {
    free_ = at.columns;
    std::fill(held_.begin(), held_.end(), 0);
    Twist error = at.error;
    const Bounds& bounds = goal_.bounds;
    for (bool stopped = true; stopped;) {  // at least one joint stops in each round
      compute_wanted(error);
      stopped = false;
      for (int k = 0; k < q.size(); ++k) {
        char& held = held_[static_cast<std::size_t>(k)];
        if (held) continue;
        step_[k] = std::clamp(wanted_[k], (bounds.lower[k] - q[k]) / goal_.units[k],
                              (bounds.upper[k] - q[k]) / goal_.units[k]);
        if (step_[k] == wanted_[k]) continue;
        held = 1;
        stopped = true;
        error -= free_.col(k) * step_[k];
        free_.col(k).setZero();
      }
    }
    return (q + goal_.units.cwiseProduct(step_)).cwiseMax(bounds.lower).cwiseMin(bounds.upper);
  }

 private:
  /// Computes the step that ignores the bounds, of the joints in free_.
  void compute_wanted(const Twist& error) {
    constexpr double longest = 0.3;  // radians, or units of length, along each singular direction
    svd_.compute(free_);
    wanted_.setZero();
    const double rounding = 1e-15 * svd_.singular_values.maxCoeff();
    for (int i = 0; i < 6; ++i) {
      const double sigma = svd_.singular_values[i], along = svd_.left.col(i).dot(error);
      if (std::abs(along) <= solved_ || sigma <= rounding) continue;
      const double length = std::clamp(along / sigma, -longest, longest);
      wanted_ += svd_.scaled_right.col(i) * (length / sigma);
    }
  }

  const NumericalGoal& goal_;
  double solved_;  ///< errors up to this count as zero
  Jacobian free_;  ///< the columns of the joints that are not held at a bound
  SixRowSvd svd_;
  Eigen::VectorXd wanted_, step_;
  std::vector<char> held_;
};

}  // namespace

NumericalResult singular_gauss_newton(const Arm& arm, const Pose& world_T_tool, const Task& task,
                                      const Bounds& bounds, const Configuration& start,
                                      const NumericalOptions& options) {
  constexpr int max_unchanged = 120;  // steps in which |e|^2 does not halve
  check_configuration(arm, start);
  const NumericalGoal goal = numerical_goal(arm, world_T_tool, task, bounds, options);
  SingularSteps steps(goal, options.tolerance);
  LinearModel at;
  at.columns.resize(6, arm.dof());
  NumericalResult run;
  Configuration q = start.cwiseMax(bounds.lower).cwiseMin(bounds.upper);
  double least = Limits::none, milestone = Limits::none;
  for (int unchanged = 0;; ++run.iterations, ++unchanged) {
    linearise(goal, q, at);
    if (at.cost < least) {
      least = at.cost;
      run.q = q;
      run.error = at.deviation;
      run.converged =
          run.error.position <= options.tolerance && run.error.orientation <= options.tolerance;
    }
    if (at.cost < milestone / 2) {
      milestone = at.cost;
      unchanged = 0;
    }
    if (run.converged || run.iterations == options.max_iterations || unchanged > max_unchanged ||
        ended(options.budget)) {
      return run;
    }
    q = steps.after_step(q, at);
  }
}

}  // namespace beeline::internal
