#pragma once

#include <beeline/inverse/internal/analytic_family.h>

namespace beeline::internal {

/// Six revolute joints of any geometry: raghavan_roth_solver.h.
extern const AnalyticFamily raghavan_roth_family;

}  // namespace beeline::internal
