#pragma once

#include <beeline/inverse/internal/analytic_family.h>

namespace beeline::internal {

/// Sets state.family, or state.fallback, to the first family of the table that applies. Neither is
/// set for InverseMethod::numerical.
void select_family(SolverState& state);

/// Adds the solutions of the family, and replaces the evidence by its own.
void solve_analytic(const AnalyticFamily& family, SolverState& state, const Request& request,
                    StageResult& found);

}  // namespace beeline::internal
