#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <beeline/inverse/numerical/linear_model.h>
#include <beeline/inverse/numerical/singular_solution.h>
#include <beeline/math/decompositions.h>
#include <beeline/math/six_row_svd.h>

namespace beeline::internal {
namespace {

/// Returns the columns of the derivative of J with respect to coordinate k, by a central
/// difference. Its error, 1e-10, slows the convergence by as much.
Jacobian jacobian_change(const NumericalGoal& goal, const Configuration& q, int k) {
  constexpr double h = 1e-5;  // radians, or units of length
  LinearModel above(q.size()), below(q.size());
  Configuration moved = q;
  moved[k] = q[k] + h * goal.units[k];
  linearise(goal, moved, above);
  moved[k] = q[k] - h * goal.units[k];
  linearise(goal, moved, below);
  return (above.columns - below.columns) / (2 * h);
}

/// Returns Newton's step, in the units of the goal. Singular values below this fraction of the
/// largest count as lost.
Eigen::VectorXd newton_step(const NumericalGoal& goal, const Configuration& q,
                            const LinearModel& at, double nearly_lost) {
  const Eigen::Index n = q.size();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(at.columns,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::VectorXd& sigma = svd.singularValues();
  Eigen::Index rank = sigma.size() - 1;
  while (rank > 1 && sigma[rank - 1] < nearly_lost * sigma[0]) --rank;
  const Eigen::Index lost = sigma.size() - rank, still = n - rank;
  const Eigen::MatrixXd moving = svd.matrixU().leftCols(rank).transpose();
  const Eigen::MatrixXd null_space = svd.matrixV().rightCols(still);
  Eigen::MatrixXd a(rank + lost * still, n);
  Eigen::VectorXd b(a.rows());
  a.topRows(rank) = moving * at.columns;
  b.head(rank) = moving * at.error;
  for (Eigen::Index i = 0; i < lost; ++i) {
    const Twist u = svd.matrixU().col(rank + i);
    b.segment(rank + i * still, still) = -null_space.transpose() * (at.columns.transpose() * u);
  }
  for (int k = 0; k < n; ++k) {
    const Jacobian change = jacobian_change(goal, q, k);
    for (Eigen::Index i = 0; i < lost; ++i) {
      const Twist u = svd.matrixU().col(rank + i);
      a.block(rank + i * still, k, still, 1) = null_space.transpose() * (change.transpose() * u);
    }
  }
  if (!a.allFinite()) return Eigen::VectorXd::Constant(n, std::numeric_limits<double>::quiet_NaN());
  return Eigen::JacobiSVD<Eigen::MatrixXd>(a, Eigen::ComputeThinU | Eigen::ComputeThinV).solve(b);
}

/// Runs Newton's method with one threshold for lost singular values.
NumericalResult run_newton(const NumericalGoal& goal, const Configuration& start,
                           double nearly_lost, const NumericalOptions& options) {
  constexpr int max_steps = 12;  // a start that needs more is not near
  constexpr double longest = 0.5;
  LinearModel at(start.size());
  NumericalResult run;
  Configuration q = clamped(goal.bounds, start);
  for (double least = Limits::none;; ++run.iterations) {
    linearise(goal, q, at);
    keep_best(q, at, options, least, run);
    if (run.converged || run.iterations == std::min(max_steps, options.max_iterations) ||
        !std::isfinite(at.cost) || options.budget.ended()) {
      return run;
    }
    Eigen::VectorXd step = newton_step(goal, q, at, nearly_lost);
    if (!step.allFinite()) return run;
    if (step.norm() > longest) step *= longest / step.norm();
    q = clamped(goal.bounds, q + goal.units.cwiseProduct(step));
  }
}

/// Solves for a singular configuration. With the Jacobian J = sum sigma_i u_i v_i^T, Newton's
/// method on
///   u_i . e = 0                   for the directions i in which the tool moves,
///   v_j . (u_i . J)^T = 0         for the others, over the v_j of those and of the null space,
/// converges quadratically from a `start` near it, because the second equations are linear in the
/// distance. Directions count as lost where sigma_i is below 2 % of the largest, or if that fails
/// below 0.2 %: a small singular value may belong to a second singularity nearby that the solution
/// does not have.
NumericalResult singular_configuration(const NumericalGoal& goal, const Configuration& start,
                                       const NumericalOptions& options) {
  NumericalResult best;
  int iterations = 0;
  for (const double nearly_lost : {0.02, 0.002}) {
    NumericalResult run = run_newton(goal, start, nearly_lost, options);
    iterations += run.iterations;
    const auto size = [](const Deviation& e) { return std::max(e.position, e.orientation); };
    if (best.q.size() == 0 || size(run.error) < size(best.error)) best = std::move(run);
    if (best.converged || options.budget.ended(0)) break;
  }
  best.iterations = iterations;
  return best;
}

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

/// Solves by Gauss-Newton steps that keep the singular values of J to rounding. Each step is
///   dq = sum over i of clamp(u_i . e / sigma_i, +-0.3 rad) v_i,
/// over the directions whose error u_i . e exceeds the tolerance, subject to the bounds. Steps are
/// taken whether or not they reduce |e|: at a solution where the Jacobian loses rank, Gauss-Newton
/// halves the distance, but not in every step. A step takes about ten times as long as one of
/// levenberg_marquardt().
NumericalResult singular_gauss_newton(const NumericalGoal& goal, const Configuration& start,
                                      const NumericalOptions& options) {
  constexpr int max_unchanged = 120;  // steps in which |e|^2 does not halve
  SingularSteps steps(goal, options.tolerance);
  LinearModel at(start.size());
  NumericalResult run;
  Configuration q = clamped(goal.bounds, start);
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

}  // namespace

NumericalResult singular_solution(const Arm& arm, const Pose& world_T_tool, const Task& task,
                                  const Bounds& bounds, const Configuration& start,
                                  const NumericalOptions& options) {
  const NumericalGoal goal = numerical_goal(arm, world_T_tool, task, bounds, start, options);
  const NumericalResult first = singular_configuration(goal, start, options);
  if (first.converged) return first;
  NumericalResult second = singular_gauss_newton(goal, first.q, options);
  second.iterations += first.iterations;
  return second;
}

}  // namespace beeline::internal
