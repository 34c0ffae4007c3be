#pragma once

#include <vector>

#include <beeline/formula/formula.h>

namespace beeline::internal {

/// A square block: the numbers of its rows and columns.
struct Block {
  std::vector<int> rows, columns;
};

/// The block-triangular form of a square pattern of zeros (Duff & Reid, 1978). The determinant of
/// the matrix is `sign` times the product of the determinants of the blocks. There are no blocks if
/// the pattern makes it zero.
struct BlockForm {
  std::vector<Block> blocks = {};
  int sign = 1;

  /// An estimate of the work: the sum of the factorials of the blocks' sizes.
  int cost() const;
};
using Pattern = std::vector<std::vector<bool>>;  ///< pattern[row][column]: not zero
BlockForm block_form(const Pattern& pattern);

/// Returns the determinant of a block, by expansion along the row with the fewest symbols.
Expression block_determinant(const SymbolicArm& arm, const ExpressionMatrix& matrix,
                             const Block& block);

}  // namespace beeline::internal
