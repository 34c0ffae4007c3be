#include <algorithm>
#include <bit>
#include <numeric>

#include <beeline/formula/internal/symbolic_chain.h>
#include <beeline/formula/internal/symbolic_determinant.h>

namespace beeline::internal {
namespace {

std::vector<int> without(const std::vector<int>& list, const std::vector<int>& left_out) {
  std::vector<int> rest;
  for (const int number : list) {
    if (std::find(left_out.begin(), left_out.end(), number) == left_out.end()) {
      rest.push_back(number);
    }
  }
  return rest;
}

/// The sum of the places of `chosen` within `list`.
int places(const std::vector<int>& list, const std::vector<int>& chosen) {
  int sum = 0;
  for (const int number : chosen) {
    sum += static_cast<int>(std::find(list.begin(), list.end(), number) - list.begin());
  }
  return sum;
}

/// The columns of `remaining` in which one of the rows is not zero.
std::vector<int> support(const Pattern& pattern, const std::vector<int>& rows,
                         const std::vector<int>& remaining) {
  std::vector<int> columns;
  for (const int column : remaining) {
    const bool any = std::any_of(rows.begin(), rows.end(), [&](int row) {
      return pattern[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
    });
    if (any) columns.push_back(column);
  }
  return columns;
}

/// The smallest set of rows that has as few columns or fewer; at most all rows.
Block smallest_block(const Pattern& pattern, const Block& remaining) {
  const std::size_t n = remaining.rows.size();
  Block best = remaining;
  for (unsigned set = 1; set + 1 < (1U << n); ++set) {
    if (static_cast<std::size_t>(std::popcount(set)) >= best.rows.size()) continue;
    std::vector<int> rows;
    for (std::size_t i = 0; i < n; ++i) {
      if (set >> i & 1) rows.push_back(remaining.rows[i]);
    }
    std::vector<int> columns = support(pattern, rows, remaining.columns);
    if (columns.size() <= rows.size()) best = {std::move(rows), std::move(columns)};
  }
  return best;
}

}  // namespace

int BlockForm::cost() const {
  int sum = 0;
  for (const Block& block : blocks) {
    int factorial = 1;
    for (std::size_t k = 2; k <= block.rows.size(); ++k) factorial *= static_cast<int>(k);
    sum += factorial;
  }
  return sum;
}

BlockForm block_form(const Pattern& pattern) {
  BlockForm form;
  Block remaining;
  remaining.rows.resize(pattern.size());
  std::iota(remaining.rows.begin(), remaining.rows.end(), 0);
  remaining.columns = remaining.rows;
  while (!remaining.rows.empty()) {
    const Block block = smallest_block(pattern, remaining);
    if (support(pattern, block.rows, remaining.columns).size() < block.rows.size()) return {};
    const int exchanges =
        places(remaining.rows, block.rows) + places(remaining.columns, block.columns);
    if (exchanges % 2 != 0) form.sign = -form.sign;
    remaining = {without(remaining.rows, block.rows), without(remaining.columns, block.columns)};
    form.blocks.push_back(block);
  }
  return form;
}

Expression block_determinant(const SymbolicArm& arm, const ExpressionMatrix& matrix,
                             const Block& block) {
  const auto entry = [&](int row, int column) -> const Expression& {
    return matrix(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
  };
  if (block.rows.size() == 1) return entry(block.rows[0], block.columns[0]);
  const auto row_size = [&](int row) {
    std::size_t size = 0;
    for (const int column : block.columns) size += entry(row, column).size();
    return size;
  };
  const auto row = std::min_element(block.rows.begin(), block.rows.end(),
                                    [&](int a, int b) { return row_size(a) < row_size(b); });
  const std::ptrdiff_t place = row - block.rows.begin();
  Expression sum;
  for (std::size_t k = 0; k < block.columns.size(); ++k) {
    const Expression& factor = entry(*row, block.columns[k]);
    if (factor.is_zero()) continue;
    const Block minor{without(block.rows, {*row}), without(block.columns, {block.columns[k]})};
    const Expression below = block_determinant(arm, matrix, minor);
    check_size(arm, factor.size() * below.size() / 4, "the determinant");
    const int sign = (place + static_cast<std::ptrdiff_t>(k)) % 2 == 0 ? 1 : -1;
    sum += Expression(sign) * factor * below;
    check_size(arm, sum.size(), "the determinant");
  }
  return sum;
}

}  // namespace beeline::internal
