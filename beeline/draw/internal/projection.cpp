#include <algorithm>
#include <cmath>

#include <beeline/draw/internal/projection.h>
#include <beeline/error.h>

namespace beeline::internal {

std::string axis_name(const View& view, int row) {
  for (int axis = 0; axis < 3; ++axis) {
    if (view(row, axis) > 1 - 1e-12) return std::string(1, "xyz"[axis]);
  }
  return "";
}

PaperPoint Projection::operator()(const Vector3& p) const { return origin + scale * direction(p); }

PaperPoint Projection::direction(const Vector3& d) const {
  return {view.row(0).dot(d), -view.row(1).dot(d)};
}

double round_step(double minimum) {
  const double power = std::pow(10, std::floor(std::log10(minimum)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= minimum * (1 - 1e-9)) return factor * power;
  }
  return 10 * power;
}

int decimals_of(double step) {
  return std::clamp(static_cast<int>(-std::floor(std::log10(step) + 1e-9)), 0, 15);
}

}  // namespace beeline::internal
