#include <algorithm>
#include <cmath>

#include <beeline/formula/internal/code_writer.h>
#include <beeline/formula/internal/digits.h>

namespace beeline::internal {
namespace {

constexpr std::size_t longest_inline = 60;  // max characters of an operation without a name

bool is_ascii_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// Returns a name for functions: other characters become underscores.
std::string identifier(const std::string& name) {
  std::string result;
  for (const char c : name.substr(0, 60)) result += is_ascii_name(c) ? c : '_';
  const bool begins_with_letter = !result.empty() && (result[0] < '0' || result[0] > '9');
  return begins_with_letter ? result : "arm_" + result;
}

/// Returns the number with all digits, as a floating-point literal.
std::string literal(double value) {
  const std::string text = shortest_digits(value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

/// Whether an operand needs brackets after a minus sign or in a product.
bool is_sum(const std::string& text) {
  int depth = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    depth += text[i] == '(' || text[i] == '[' ? 1 : text[i] == ')' || text[i] == ']' ? -1 : 0;
    const bool sign = text[i] == '+' || text[i] == '-';
    const bool exponent = i > 0 && text[i - 1] == 'e';
    if (depth == 0 && sign && !exponent) return true;
  }
  return false;
}

std::string bracketed(const std::string& text) { return is_sum(text) ? '(' + text + ')' : text; }

}  // namespace

CodeWriter::CodeWriter(const SymbolicArm& arm, const ChainGraph& chain, CodeLanguage language)
    : arm_(arm), graph_(chain.graph()), language_(language), prefix_(identifier(arm.name)) {
  const std::string title = "Kinematics of " + prefix_ + ": metres, radians, seconds.";
  if (language == CodeLanguage::python) {
    code_.text = "\"\"\"" + title + "\"\"\"\n\nfrom math import cos, sin\n";
    return;
  }
  const bool c = language == CodeLanguage::c;
  code_.text = comment(title) + (c ? "#include <math.h>\n" : "#include <cmath>\n") +
               "\n#ifndef BEELINE_FORMULA_FUNCTION\n#define BEELINE_FORMULA_FUNCTION " +
               (c ? "static inline" : "inline") + "\n#endif\n";
}

std::string CodeWriter::comment(const std::string& text) const {
  if (language_ == CodeLanguage::python) return "# " + text + "\n";
  return language_ == CodeLanguage::c ? "/* " + text + " */\n" : "// " + text + "\n";
}

std::string CodeWriter::assignment(const std::string& left, const std::string& right,
                                   bool declares) const {
  if (language_ == CodeLanguage::python) return "    " + left + " = " + right + "\n";
  return (declares ? "  const double " : "  ") + left + " = " + right + ";\n";
}

std::string CodeWriter::operand(int id) const { return text_[static_cast<std::size_t>(id)]; }

std::string CodeWriter::text_of(const ComputationGraph::Node& node) const {
  using Operation = ComputationGraph::Operation;
  const std::string space = language_ == CodeLanguage::cpp ? "std::" : "";
  switch (node.operation) {
    case Operation::number:
      return literal(node.number);
    case Operation::constant:
      return node.name;
    case Operation::coordinate:
      return "q[" + number(node.number) + ']';
    case Operation::rate:
      return "dq[" + number(node.number) + ']';
    case Operation::cosine:
      return space + "cos(" + operand(node.a) + ')';
    case Operation::sine:
      return space + "sin(" + operand(node.a) + ')';
    case Operation::negate:
      return '-' + bracketed(operand(node.a));
    case Operation::add:
      return operand(node.a) + " + " + operand(node.b);
    case Operation::subtract:
      return operand(node.a) + " - " + bracketed(operand(node.b));
    case Operation::multiply:
      return bracketed(operand(node.a)) + " * " + bracketed(operand(node.b));
  }
  return "";
}

/// Writes the constants that occur and, in C and C++, statements that prevent warnings about unused
/// parameters.
std::string CodeWriter::head(const std::vector<int>& uses, bool rates) const {
  std::string text;
  bool uses_q = false, uses_dq = false;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    const ComputationGraph::Node& node = graph_.nodes()[i];
    if (uses[i] == 0) continue;
    uses_q = uses_q || node.operation == ComputationGraph::Operation::coordinate;
    uses_dq = uses_dq || node.operation == ComputationGraph::Operation::rate;
    if (node.operation == ComputationGraph::Operation::constant)
      text += assignment(node.name, literal(node.number), true);
  }
  if (language_ == CodeLanguage::python) return text;
  if (!uses_q) text += "  (void)q;\n";
  if (rates && !uses_dq) text += "  (void)dq;\n";
  return text;
}

std::string CodeWriter::store(const CodeOutput& output) const {
  if (output.columns == 0) {
    const std::string end = language_ == CodeLanguage::python ? "\n" : ";\n";
    const std::string indent = language_ == CodeLanguage::python ? "    " : "  ";
    return indent + "return " + operand(output.entries.front()) + end;
  }
  std::string text;
  if (language_ != CodeLanguage::python) {
    for (std::size_t i = 0; i < output.entries.size(); ++i) {
      text += assignment(output.name + '[' + std::to_string(i) + ']', operand(output.entries[i]),
                         false);
    }
    return text;
  }
  text = "    " + output.name + " = [\n";
  const auto columns = static_cast<std::size_t>(output.columns);
  for (std::size_t i = 0; i < output.entries.size(); ++i) {
    text += (i % columns == 0 ? "        [" : ", ") + operand(output.entries[i]);
    if (i % columns + 1 == columns) text += "],\n";
  }
  return text + "    ]\n";
}

std::string CodeWriter::body(const std::vector<CodeOutput>& outputs, bool rates) {
  std::vector<ComputationGraph::Id> all;
  for (const CodeOutput& output : outputs) {
    all.insert(all.end(), output.entries.begin(), output.entries.end());
  }
  const std::vector<int> uses = graph_.uses(all);
  std::string text = head(uses, rates);
  text_.assign(uses.size(), "");
  std::vector<bool> is_output(uses.size(), false);
  for (const ComputationGraph::Id output : all) is_output[static_cast<std::size_t>(output)] = true;
  int number = 0;
  for (std::size_t i = 0; i < uses.size(); ++i) {
    if (uses[i] == 0) continue;
    const ComputationGraph::Node& node = graph_.nodes()[i];
    text_[i] = text_of(node);
    const bool trig = node.operation == ComputationGraph::Operation::cosine ||
                      node.operation == ComputationGraph::Operation::sine;
    const bool leaf = !node.has_operands();
    const bool sign = node.operation == ComputationGraph::Operation::negate;
    const bool stored = uses[i] == 1 && is_output[i];
    const bool named = trig || (!leaf && !sign && uses[i] > 1) ||
                       (!leaf && !stored && text_[i].size() > longest_inline);
    if (!named) continue;
    const std::string name = trig ? node.name : "t" + std::to_string(++number);
    text += assignment(name, text_[i], true);
    text_[i] = name;
  }
  for (const CodeOutput& output : outputs) text += store(output);
  return text;
}

void CodeWriter::function(const std::string& suffix, const std::string& purpose, bool rates,
                          const std::vector<CodeOutput>& outputs) {
  const std::string name = prefix_ + '_' + suffix;
  std::vector<ComputationGraph::Id> all;
  for (const CodeOutput& output : outputs) {
    all.insert(all.end(), output.entries.begin(), output.entries.end());
  }
  const OperationCount count = count_operations(graph_, all);
  code_.functions.push_back(
      {name, purpose, count.multiplications, count.additions, count.trigonometric});
  const std::string operations = std::to_string(count.multiplications) + " multiplications, " +
                                 std::to_string(count.additions) + " additions, " +
                                 std::to_string(count.trigonometric) + " cosines and sines.";
  const std::string dof = std::to_string(arm_.dof);
  if (language_ == CodeLanguage::python) {
    std::string returned;
    for (const CodeOutput& output : outputs)
      returned += (returned.empty() ? "" : ", ") + output.name;
    const bool number = outputs.front().columns == 0;
    code_.text += "\n\ndef " + name + (rates ? "(q, dq):\n" : "(q):\n") + "    \"\"\"" + purpose +
                  "\n\n    " + operations + "\"\"\"\n" + body(outputs, rates) +
                  (number ? "" : "    return " + returned + "\n");
    return;
  }
  std::string parameters =
      "const double q[" + dof + ']' + (rates ? ", const double dq[" + dof + ']' : "");
  const bool number = outputs.front().columns == 0;
  for (const CodeOutput& output : outputs) {
    if (number) break;
    parameters += ", double " + output.name + '[' + std::to_string(output.entries.size()) + ']';
  }
  const std::string type = number ? "double " : "void ";
  code_.text += '\n' + comment(purpose) + comment(operations) + "BEELINE_FORMULA_FUNCTION " + type +
                name + '(' + parameters + ") {\n" + body(outputs, rates) + "}\n";
}

/// Adds an include guard in C and C++, named after the functions.
GeneratedCode CodeWriter::finish() {
  if (language_ != CodeLanguage::python) {
    std::string guard = "BEELINE_FORMULA_" + prefix_;
    for (const GeneratedFunction& function : code_.functions) {
      guard += function.name.substr(prefix_.size());
    }
    guard += "_H";
    code_.text = "#ifndef " + guard + "\n#define " + guard + "\n\n" + code_.text + "\n#endif\n";
  }
  return std::move(code_);
}

}  // namespace beeline::internal
