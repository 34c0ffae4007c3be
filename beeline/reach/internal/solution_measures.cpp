#include <algorithm>

#include <beeline/batch/batch.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/reach/internal/solution_measures.h>

namespace beeline::internal {
namespace {

/// The rows of the Jacobian for the manipulability.
Task measured_rows(const Arm& arm) {
  const Task task = default_task(arm);
  if (arm.dof() >= task.size()) return task;
  if (arm.planar()) return {{true, true, false, false, false, false}};
  const bool scara = arm.rotates_about_z() && arm.dof() >= 4;
  return scara ? Task{{true, true, true, false, false, true}} : Task::position();
}

}  // namespace

double least_margin(const Arm& arm, const ConfigurationRef& q, int begin, int end) {
  double least = 1;
  for (int k = begin; k < end; ++k) {
    const Limits& limits = arm.limits(k);
    least = std::min(least, limit_margin(q[k], limits.lower, limits.upper));
  }
  return std::max(least, 0.0);
}

SolutionMeasures solution_measures(const Arm& arm, const Eigen::Ref<const Eigen::MatrixXd>& q,
                                   int begin, int end) {
  const Task rows = measured_rows(arm);
  Eigen::MatrixXd manipulability(1, q.cols());
  if (rows == Task::spatial()) {
    batch_manipulability<double>(arm, q, manipulability, {.threads = 1});
  } else {
    for (Eigen::Index i = 0; i < q.cols(); ++i) {
      const Eigen::MatrixXd j = task_jacobian(arm, q.col(i), rows);
      const bool wide = j.cols() >= j.rows();
      manipulability(i) =
          manipulability_measures(wide ? j : Eigen::MatrixXd(j.transpose())).manipulability;
    }
  }
  SolutionMeasures measures;
  for (Eigen::Index i = 0; i < q.cols(); ++i) {
    measures.manipulability.push_back(static_cast<float>(manipulability(i)));
    measures.margin.push_back(static_cast<float>(least_margin(arm, q.col(i), begin, end)));
  }
  return measures;
}

}  // namespace beeline::internal
