#include <Eigen/Jacobi>
#include <cmath>
#include <limits>
#include <utility>

#include <beeline/math/six_row_svd.h>

namespace beeline::internal {
void SixRowSvd::compute(const Eigen::Matrix<double, 6, Eigen::Dynamic>& a) {
  constexpr int max_sweeps = 30;        // convergence is quadratic; about six suffice
  constexpr double orthogonal = 1e-14;  // cosine between columns that rounding leaves
  scaled_right.noalias() = a.transpose() * left;
  const double negligible = 1e-34 * scaled_right.squaredNorm();
  bool rotated = true;
  for (int sweep = 0; rotated && sweep < max_sweeps; ++sweep) {
    rotated = false;
    for (int p = 0; p < 5; ++p) {
      for (int q = p + 1; q < 6; ++q) {
        const double pp = scaled_right.col(p).squaredNorm();
        const double qq = scaled_right.col(q).squaredNorm();
        const double pq = scaled_right.col(p).dot(scaled_right.col(q));
        if (!(std::abs(pq) > orthogonal * std::sqrt(pp) * std::sqrt(qq) + negligible)) continue;
        rotated = true;
        const double cotangent = (qq - pp) / (2 * pq);  // of twice the angle
        const double tangent = std::copysign(
            1 / (std::abs(cotangent) + std::sqrt(1 + cotangent * cotangent)), cotangent);
        const double c = 1 / std::sqrt(1 + tangent * tangent), s = c * tangent;
        const Eigen::JacobiRotation<double> rotation(c, s);
        scaled_right.applyOnTheRight(p, q, rotation);
        left.applyOnTheRight(p, q, rotation);
      }
    }
  }
  singular_values = scaled_right.colwise().norm().transpose();
}

SixRowSvd six_row_svd(const Eigen::Ref<const Eigen::MatrixXd>& a) {
  Eigen::Matrix<double, 6, Eigen::Dynamic> six =
      Eigen::Matrix<double, 6, Eigen::Dynamic>::Zero(6, a.cols());
  six.topRows(a.rows()) = a;
  // A power of two, so that scaling is exact; without it, squares of large entries overflow.
  const double largest_entry = a.size() == 0 ? 0 : a.cwiseAbs().maxCoeff();
  const double scale = largest_entry > 0 ? std::exp2(std::ilogb(largest_entry)) : 1;
  six /= scale;
  SixRowSvd svd;
  svd.compute(six);
  svd.singular_values *= scale;
  svd.scaled_right *= scale;
  for (int i = 0; i < 5; ++i) {
    Eigen::Index largest = 0;
    svd.singular_values.tail(6 - i).maxCoeff(&largest);
    std::swap(svd.singular_values[i], svd.singular_values[i + largest]);
    svd.left.col(i).swap(svd.left.col(i + largest));
    svd.scaled_right.col(i).swap(svd.scaled_right.col(i + largest));
  }
  return svd;
}

double negligible_singular_value(double largest, Eigen::Index size) {
  return largest * std::numeric_limits<double>::epsilon() * static_cast<double>(size);
}

}  // namespace beeline::internal
