#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>

#include <beeline/inverse/nearest.h>
#include <beeline/kinematics/forward.h>

namespace beeline {
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

Configuration nearest_orientation(const Arm& arm, const Pose& world_T_tool,
                                  const Configuration& q) {
  const Task spatial = Task::spatial();
  Configuration best = q, at = q;
  double least = task_deviation(spatial, world_T_tool, forward_kinematics(arm, q)).orientation;
  for (int step = 0; step < steps; ++step) {
    const Eigen::MatrixXd j = task_jacobian(arm, at, spatial);
    const Eigen::VectorXd error = task_error(spatial, world_T_tool, forward_kinematics(arm, at));
    const auto place = Eigen::MatrixXd(j.topRows(3)).completeOrthogonalDecomposition();
    const Eigen::MatrixXd back = place.pseudoInverse();
    const Eigen::MatrixXd free =
        Eigen::MatrixXd::Identity(q.size(), q.size()) - back * j.topRows(3);
    const Configuration mended = back * error.head(3);
    const Eigen::MatrixXd turns = j.bottomRows(3) * free;
    Eigen::Matrix3d normal = turns * turns.transpose();
    constexpr double damping = 1e-6;
    normal.diagonal().array() += damping;
    const Vector3 left = error.tail(3) - j.bottomRows(3) * mended;
    Configuration change = mended + turns.transpose() * normal.ldlt().solve(left);
    constexpr double longest = 0.3;  // radians or metres: beyond, the Jacobian tells nothing
    if (change.norm() > longest) change *= longest / change.norm();
    at += change;
    const Deviation now = task_deviation(spatial, world_T_tool, forward_kinematics(arm, at));
    constexpr double in_place = 1e-9;
    if (now.position < in_place && now.orientation < least) least = now.orientation, best = at;
    if (change.norm() < 1e-12) break;
  }
  return best;
}

}  // namespace beeline
