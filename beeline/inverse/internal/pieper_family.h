#pragma once

#include <beeline/inverse/internal/analytic_family.h>

namespace beeline::internal {

/// Arms of which three axes meet or are parallel, or have a loop like that: pieper_solver.h.
extern const AnalyticFamily pieper_family;

}  // namespace beeline::internal
