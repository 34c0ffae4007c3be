#pragma once

#include <string>
#include <vector>

#include <beeline/formula/document.h>

namespace beeline::internal {

/// Returns the zeros of the factors of the determinant as sentences such as "s3 = 0: q3 = 0 or ±π;
/// ...". A sentence describes the arm at these zeros only if the description holds at random
/// configurations with this factor zero, and at no others.
std::vector<std::string> singularities(const SymbolicArm& arm,
                                       const DeterminantFormula& determinant,
                                       const FormulaStyle& style);

}  // namespace beeline::internal
