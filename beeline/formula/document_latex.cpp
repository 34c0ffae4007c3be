#include <algorithm>

#include <beeline/formula/document.h>
#include <beeline/formula/internal/notation.h>

namespace beeline {
namespace {

constexpr std::size_t matrix_letters = 120;  // max letters on a landscape page
constexpr std::size_t line_letters = 100;  // letters after which a line is broken at the next sign

/// Returns about how many letters wide a formula is: a command counts as one, braces and spaces do
/// not count.
std::size_t latex_width(const std::string& latex) {
  std::size_t letters = 0;
  bool command = false;
  for (const char c : latex) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    if (command && letter) continue;
    command = c == '\\';
    if (c != '{' && c != '}' && c != '_' && c != '^' && c != ' ') ++letters;
  }
  return letters;
}

/// Breaks a long formula before a sign outside of braces, for an align environment.
std::string broken(const std::string& latex) {
  std::string result, line;
  int depth = 0;
  for (std::size_t i = 0; i < latex.size(); ++i) {
    const char c = latex[i];
    depth += c == '{' ? 1 : c == '}' ? -1 : 0;
    const bool sign = depth == 0 && c == ' ' && i + 2 < latex.size() && latex[i + 2] == ' ' &&
                      (latex[i + 1] == '+' || latex[i + 1] == '-');
    if (sign && latex_width(line) > line_letters) {
      result += line + " \\\\\n  &\\quad";
      line.clear();
    }
    line += c;
  }
  return result + line;
}

std::string matrix(const WrittenFormula& formula) {
  std::string text = "\\begin{pmatrix}\n";
  for (const std::vector<std::string>& row : formula.cells) {
    for (std::size_t k = 0; k < row.size(); ++k) text += (k == 0 ? "  " : " & ") + row[k];
    text += " \\\\\n";
  }
  return text + "\\end{pmatrix}";
}

std::size_t matrix_width(const WrittenFormula& formula) {
  std::size_t sum = 0;
  for (std::size_t k = 0; k < formula.cells.front().size(); ++k) {
    std::size_t widest = 0;
    for (const auto& row : formula.cells) widest = std::max(widest, latex_width(row[k]));
    sum += widest + 2;
  }
  return sum;
}

std::string latex_entries(const WrittenFormula& formula) {
  std::string lines;
  for (std::size_t k = 0; k < formula.cells.front().size(); ++k) {
    std::string zeros;  // on one line
    for (std::size_t row = 0; row < formula.cells.size(); ++row) {
      const std::string& name = formula.cell_names[row][k];
      if (name.empty()) continue;
      if (formula.cells[row][k] == "0") {
        zeros += (zeros.empty() ? "" : " = ") + name;
        continue;
      }
      lines += (lines.empty() ? "  " : " \\\\\n  ") + name + " &= " + broken(formula.cells[row][k]);
    }
    if (!zeros.empty()) lines += (lines.empty() ? "  " : " \\\\\n  ") + zeros + " &= 0";
  }
  return "\\begin{align*}\n" + lines + "\n\\end{align*}\n";
}

bool is_line(const WrittenFormula& formula) {
  return formula.cells.size() == 1 && formula.cells.front().size() == 1;
}

/// Writes the formulas from number i up to the next explanation. Sets i to the number of the last
/// one.
std::string lines(const std::vector<WrittenFormula>& formulas, std::size_t& i) {
  std::string text = "\\begin{align*}\n";
  for (;; ++i) {
    text += "  " + formulas[i].left + " &= " + broken(formulas[i].cells[0][0]);
    const bool last = i + 1 == formulas.size() || !is_line(formulas[i + 1]) ||
                      !formulas[i + 1].explanation.empty();
    if (last) return text + "\n\\end{align*}\n";
    text += " \\\\\n";
  }
}

std::string latex_of(const WrittenFormula& formula) {
  if (matrix_width(formula) > matrix_letters) {
    return "\\noindent $" + formula.left + "$, column by column:\n" + latex_entries(formula);
  }
  return "\\[\n" + formula.left + " = " + matrix(formula) + "\n\\]\n";
}

std::string latex_symbols(const FormulaDocument& document) {
  std::string text;
  if (!document.symbols.empty()) {
    text += "\\begin{tabular}{@{}lll@{}}\n";
    for (const WrittenSymbol& symbol : document.symbols) {
      const std::string value = symbol.formula.empty()
                                    ? internal::decimal(symbol.value) + " " + symbol.unit
                                    : '$' + symbol.formula + "$, " + symbol.unit;
      text += "  $" + symbol.name + "$ & " + value + " & " +
              internal::escaped_latex(symbol.meaning) + " \\\\\n";
    }
    text += "\\end{tabular}\n\n";
  }
  std::string list;
  for (const auto& [name, meaning] : document.abbreviations) {
    list += (list.empty() ? "\\noindent $" : ", $") + name + " = " + meaning + "$";
  }
  return text + (list.empty() ? "" : list + ".\n");
}

}  // namespace

std::string latex_of(const FormulaDocument& document, bool standalone) {
  std::string text;
  if (standalone) {
    text =
        "\\documentclass{article}\n"
        "\\usepackage[a4paper,landscape,margin=15mm]{geometry}\n\\usepackage{amsmath}\n"
        "\\setcounter{MaxMatrixCols}{64}\n\\setlength{\\parindent}{0pt}\n\\allowdisplaybreaks\n"
        "\\begin{document}\n";
  }
  text +=
      "\\section*{" + internal::escaped_latex(document.title) + "}\n" + document.convention + "\n";
  for (const WrittenSection& section : document.sections) {
    text += "\n\\subsection*{" + internal::escaped_latex(section.title) + "}\n";
    for (const std::string& remark : section.remarks) text += remark + "\n\n";
    for (std::size_t i = 0; i < section.formulas.size(); ++i) {
      const WrittenFormula& formula = section.formulas[i];
      if (!formula.explanation.empty()) text += formula.explanation + "\n";
      text += is_line(formula) ? lines(section.formulas, i) : latex_of(formula);
    }
    for (const std::string& sentence : section.sentences) text += sentence + "\n\n";
  }
  const std::string symbols = latex_symbols(document);
  if (!symbols.empty()) text += "\n\\subsection*{where}\n" + symbols;
  for (const std::string& note : document.notes) text += "\n" + note + "\n";
  return text + (standalone ? "\\end{document}\n" : "");
}

}  // namespace beeline
