#include <beeline/path/internal/joint_path_derivatives.h>

namespace beeline {

PathRates::PathRates(const JointPath& path)
    : joints_(static_cast<std::size_t>(path.q[0].size())), terms_(5 * joints_ * (path.size() - 1)) {
  double* row = terms_.data();
  for (std::size_t k = 0; k + 1 < path.size(); ++k, row += 5 * joints_) {
    const double h = lengths_.emplace_back(path.s[k + 1] - path.s[k]);
    const double *q0 = path.q[k].data(), *q1 = path.q[k + 1].data();
    const double *v0 = path.dq[k].data(), *v1 = path.dq[k + 1].data();
    const double *a0 = path.ddq[k].data(), *a1 = path.ddq[k + 1].data();
    for (std::size_t i = 0; i < joints_; ++i) {
      // The quintic of path_point(), by h.
      const double r0 = (q1[i] - q0[i]) / h - v0[i] - 0.5 * h * a0[i];
      const double r1 = v1[i] - v0[i] - h * a0[i], r2 = h * (a1[i] - a0[i]);
      row[i] = v0[i];
      row[joints_ + i] = h * a0[i];
      row[2 * joints_ + i] = 3 * (10 * r0 - 4 * r1 + 0.5 * r2);
      row[3 * joints_ + i] = 4 * (-15 * r0 + 7 * r1 - r2);
      row[4 * joints_ + i] = 5 * (6 * r0 - 3 * r1 + 0.5 * r2);
    }
  }
}

void PathRates::at(std::size_t step, double x, double* dq, double* ddq, double* dddq) const {
  const double *e0 = terms_.data() + 5 * joints_ * step, *e1 = e0 + joints_, *e2 = e1 + joints_,
               *e3 = e2 + joints_, *e4 = e3 + joints_;
  const double by_h = 1 / lengths_[step], by_h2 = by_h * by_h;
  for (std::size_t i = 0; i < joints_; ++i) {
    dq[i] = e0[i] + x * (e1[i] + x * (e2[i] + x * (e3[i] + x * e4[i])));
    ddq[i] = by_h * (e1[i] + x * (2 * e2[i] + x * (3 * e3[i] + x * (4 * e4[i]))));
    dddq[i] = by_h2 * (2 * e2[i] + x * (6 * e3[i] + x * (12 * e4[i])));
  }
}

}  // namespace beeline
