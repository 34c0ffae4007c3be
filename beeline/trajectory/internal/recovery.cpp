#include <beeline/error.h>
#include <beeline/trajectory/internal/motion_start.h>
#include <beeline/trajectory/internal/recovery.h>

namespace beeline::internal {

void check_recover(double recover) {
  constexpr double rounding = 1e-12;  // of degrees
  if (recover >= 0 && recover <= max_recover + rounding) return;
  throw Error("", "recover",
              " must be from 0 to " + number(max_recover) + " rad or m, not " + number(recover));
}

bool starts_outside(const Arm& arm, const ConfigurationRef& q, double recover, const char* option) {
  check_recover(recover);
  check_configuration(arm, q);
  if (may_recover(largest_excess(arm, q), recover)) return true;
  check_start(arm, q, option);
  return false;
}

double largest_excess(const Arm& arm, const ConfigurationRef& q) {
  double largest = -Limits::none;
  for (int k = 0; k < arm.dof(); ++k) {
    largest = std::max(largest, excess_over(arm.limits(k), q[k]));
  }
  return largest;
}

}  // namespace beeline::internal
