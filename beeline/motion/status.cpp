#include <beeline/motion/status.h>

namespace beeline {

std::string name(MotionStatus status) {
  constexpr const char* names[] = {"reached",        "unreachable", "not_found",
                                   "outside_limits", "singular",    "not_converged"};
  return names[static_cast<int>(status)];
}

}  // namespace beeline
