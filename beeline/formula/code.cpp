#include <algorithm>

#include <beeline/formula/document.h>
#include <beeline/formula/internal/chain_graph.h>
#include <beeline/formula/internal/code_writer.h>

namespace beeline {
namespace {

using internal::ChainGraph;
using internal::CodeWriter;
using internal::ComputationGraph;

/// Returns the entries of the task's rows of a 6 x dof matrix, row by row.
std::vector<ComputationGraph::Id> task_entries(const std::vector<ComputationGraph::Id>& matrix,
                                               const Task& task, int dof) {
  std::vector<ComputationGraph::Id> entries;
  for (std::size_t row = 0; row < 6; ++row) {
    if (!task.rows[row]) continue;
    const auto begin = matrix.begin() + static_cast<std::ptrdiff_t>(row) * dof;
    entries.insert(entries.end(), begin, begin + dof);
  }
  return entries;
}

ComputationGraph::Id determinant_of(ChainGraph& chain, const DeterminantFormula& determinant) {
  internal::GraphNumber product = chain.expression(determinant.constant);
  for (const auto& [factor, exponent] : determinant.factors) {
    for (int k = 0; k < exponent; ++k) product = product * chain.expression(factor);
  }
  return product.id;
}

bool has_rates(const SymbolicArm& arm, const ExpressionMatrix& matrix) {
  for (const Expression& entry : matrix.entries) {
    for (const auto& [monomial, coefficient] : entry.terms()) {
      for (const auto& [symbol, exponent] : monomial.powers) {
        if (arm.symbols[static_cast<std::size_t>(symbol)].kind == SymbolKind::rate) return true;
      }
    }
  }
  return false;
}

}  // namespace

GeneratedCode formula_code(const SymbolicArm& arm, const ExpressionMatrix& matrix,
                           const std::string& name, CodeLanguage language, bool numbers) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  };
  if (name.empty() || !std::all_of(name.begin(), name.end(), fits)) {
    throw Error("\"" + name + "\" is not a name for a function: letters, digits and underscores");
  }
  ChainGraph chain(arm, numbers);
  std::vector<ComputationGraph::Id> entries;
  for (const Expression& entry : matrix.entries) {
    entries.push_back(chain.expression(entry).id);
  }
  if (entries.empty()) throw Error("a matrix without entries has no code");
  CodeWriter writer(arm, chain, language);
  const bool one = entries.size() == 1;
  const std::string size = std::to_string(matrix.rows) + " x " + std::to_string(matrix.columns);
  writer.function(name, one ? "A number." : "M, " + size + " row by row.", has_rates(arm, matrix),
                  {{"M", one ? 0 : static_cast<int>(matrix.columns), entries}});
  return writer.finish();
}

GeneratedCode formula_code(const SymbolicArm& arm, const FormulaContent& content,
                           CodeLanguage language, bool numbers) {
  ChainGraph chain(arm, numbers);
  CodeWriter writer(arm, chain, language);
  const std::string rows = listed(row_names({content.task.rows, Frame::base}));
  const std::string frame = "in the " + name(content.frame) + " frame";
  const std::string size = std::to_string(content.task.size()) + " x " + std::to_string(arm.dof);
  if (content.tool) {
    writer.function("forward", "T, the pose of the tool in the world, 4 x 4 row by row.", false,
                    {{"T", 4, chain.pose()}});
  }
  if (content.jacobian) {
    writer.function(
        "jacobian",
        "T, and J, the Jacobian " + frame + ", " + size + " row by row; rows " + rows + ".", false,
        {{"T", 4, chain.pose()},
         {"J", arm.dof, task_entries(chain.jacobian(content.frame), content.task, arm.dof)}});
  }
  if (content.derivative) {
    writer.function(
        "jacobian_derivative",
        "dJ, the time derivative of the Jacobian " + frame + ", " + size + " row by row; rows " +
            rows + ".",
        true,
        {{"dJ", arm.dof, task_entries(chain.derivative(content.frame), content.task, arm.dof)}});
  }
  if (content.determinant) {
    writer.function("determinant", "The determinant of the Jacobian, rows " + rows + ".", false,
                    {{"det", 0, {determinant_of(chain, determinant_formula(arm, content.task))}}});
  }
  return writer.finish();
}

}  // namespace beeline
