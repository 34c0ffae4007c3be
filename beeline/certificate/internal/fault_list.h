#pragma once

#include <cstddef>
#include <vector>

#include <beeline/certificate/verify.h>
#include <beeline/internal/budget_meter.h>

namespace beeline::internal {

/// Adds a fault at sample k, or between it and the next, to the faults of its kind. It is the worst
/// of them if `amount` is larger than the amounts before.
void add_fault(const Trajectory& trajectory, Fault kind, std::size_t k, double amount,
               Reason reason, std::vector<FaultsOfKind>& list);

/// Returns every kind of fault of the joints; those found so far if the budget ends the search. The
/// trajectory's columns are in the arm's order.
std::vector<FaultsOfKind> joint_faults(const Arm& arm, const Trajectory& trajectory,
                                       const VerifyOptions& options, BudgetMeter& budget);

/// Sets Verification::faults, if there is a fault: the joints' and `of_path`, which are the faults
/// of the path. The kind of the first fault comes first, the others follow in the order of time.
void list_faults(const Arm& arm, const Trajectory& trajectory, const VerifyOptions& options,
                 const std::vector<FaultsOfKind>& of_path, BudgetMeter& budget,
                 Verification& result);

}  // namespace beeline::internal
