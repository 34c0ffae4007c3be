#include <beeline/math/hermite.h>
#include <beeline/path/internal/joint_path_derivatives.h>

namespace beeline::internal {

PathDerivatives::PathDerivatives(const JointPath& path)
    : joints_(static_cast<std::size_t>(path.q[0].size())),
      coefficients_(5 * joints_ * (path.size() - 1)) {
  double* row = coefficients_.data();
  for (std::size_t k = 0; k + 1 < path.size(); ++k, row += 5 * joints_) {
    const double h = lengths_.emplace_back(path.s[k + 1] - path.s[k]);
    const double *q0 = path.q[k].data(), *q1 = path.q[k + 1].data();
    const double *v0 = path.dq[k].data(), *v1 = path.dq[k + 1].data();
    const double *a0 = path.ddq[k].data(), *a1 = path.ddq[k + 1].data();
    for (std::size_t i = 0; i < joints_; ++i) {
      // The quintic of path_point() divided by h.
      const Quintic<double> quintic =
          quintic_between((q1[i] - q0[i]) / h, v0[i], h * a0[i], v1[i], h * a1[i]);
      for (std::size_t r = 0; r < 5; ++r) {
        row[r * joints_ + i] = double(r + 1) * quintic.c[r];
      }
    }
  }
}

void PathDerivatives::at(std::size_t step, double u, double* dq, double* ddq, double* dddq) const {
  const double *e0 = coefficients_.data() + 5 * joints_ * step, *e1 = e0 + joints_,
               *e2 = e1 + joints_, *e3 = e2 + joints_, *e4 = e3 + joints_;
  const double by_h = 1 / lengths_[step], by_h2 = by_h * by_h;
  for (std::size_t i = 0; i < joints_; ++i) {
    dq[i] = e0[i] + u * (e1[i] + u * (e2[i] + u * (e3[i] + u * e4[i])));
    ddq[i] = by_h * (e1[i] + u * (2 * e2[i] + u * (3 * e3[i] + u * (4 * e4[i]))));
    dddq[i] = by_h2 * (2 * e2[i] + u * (6 * e3[i] + u * (12 * e4[i])));
  }
}

}  // namespace beeline::internal
