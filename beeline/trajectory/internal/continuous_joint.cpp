#include <beeline/trajectory/internal/continuous_joint.h>

namespace beeline::internal {

bool is_continuous(const Arm& arm, int k) {
  const Limits& limits = arm.limits(k);
  const bool limited = limits.lower > -Limits::none || limits.upper < Limits::none;
  return !limited && arm.periodic(k);
}

}  // namespace beeline::internal
