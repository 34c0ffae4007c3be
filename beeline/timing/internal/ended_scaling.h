#pragma once

#include <beeline/internal/budget_meter.h>
#include <beeline/timing/time_scaling.h>

namespace beeline::internal {

/// No time scaling, because the budget has ended the computation.
inline TimeScaling ended_scaling(const BudgetMeter& budget) {
  TimeScaling none;
  none.reason = ended_reason(ReasonCode::ended, budget.ending());
  return none;
}

}  // namespace beeline::internal
