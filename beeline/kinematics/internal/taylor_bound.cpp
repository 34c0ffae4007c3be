#include <beeline/kinematics/internal/taylor_bound.h>

namespace beeline::internal {

TaylorBound operator+(TaylorBound a, const TaylorBound& b) { return a += b; }

TaylorBound operator*(double k, TaylorBound a) {
  for (double& c : a.c) c *= k;
  return a;
}

TaylorBound operator*(const TaylorBound& a, const TaylorBound& b) {
  TaylorBound product;
  for (std::size_t n = 0; n < TaylorBound::terms; ++n) {
    for (std::size_t k = 0; k <= n; ++k) product.c[n] += a.c[k] * b.c[n - k];
  }
  return product;
}

TaylorBound exponential(const TaylorBound& r) {
  TaylorBound result;
  result.c[0] = 1;
  for (std::size_t n = 1; n < TaylorBound::terms; ++n) {  // n e_n = sum_k k r_k e_(n-k)
    for (std::size_t k = 1; k <= n; ++k) {
      result.c[n] += static_cast<double>(k) * r.c[k] * result.c[n - k];
    }
    result.c[n] /= static_cast<double>(n);
  }
  return result;
}

TaylorBound composed(const TaylorBound& f, const TaylorBound& s) {
  TaylorBound change = s, result;
  change.c[0] = 0;
  for (std::size_t k = TaylorBound::terms; k-- > 0;) {  // Horner's scheme
    result = result * change;
    result.c[0] += f.c[k];
  }
  return result;
}

}  // namespace beeline::internal
