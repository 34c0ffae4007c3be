#include <algorithm>

#include <beeline/formula/document.h>
#include <beeline/formula/internal/notation.h>
#include <beeline/internal/utf8.h>

namespace beeline {
namespace {

constexpr std::size_t page_width = 100;  // columns

/// Returns the width of a text in a terminal: its number of characters, except combining dots.
std::size_t width(const std::string& text) {
  std::size_t columns = 0;
  for (const char byte : text) {
    const bool combining = byte == '\xcc';  // U+0300 to U+033F
    if (!internal::continues_character(byte) && !combining) ++columns;
  }
  return columns;
}

std::string padded(const std::string& text, std::size_t columns) {
  return text + std::string(columns - std::min(columns, width(text)), ' ');
}

std::vector<std::size_t> column_widths(const WrittenFormula& formula) {
  std::vector<std::size_t> widths(formula.cells.front().size(), 0);
  for (const std::vector<std::string>& row : formula.cells) {
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], width(row[k]));
  }
  return widths;
}

std::string as_matrix(const WrittenFormula& formula, const std::vector<std::size_t>& widths) {
  std::string text;
  std::size_t names = 0;
  for (const std::string& name : formula.row_names) names = std::max(names, width(name) + 2);
  for (std::size_t row = 0; row < formula.cells.size(); ++row) {
    const std::string left = row == 0 ? formula.left + " = " : "";
    text += "  " + padded(left, width(formula.left) + 3);
    if (names > 0) text += padded(formula.row_names[row], names);
    text += "[ ";
    for (std::size_t k = 0; k < widths.size(); ++k) {
      text += padded(formula.cells[row][k], widths[k]) + (k + 1 < widths.size() ? "  " : "");
    }
    text += " ]\n";
  }
  return text;
}

std::string as_entries(const WrittenFormula& formula) {
  std::string text = "  " + formula.left + ", column by column\n";
  const std::size_t columns = formula.cells.front().size();
  for (std::size_t k = 0; k < columns; ++k) {
    std::string zeros;  // on one line
    for (std::size_t row = 0; row < formula.cells.size(); ++row) {
      const std::string& name = formula.cell_names[row][k];
      if (name.empty()) continue;
      if (formula.cells[row][k] == "0") {
        zeros += name + " = ";
      } else {
        text += "    " + padded(name, 4) + " = " + formula.cells[row][k] + "\n";
      }
    }
    if (!zeros.empty()) text += "    " + zeros + "0\n";
    if (k + 1 < columns) text += "\n";
  }
  return text;
}

std::string text_of(const WrittenFormula& formula) {
  if (formula.cells.size() == 1 && formula.cells.front().size() == 1) {
    return "  " + formula.left + " = " + formula.cells[0][0] + "\n";
  }
  const std::vector<std::size_t> widths = column_widths(formula);
  std::size_t total = width(formula.left) + 8;
  for (const std::size_t column : widths) total += column + 2;
  return total <= page_width ? as_matrix(formula, widths) : as_entries(formula);
}

/// Breaks a sentence into lines of the page's width.
std::string wrapped(const std::string& sentence, const std::string& indent) {
  std::string text, line = indent;
  std::size_t begin = 0;
  while (begin < sentence.size()) {
    const std::size_t end = std::min(sentence.find(' ', begin), sentence.size());
    const std::string word = sentence.substr(begin, end - begin);
    if (line != indent && width(line) + 1 + width(word) > page_width) {
      text += line + "\n";
      line = indent;
    }
    line += (line == indent ? "" : " ") + word;
    begin = end + 1;
  }
  return text + line + "\n";
}

std::string symbol_table(const FormulaDocument& document) {
  std::string text;
  std::size_t names = 0;
  for (const WrittenSymbol& symbol : document.symbols) names = std::max(names, width(symbol.name));
  for (const WrittenSymbol& symbol : document.symbols) {
    const bool constant = symbol.formula.empty();
    const std::string value =
        constant ? internal::decimal(symbol.value) + ' ' + symbol.unit : symbol.formula;
    text += "  " + padded(symbol.name, names) + " = " + padded(value, 16) + "  " + symbol.meaning +
            (constant ? "" : ", " + symbol.unit) + "\n";
  }
  std::string line = "  ";
  for (std::size_t i = 0; i < document.abbreviations.size(); ++i) {
    const auto& [name, meaning] = document.abbreviations[i];
    const bool last = i + 1 == document.abbreviations.size();
    const std::string item = name + " = " + meaning + (last ? "" : ", ");
    if (width(line) + width(item) > page_width) {
      text += line + "\n";
      line = "  ";
    }
    line += item;
  }
  return text + (document.abbreviations.empty() ? "" : line + "\n");
}

}  // namespace

std::string text_of(const FormulaDocument& document) {
  std::string text = document.title + "\n" + wrapped(document.convention, "");
  for (const WrittenSection& section : document.sections) {
    text += "\n" + section.title + "\n";
    for (const std::string& remark : section.remarks) text += wrapped(remark, "  ");
    for (std::size_t i = 0; i < section.formulas.size(); ++i) {
      const WrittenFormula& formula = section.formulas[i];
      const bool spaced = i > 0 && formula.cells.size() > 1;
      if (!formula.explanation.empty()) text += wrapped(formula.explanation, "  ");
      text += (spaced ? "\n" : "") + text_of(formula);
    }
    for (const std::string& sentence : section.sentences) text += wrapped(sentence, "  ");
  }
  const std::string symbols = symbol_table(document);
  if (!symbols.empty()) text += "\nwhere\n" + symbols;
  for (const std::string& note : document.notes) text += "\n" + wrapped(note, "");
  return text;
}

}  // namespace beeline
