#include <algorithm>
#include <limits>
#include <string>

#include <beeline/error.h>
#include <beeline/kinematics/internal/mask.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/math/decompositions.h>
#include <beeline/math/six_row_svd.h>

namespace beeline {
namespace {

/// A singular value up to this is zero.
double rounding_of(double largest, const Eigen::Ref<const Eigen::MatrixXd>& jacobian) {
  return internal::negligible_singular_value(largest, std::max(jacobian.rows(), jacobian.cols()));
}

void check_matrix(const Eigen::Ref<const Eigen::MatrixXd>& jacobian) {
  if (jacobian.size() == 0 || !jacobian.allFinite()) {
    throw Error("a Jacobian needs at least one row and one column, all finite");
  }
  if (jacobian.rows() > 6) {
    throw Error("a Jacobian has at most 6 rows, not " + std::to_string(jacobian.rows()));
  }
}

}  // namespace

ManipulabilityMeasures manipulability_measures(const Eigen::Ref<const Eigen::MatrixXd>& jacobian) {
  check_matrix(jacobian);
  ManipulabilityMeasures result;
  result.singular_values = internal::six_row_svd(jacobian).singular_values.head(
      std::min(jacobian.rows(), jacobian.cols()));
  const double largest = result.singular_values[0];
  const double smallest = result.singular_values[result.singular_values.size() - 1];
  const bool enough_joints = jacobian.cols() >= jacobian.rows();
  result.manipulability = enough_joints ? result.singular_values.prod() : 0;
  result.condition = smallest > rounding_of(largest, jacobian)
                         ? largest / smallest
                         : std::numeric_limits<double>::infinity();
  return result;
}

ManipulabilityEllipsoids manipulability_ellipsoids(
    const Eigen::Ref<const Eigen::MatrixXd>& jacobian) {
  check_matrix(jacobian);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(jacobian, Eigen::ComputeFullU);
  const Eigen::VectorXd& sigma = svd.singularValues();
  ManipulabilityEllipsoids result{svd.matrixU(), Eigen::VectorXd::Zero(jacobian.rows()), {}};
  const double rounding = rounding_of(sigma[0], jacobian);
  for (Eigen::Index i = 0; i < sigma.size(); ++i) {
    if (sigma[i] > rounding) result.velocity[i] = sigma[i];
  }
  result.force = result.velocity.cwiseInverse();
  return result;
}

ManipulabilityGradient manipulability_gradient(const Arm& arm, const ConfigurationRef& q,
                                               const Task& task) {
  check_task(task);
  const int n = arm.dof();
  Jacobian columns(6, n);
  Hessian derivatives(6, Eigen::Index{n} * n);
  hessian(arm, q, columns, derivatives, task.frame);
  const Eigen::MatrixXd matrix = selected_rows(task, columns);
  const internal::SixRowSvd svd = internal::six_row_svd(matrix);
  const Eigen::Index count = matrix.rows();
  const auto& sigma = svd.singular_values;
  ManipulabilityGradient result{0, Configuration::Zero(n)};
  if (n < count || !(sigma[count - 1] > rounding_of(sigma[0], matrix))) return result;
  result.manipulability = sigma.head(count).prod();
  // The logarithm of w is the sum of log sigma over the singular values, and d sigma = u^T dJ v
  // with sigma v = J^T u. Hence the gradient is w tr(J^+ dJ/dq).
  const Eigen::MatrixXd pseudoinverse = svd.scaled_right.leftCols(count) *
                                        sigma.head(count).cwiseAbs2().cwiseInverse().asDiagonal() *
                                        svd.left.topLeftCorner(count, count).transpose();
  for (int k = 0; k < n; ++k) {
    const Eigen::MatrixXd change =
        selected_rows(task, derivatives.middleCols(Eigen::Index{k} * n, n));
    result.gradient[k] =
        result.manipulability * pseudoinverse.cwiseProduct(change.transpose()).sum();
  }
  return result;
}

ManipulabilityGradient manipulability_gradient(const Arm& arm, const ConfigurationRef& q) {
  return manipulability_gradient(arm, q, default_task(arm));
}

}  // namespace beeline
