#pragma once

#include <beeline/inverse/internal/analytic_family.h>

namespace beeline::internal {

/// Arms and tasks that PieperSolver covers: three axes of the closed loop meet or are parallel.
extern const AnalyticFamily pieper_family;

}  // namespace beeline::internal
