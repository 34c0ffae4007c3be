#include <beeline/planning/internal/printed_motion.h>

namespace beeline::internal {

std::ostream& print_assumed(std::ostream& out, const LimitUsage& limits) {
  std::vector<std::string> assumed;
  if (limits.velocity.assumed) assumed.emplace_back("velocity");
  if (limits.acceleration.assumed) assumed.emplace_back("acceleration");
  if (limits.jerk.assumed) assumed.emplace_back("jerk");
  for (std::size_t i = 0; i < assumed.size(); ++i) {
    out << (i == 0 ? ", limits of " : i + 1 == assumed.size() ? " and " : ", ") << assumed[i];
  }
  return assumed.empty() ? out : out << " assumed";
}

}  // namespace beeline::internal
