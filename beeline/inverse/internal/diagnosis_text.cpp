#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/inverse/internal/diagnosis_text.h>

namespace beeline::internal {

std::string point(const Vector3& exact) {
  // Coordinates that are rounding errors relative to the others are shown as 0.
  const double noise = 1e-9 * exact.cwiseAbs().maxCoeff();
  const Vector3 p = (exact.array().abs() < noise).select(0, exact);
  return "(" + number(p.x()) + ", " + number(p.y()) + ", " + number(p.z()) + ")";
}

std::string blocking_joint(const Arm& arm, const Configuration& q, const Bounds& bounds) {
  int worst = 0;
  const auto outside = [&](int k) {
    return std::max(bounds.lower[k] - q[k], q[k] - bounds.upper[k]);
  };
  for (int k = 1; k < q.size(); ++k) {
    if (outside(k) > outside(worst)) worst = k;
  }
  const auto value = [&](double x) { return with_unit(arm.joint_of(worst), x); };
  const bool above = q[worst] > bounds.upper[worst];
  return "joint " + arm.joint_of(worst).name + " would be at " + value(q[worst]) + ", " +
         value(outside(worst)) + (above ? " above its upper limit " : " below its lower limit ") +
         value(above ? bounds.upper[worst] : bounds.lower[worst]);
}

std::string miss(const Deviation& error, double tolerance) {
  if (!(error.orientation > tolerance)) return number(error.position) + " m";
  if (!(error.position > tolerance)) return angle(error.orientation);
  return deviation_text(error);
}

}  // namespace beeline::internal
