#pragma once

#include <string>
#include <vector>

#include <beeline/formula/document.h>
#include <beeline/formula/internal/chain_graph.h>

namespace beeline::internal {

/// An output of a function: an array with `columns` entries a row, or a number (0 columns).
struct CodeOutput {
  std::string name;
  int columns = 0;
  std::vector<ComputationGraph::Id> entries = {};
};

/// Writes functions that compute nodes of a graph in a language.
class CodeWriter {
 public:
  CodeWriter(const SymbolicArm& arm, const ChainGraph& chain, CodeLanguage language);

  /// Adds the function NAME_suffix(q, outputs), with `rates` NAME_suffix(q, dq, outputs).
  void function(const std::string& suffix, const std::string& purpose, bool rates,
                const std::vector<CodeOutput>& outputs);

  GeneratedCode finish();

 private:
  std::string body(const std::vector<CodeOutput>& outputs, bool rates);
  std::string head(const std::vector<int>& uses, bool rates) const;
  std::string operand(int id) const;
  std::string text_of(const ComputationGraph::Node& node) const;
  std::string assignment(const std::string& left, const std::string& right, bool declares) const;
  std::string store(const CodeOutput& output) const;
  std::string comment(const std::string& text) const;

  const SymbolicArm& arm_;
  const ComputationGraph& graph_;
  CodeLanguage language_;
  std::string prefix_;             ///< prefix of the functions' names
  std::vector<std::string> text_;  ///< text of each node at its uses: a name, or an operation
  GeneratedCode code_;
};

}  // namespace beeline::internal
