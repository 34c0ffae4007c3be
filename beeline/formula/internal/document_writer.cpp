#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include <beeline/formula/internal/document_writer.h>
#include <beeline/formula/internal/numbers_inserted.h>

namespace beeline::internal {
namespace {

/// Adds the symbols and the cosines and sines of a tree.
void collect(const Tree& tree, std::set<int>& symbols, std::set<Trig>& trigs) {
  if (tree.kind == Tree::Kind::symbol) symbols.insert(tree.symbol);
  if (tree.kind == Tree::Kind::trig) {
    trigs.insert(tree.trig);
    for (const auto& [number, multiple] : tree.trig.angle.multiples) symbols.insert(number);
  }
  for (const Tree& part : tree.parts) collect(part, symbols, trigs);
}

}  // namespace

/// Returns the expression as a tree, with the constants as numbers if the style requests it.
Tree DocumentWriter::tree(const Expression& expression) {
  return factored(style_.numbers ? with_numbers(expression, arm_) : expression);
}

std::string DocumentWriter::text(const Expression& expression) {
  const Tree written = tree(expression);
  collect(written, symbols_, trigs_);
  return notation_.text(written);
}

std::string DocumentWriter::text(const DeterminantFormula& determinant) {
  Tree product = tree(determinant.constant);
  if (product.kind != Tree::Kind::product) {
    product = {.kind = Tree::Kind::product, .parts = {product}};
    if (product.parts.front().kind == Tree::Kind::number) {
      product.coefficient = product.parts.front().coefficient;
      product.parts.clear();
    }
  }
  for (const auto& [factor, exponent] : determinant.factors) {
    Tree part = tree(factor);
    if (part.kind == Tree::Kind::product && part.parts.size() == 1 &&
        part.coefficient == Coefficient(1)) {
      part = Tree(part.parts.front());
    }
    if (exponent > 1) part = {.kind = Tree::Kind::power, .exponent = exponent, .parts = {part}};
    product.parts.push_back(std::move(part));
  }
  if (product.parts.size() == 1 && product.coefficient == Coefficient(1)) {
    product = Tree(product.parts.front());
  }
  collect(product, symbols_, trigs_);
  return notation_.text(product);
}

double in_degrees(double radians) {
  const double degrees = radians * 180 / std::numbers::pi;
  const double rounded = std::round(degrees * 1e9) / 1e9;  // 20, not 20.000000000000004
  return std::abs(degrees - rounded) <= 1e-13 * std::abs(degrees) ? rounded : degrees;
}

WrittenFormula DocumentWriter::matrix(const std::string& left, const ExpressionMatrix& matrix) {
  WrittenFormula written{.left = left};
  for (std::size_t row = 0; row < matrix.rows; ++row) {
    std::vector<std::string> cells;
    for (std::size_t column = 0; column < matrix.columns; ++column) {
      cells.push_back(text(matrix(row, column)));
    }
    written.cells.push_back(std::move(cells));
  }
  return written;
}

WrittenFormula DocumentWriter::pose(const std::string& left, const ExpressionMatrix& pose) {
  ExpressionMatrix shown = pose;
  if (in_plane(pose)) {
    shown = {
        3, 3, {pose(0, 0), pose(0, 1), pose(0, 3), pose(1, 0), pose(1, 1), pose(1, 3), 0, 0, 1}};
  }
  WrittenFormula written = matrix(left, shown);
  name_cells(written);
  return written;
}

WrittenFormula DocumentWriter::jacobian(const ExpressionMatrix& rows,
                                        const std::vector<std::string>& names, bool derivative) {
  const std::string letter = derivative ? "dJ" : "J";
  WrittenFormula written = matrix(subscripted(letter, "", style_.latex), rows);
  for (const std::string& name : names) written.row_names.push_back(row_name(name));
  written.cell_names.assign(rows.rows, std::vector<std::string>(rows.columns));
  const std::string comma = rows.columns > 9 ? "," : "";
  for (std::size_t row = 0; row < rows.rows; ++row) {
    for (std::size_t k = 0; k < rows.columns; ++k) {
      const std::string index = std::to_string(row + 1) + comma + std::to_string(k + 1);
      written.cell_names[row][k] = subscripted(letter, index, style_.latex);
    }
  }
  return written;
}

std::string DocumentWriter::transform(const std::string& below, const std::string& above) const {
  if (style_.latex) return "T_{" + below + "}^{" + above + "}";
  constexpr const char* superscripts[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = subscripted("T", below, false);
  for (const char c : above) text += c >= '0' && c <= '9' ? superscripts[c - '0'] : "ʷ";
  return text;
}

std::string DocumentWriter::angle(const PlanarAngle& angle) {
  std::string text = angle.angle.is_zero() ? "" : notation_.angle(angle.angle);
  for (const auto& [number, multiple] : angle.angle.multiples) symbols_.insert(number);
  if (angle.multiple_of_15_degrees == 0) return text.empty() ? "0" : text;
  const char* minus = style_.latex ? "-" : "−";
  const std::string degrees = std::to_string(std::abs(angle.multiple_of_15_degrees) * 15) +
                              (style_.latex ? "^{\\circ}" : "°");
  const std::string sign = angle.multiple_of_15_degrees < 0 ? minus : "+";
  if (text.empty()) return (angle.multiple_of_15_degrees < 0 ? minus : "") + degrees;
  return text + ' ' + sign + ' ' + degrees;
}

std::vector<WrittenFormula> DocumentWriter::derivation(const InverseDerivation& derivation) {
  const Notation notation(derivation.symbols, style_.latex);
  std::vector<WrittenFormula> written;
  for (const InverseStep& step : derivation.steps) {
    const Tree right = style_.numbers ? with_numbers(step.right, derivation.symbols) : step.right;
    std::set<int> symbols;
    std::set<Trig> trigs;
    collect(right, symbols, trigs);
    for (const int symbol : symbols) {
      if (symbol < static_cast<int>(arm_.symbols.size())) symbols_.insert(symbol);
    }
    written.push_back({notation.symbol(step.symbol), {{notation.text(right)}}});
    written.back().explanation = step.explanation;
  }
  return written;
}

std::vector<std::string> DocumentWriter::remarks(const InverseDerivation& derivation) const {
  const Notation notation(derivation.symbols, style_.latex);
  std::vector<std::string> sentences;
  for (const InverseRemark& remark : derivation.remarks) {
    sentences.emplace_back();
    std::size_t next = 0;
    for (const char c : remark.sentence) {
      if (c != '@') {
        sentences.back() += c;
        continue;
      }
      const std::string symbol = notation.symbol(remark.symbols[next++]);
      sentences.back() += style_.latex ? '$' + symbol + '$' : symbol;
    }
  }
  return sentences;
}

std::vector<WrittenSymbol> DocumentWriter::symbols() const {
  std::vector<WrittenSymbol> found;
  for (const int number : symbols_) {
    const Symbol& symbol = arm_.symbols[static_cast<std::size_t>(number)];
    if (symbol.is_coordinate() || symbol.kind == SymbolKind::rate) continue;
    found.push_back(written_symbol(number));
  }
  return found;
}

WrittenSymbol DocumentWriter::written_symbol(int number) const {
  const Symbol& symbol = arm_.symbols[static_cast<std::size_t>(number)];
  const bool length = symbol.kind == SymbolKind::length || symbol.kind == SymbolKind::displacement;
  const bool pitch = symbol.kind == SymbolKind::pitch;
  const bool degrees = style_.degrees && !length && !pitch;
  const double value = degrees ? in_degrees(symbol.value) : symbol.value;
  const std::string unit = length ? "m" : pitch ? "m/rad" : degrees ? "deg" : "rad";
  WrittenSymbol written{notation_.symbol(number), symbol.name(), value, unit, symbol.meaning};
  if (symbol.coordinate < 0) return written;
  const auto followed = static_cast<std::size_t>(symbol.coordinate);
  const int other = arm_.coordinates[followed];
  const bool other_slides =
      arm_.symbols[static_cast<std::size_t>(other)].kind == SymbolKind::displacement;
  written.multiplier = symbol.ratio;
  if (style_.degrees && length != other_slides) {
    written.multiplier *= length ? std::numbers::pi / 180 : 180 / std::numbers::pi;
  }
  written.offset = value;
  written.joint = arm_.joint_names[followed];
  const auto constant = [](double amount) {
    return amount == std::round(amount) && std::abs(amount) < 1e9
               ? Coefficient(static_cast<std::int64_t>(amount))
               : Coefficient::plain(amount);
  };
  const Tree product =
      factored(Expression(constant(written.multiplier)) * Expression::symbol(other));
  const Tree shift{.coefficient = constant(value)};
  written.formula = notation_.text(
      value == 0 ? product : Tree{.kind = Tree::Kind::sum, .parts = {shift, product}});
  return written;
}

std::vector<std::pair<std::string, std::string>> DocumentWriter::abbreviations() const {
  std::vector<std::pair<std::string, std::string>> found;
  for (const Trig& trig : trigs_) {
    const std::string meaning = notation_.meaning(trig);
    if (!meaning.empty()) found.emplace_back(notation_.trig(trig), meaning);
  }
  return found;
}

std::string DocumentWriter::row_name(const std::string& name) const {
  if (!style_.latex) return name == "theta" ? "θ" : name;
  if (name == "theta") return "\\theta";
  return name.size() == 2 ? (name[0] == 'w' ? "\\omega_" : "v_") + name.substr(1) : name;
}

bool DocumentWriter::in_plane(const ExpressionMatrix& pose) const {
  return arm_.planar && pose(0, 2).is_zero() && pose(1, 2).is_zero() && pose(2, 0).is_zero() &&
         pose(2, 1).is_zero() && pose(2, 3).is_zero() && pose(2, 2) == Expression(1);
}

void DocumentWriter::name_cells(WrittenFormula& written) const {
  constexpr const char* axes[] = {"x", "y", "z"};
  const std::size_t size = written.cells.size();
  written.cell_names.assign(size, std::vector<std::string>(size));
  for (std::size_t row = 0; row + 1 < size; ++row) {
    for (std::size_t column = 0; column < size; ++column) {
      const std::string index = std::to_string(row + 1) + std::to_string(column + 1);
      written.cell_names[row][column] =
          column + 1 == size ? axes[row] : subscripted("r", index, style_.latex);
    }
  }
}

}  // namespace beeline::internal
