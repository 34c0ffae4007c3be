#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>

#include <beeline/inverse/internal/nearest_pose.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {
namespace {

constexpr int steps = 100;

double half_square(const Arm& arm, const Pose& goal, const Task& task, const Configuration& q) {
  return 0.5 * task_error(task, goal, forward_kinematics(arm, q)).squaredNorm();
}

/// Of half_square(); exact for the position, and near it for the orientation.
Configuration gradient(const Arm& arm, const Pose& goal, const Task& task, const Configuration& q) {
  const Eigen::VectorXd error = task_error(task, goal, forward_kinematics(arm, q));
  return -task_jacobian(arm, q, task).transpose() * error;
}

Eigen::MatrixXd hessian(const Arm& arm, const Pose& goal, const Task& task,
                        const Configuration& q) {
  constexpr double h = 1e-5;
  Eigen::MatrixXd matrix(q.size(), q.size());
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    Configuration before = q, behind = q;
    before[k] -= h, behind[k] += h;
    matrix.col(k) =
        (gradient(arm, goal, task, behind) - gradient(arm, goal, task, before)) / (2 * h);
  }
  return 0.5 * (matrix + matrix.transpose());
}

}  // namespace

Task position_part(const Task& task) {
  Task part = task;
  for (std::size_t i = 3; i < 6; ++i) part.rows[i] = false;
  return part;
}

Configuration nearest_for_task(const Arm& arm, const Pose& world_T_tool, const Task& task,
                               const Configuration& q) {
  Configuration best = q;
  double least = half_square(arm, world_T_tool, task, q), damping = 1e-3;
  for (int step = 0; step < steps && damping < 1e6; ++step) {
    const Configuration slope = gradient(arm, world_T_tool, task, best);
    Eigen::MatrixXd matrix = hessian(arm, world_T_tool, task, best);
    matrix.diagonal().array() += damping;
    const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
    const Configuration next = best - factor.solve(slope);
    const double cost = factor.info() == Eigen::Success && next.allFinite()
                            ? half_square(arm, world_T_tool, task, next)
                            : least;
    if (cost < least) {
      const bool done = least - cost < 1e-15 * least;
      best = next, least = cost, damping = std::max(damping / 10, 1e-12);
      if (done) break;
    } else {
      damping *= 10;
    }
  }
  return best;
}

Configuration nearest_orientation(const Arm& arm, const Pose& world_T_tool, const Task& task,
                                  const Configuration& q) {
  const int place = position_part(task).size(), turns = task.size() - place;
  const auto error_at = [&](const Configuration& at) {
    return task_error(task, world_T_tool, forward_kinematics(arm, at));
  };
  Configuration best = q, at = q;
  double least = error_at(q).tail(turns).norm();
  for (int step = 0; step < steps; ++step) {
    const Eigen::MatrixXd j = task_jacobian(arm, at, task);
    const Eigen::VectorXd error = error_at(at);
    const Eigen::MatrixXd moves = j.topRows(place);
    const Eigen::MatrixXd back = moves.completeOrthogonalDecomposition().pseudoInverse();
    const Configuration mended = back * error.head(place);
    const Eigen::MatrixXd free = Eigen::MatrixXd::Identity(q.size(), q.size()) - back * moves;
    const Eigen::MatrixXd turning = j.bottomRows(turns) * free;
    Eigen::MatrixXd normal = turning * turning.transpose();
    constexpr double damping = 1e-6;
    normal.diagonal().array() += damping;
    const Eigen::VectorXd left = error.tail(turns) - j.bottomRows(turns) * mended;
    Configuration change = mended + turning.transpose() * normal.ldlt().solve(left);
    constexpr double longest = 0.3;  // radians or metres: beyond, the Jacobian tells nothing
    if (change.norm() > longest) change *= longest / change.norm();
    at += change;
    const Eigen::VectorXd now = error_at(at);
    constexpr double in_place = 1e-9;
    if (now.head(place).norm() < in_place && now.tail(turns).norm() < least) {
      least = now.tail(turns).norm(), best = at;
    }
    if (change.norm() < 1e-12) break;
  }
  for (int step = 0; step < 2; ++step) {  // exactly into place
    const Eigen::MatrixXd moves = task_jacobian(arm, best, task).topRows(place);
    best += moves.completeOrthogonalDecomposition().solve(error_at(best).head(place));
  }
  return best;
}

}  // namespace beeline::internal
