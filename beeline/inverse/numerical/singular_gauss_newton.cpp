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
      : goal_(goal),
        solved_(0.1 * tolerance / std::max(1.0, goal.length)),
        bounded_(goal.arm.dof()),
        wanted_(goal.arm.dof()) {
    svd_.scaled_right.resize(goal.arm.dof(), 6);
  }

  /// Returns q after a step within the bounds.
  Configuration after_step(const Configuration& q, const LinearModel& at) {
    bounded_.begin(at);
    do {  // at least one joint stops in each round
      compute_wanted();
    } while (bounded_.take(goal_, q, [this](int k) { return wanted_[k]; }));
    return clamped(goal_.bounds, q + goal_.units.cwiseProduct(bounded_.step));
  }

 private:
  /// Computes the step that ignores the bounds, of the joints that are not held.
  void compute_wanted() {
    constexpr double longest = 0.3;  // radians, or units of length, along each singular direction
    svd_.compute(bounded_.free);
    wanted_.setZero();
    const double rounding = 1e-15 * svd_.singular_values.maxCoeff();
    for (int i = 0; i < 6; ++i) {
      const double sigma = svd_.singular_values[i], along = svd_.left.col(i).dot(bounded_.error);
      if (std::abs(along) <= solved_ || sigma <= rounding) continue;
      const double length = std::clamp(along / sigma, -longest, longest);
      wanted_ += svd_.scaled_right.col(i) * (length / sigma);
    }
  }

  const NumericalGoal& goal_;
  double solved_;  ///< errors up to this count as zero
  BoundedStep bounded_;
  SixRowSvd svd_;
  Eigen::VectorXd wanted_;
};

}  // namespace

NumericalResult singular_gauss_newton(const Arm& arm, const Pose& world_T_tool, const Task& task,
                                      const Bounds& bounds, const Configuration& start,
                                      const NumericalOptions& options) {
  constexpr int max_unchanged = 120;  // steps in which |e|^2 does not halve
  const NumericalGoal goal = numerical_goal(arm, world_T_tool, task, bounds, start, options);
  SingularSteps steps(goal, options.tolerance);
  LinearModel at(arm.dof());
  NumericalResult run;
  Configuration q = clamped(bounds, start);
  double least = Limits::none, milestone = Limits::none;
  for (int unchanged = 0;; ++run.iterations, ++unchanged) {
    linearise(goal, q, at);
    keep_best(q, at, options, least, run);
    if (at.cost < milestone / 2) {
      milestone = at.cost;
      unchanged = 0;
    }
    if (run.converged || run.iterations == options.max_iterations || unchanged > max_unchanged ||
        options.budget.ended()) {
      return run;
    }
    q = steps.after_step(q, at);
  }
}

}  // namespace beeline::internal
