#pragma once

#include <vector>

#include <beeline/formula/formula.h>
#include <beeline/formula/internal/tree.h>

namespace beeline::internal {

/// Returns the expression with the values of all constants in place of their symbols. Terms that
/// cancel up to rounding are omitted.
Expression with_numbers(const Expression& expression, const SymbolicArm& arm);

/// Returns the tree with the values of all constants, without sums and products of numbers alone.
Tree with_numbers(const Tree& tree, const std::vector<Symbol>& symbols);

}  // namespace beeline::internal
