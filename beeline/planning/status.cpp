#include <beeline/internal/enum_names.h>
#include <beeline/planning/branch.h>

namespace beeline {

std::string name(MotionStatus status) {
  constexpr internal::EnumNames<MotionStatus> names("status");
  return names.of(status);
}

MotionStatus motion_status(InverseStatus status) {
  switch (status) {
    case InverseStatus::outside_limits:
      return MotionStatus::outside_limits;
    case InverseStatus::unreachable:
    case InverseStatus::orientation_unreachable:
      return MotionStatus::unreachable;
    case InverseStatus::time_limit:
      return MotionStatus::time_limit;
    case InverseStatus::cancelled:
      return MotionStatus::cancelled;
    case InverseStatus::work_limit:
      return MotionStatus::work_limit;
    case InverseStatus::blocked:
      return MotionStatus::collides;
    case InverseStatus::solved:
    case InverseStatus::not_found:
      break;
  }
  return MotionStatus::not_found;
}

}  // namespace beeline
