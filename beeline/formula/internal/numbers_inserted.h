#pragma once

#include <beeline/formula/symbolic_arm.h>

namespace beeline::internal {

/// The expression with the values of all constants in place of their symbols. Terms that cancel up
/// to rounding are left out.
Expression with_numbers(const Expression& expression, const SymbolicArm& arm);

}  // namespace beeline::internal
