#include <ostream>

#include <beeline/internal/enum_names.h>
#include <beeline/planning/branch.h>

namespace beeline {

std::string name(MotionStatus status) {
  constexpr internal::EnumNames<MotionStatus::work_limit> names(
      "status",
      "reached unreachable not_found outside_limits singular not_proved too_many_samples "
      "not_converged time_limit cancelled work_limit");
  return names.of(status);
}

std::ostream& operator<<(std::ostream& out, MotionStatus status) { return out << name(status); }

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
    default:
      return MotionStatus::not_found;
  }
}

}  // namespace beeline
