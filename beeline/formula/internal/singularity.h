#pragma once

#include <string>
#include <vector>

#include <beeline/formula/document.h>

namespace beeline::internal {

/// Where a factor of the determinant is zero, as sentences such as "s3 = 0: q3 = 0 or ±π; ...". A
/// sentence says what the arm looks like there only if that holds at random configurations with
/// this factor zero, and at none of others.
std::vector<std::string> singularities(const SymbolicArm& arm,
                                       const DeterminantFormula& determinant,
                                       const FormulaStyle& style);

}  // namespace beeline::internal
