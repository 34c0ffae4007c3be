#include "cases.h"

namespace beeline::bench {

std::vector<Case> cases_of(const BenchArm& arm) {
  std::vector<Case> cases;
  if (arm.free() <= 6) cases.push_back({CaseKind::all_solutions, "all solutions", false});
  if (arm.last) return cases;
  cases.push_back({CaseKind::within_limits, "within limits", true});
  cases.push_back({CaseKind::numerical_within_limits, "numerical, within limits", true});
  cases.push_back({CaseKind::numerical_free, "numerical, limits ignored", false});
  cases.push_back({CaseKind::tracking, "tracking", true});
  return cases;
}

}  // namespace beeline::bench
