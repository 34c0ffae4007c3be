#include <algorithm>
#include <limits>
#include <string>

#include <beeline/error.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/math/six_row_svd.h>

namespace beeline {

ManipulabilityMeasures manipulability_measures(const Eigen::Ref<const Eigen::MatrixXd>& jacobian) {
  if (jacobian.size() == 0 || !jacobian.allFinite()) {
    throw Error("a Jacobian needs at least one row and one column, all finite");
  }
  if (jacobian.rows() > 6) {
    throw Error("a Jacobian has at most 6 rows, not " + std::to_string(jacobian.rows()));
  }
  ManipulabilityMeasures result;
  result.singular_values = internal::six_row_svd(jacobian).singular_values.head(
      std::min(jacobian.rows(), jacobian.cols()));
  const double largest = result.singular_values[0];
  const double smallest = result.singular_values[result.singular_values.size() - 1];
  const bool enough_joints = jacobian.cols() >= jacobian.rows();
  result.manipulability = enough_joints ? result.singular_values.prod() : 0;
  // A singular value below this rank tolerance is zero, to rounding.
  const double rounding = largest * std::numeric_limits<double>::epsilon() *
                          static_cast<double>(std::max(jacobian.rows(), jacobian.cols()));
  result.condition =
      smallest > rounding ? largest / smallest : std::numeric_limits<double>::infinity();
  return result;
}

}  // namespace beeline
