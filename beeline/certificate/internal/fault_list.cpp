#include <algorithm>
#include <utility>

#include <beeline/certificate/internal/fault_list.h>

namespace beeline::internal {
namespace {

auto of_kind(Fault kind, std::vector<FaultsOfKind>& list) {
  return std::find_if(list.begin(), list.end(),
                      [&](const FaultsOfKind& faults) { return faults.kind == kind; });
}

}  // namespace

void add_fault(const Trajectory& trajectory, Fault kind, std::size_t k, double amount,
               Reason reason, std::vector<FaultsOfKind>& list) {
  const double time = trajectory.times[k];
  reason.set(ReasonField::sample, k + 1).set(ReasonField::time, time);
  const auto found = of_kind(kind, list);
  if (found == list.end()) {
    list.push_back({kind, k, time, reason, std::move(reason), amount});
    return;
  }
  if (k < found->sample) {
    found->sample = k;
    found->time = time;
    found->first = reason;
  }
  if (amount <= found->amount) return;
  found->amount = amount;
  found->worst = std::move(reason);
}

void list_faults(const Arm& arm, const Trajectory& trajectory, const VerifyOptions& options,
                 const std::vector<FaultsOfKind>& of_path, BudgetMeter& budget,
                 Verification& result) {
  if (result.fault == Fault::none) return;
  result.faults = joint_faults(arm, trajectory, options, budget);
  for (const FaultsOfKind& faults : of_path) {
    const auto found = of_kind(faults.kind, result.faults);
    if (found == result.faults.end()) {
      result.faults.push_back(faults);
    } else if (faults.sample < found->sample) {
      found->sample = faults.sample;
      found->time = faults.time;
      found->first = faults.first;
    }
  }
  std::stable_sort(
      result.faults.begin(), result.faults.end(),
      [](const FaultsOfKind& a, const FaultsOfKind& b) { return a.sample < b.sample; });
  const auto first = of_kind(result.fault, result.faults);
  if (first != result.faults.end()) std::rotate(result.faults.begin(), first, first + 1);
}

}  // namespace beeline::internal
