#pragma once

#include <beeline/inverse/internal/analytic_family.h>

namespace beeline::internal {

/// Planar arms of one to three joints: planar_solver.h.
extern const AnalyticFamily planar_family;

}  // namespace beeline::internal
