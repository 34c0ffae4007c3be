#include <cmath>

#include <beeline/control/internal/six_rows.h>

namespace beeline::internal {

void SixByRoots::factor(const Gram& gram) {
  Gram left = gram;
  root_.setIdentity();
  for (int i = 0; i < 6; ++i) {  // each step clears a column below the diagonal
    const double scale = 1 / std::sqrt(left(i, i));
    Rows column = left.col(i) * scale;
    Eigen::Matrix<double, 1, 6> row = root_.row(i) * scale;
    column.head(i + 1).setZero();
    root_.row(i) = row;
    left.noalias() -= column * column.transpose();
    root_.noalias() -= column * row;
  }
}

void SixDirections::find(const Jacobian& rows) {
  constexpr int sweeps = 30;
  constexpr double square = 1e-14;  // two motions at right angles but for rounding
  motion.noalias() = rows.transpose() * u;
  const double least = 1e-34 * motion.squaredNorm();
  bool turned = true;
  for (int sweep = 0; turned && sweep < sweeps; ++sweep) {
    turned = false;
    for (int p = 0; p < 5; ++p) {
      for (int q = p + 1; q < 6; ++q) {
        const double pp = motion.col(p).squaredNorm(), qq = motion.col(q).squaredNorm();
        const double pq = motion.col(p).dot(motion.col(q));
        if (!(std::abs(pq) > square * std::sqrt(pp * qq) + least)) continue;
        turned = true;
        const double slope = (qq - pp) / (2 * pq);
        const double tangent =
            std::copysign(1 / (std::abs(slope) + std::sqrt(1 + slope * slope)), slope);
        const double c = 1 / std::sqrt(1 + tangent * tangent), s = c * tangent;
        for (Eigen::Index k = 0; k < motion.rows(); ++k) {
          const double a = motion(k, p), b = motion(k, q);
          motion(k, p) = c * a - s * b;
          motion(k, q) = s * a + c * b;
        }
        for (int k = 0; k < 6; ++k) {
          const double a = u(k, p), b = u(k, q);
          u(k, p) = c * a - s * b;
          u(k, q) = s * a + c * b;
        }
      }
    }
  }
  size = motion.colwise().norm().transpose();
}

}  // namespace beeline::internal
