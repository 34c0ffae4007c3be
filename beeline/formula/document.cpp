#include <algorithm>
#include <set>

#include <beeline/formula/document.h>
#include <beeline/formula/internal/convention_text.h>
#include <beeline/formula/internal/notation.h>
#include <beeline/formula/internal/numbers_inserted.h>

namespace beeline {
namespace {

using internal::Notation;

/// Writes expressions and remembers which symbols and abbreviations occur.
class DocumentWriter {
 public:
  DocumentWriter(const SymbolicArm& arm, const FormulaStyle& style)
      : arm_(arm), style_(style), notation_(arm.symbols, style.latex) {}

  std::string text(const Expression& expression) {
    const Expression shown = style_.numbers ? internal::with_numbers(expression, arm_) : expression;
    const internal::Tree tree = internal::factored(shown);
    note(tree);
    return notation_.text(tree);
  }

  WrittenFormula matrix(const std::string& left, const ExpressionMatrix& matrix) {
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

  /// A pose; of a planar arm the 3 x 3 matrix of the plane.
  WrittenFormula pose(const std::string& left, const ExpressionMatrix& pose) {
    ExpressionMatrix shown = pose;
    if (in_plane(pose)) {
      shown = {
          3, 3, {pose(0, 0), pose(0, 1), pose(0, 3), pose(1, 0), pose(1, 1), pose(1, 3), 0, 0, 1}};
    }
    WrittenFormula written = matrix(left, shown);
    name_cells(written);
    return written;
  }

  WrittenFormula jacobian(const ExpressionMatrix& rows, const std::vector<std::string>& names,
                          bool derivative) {
    const std::string letter = derivative ? "dJ" : "J";
    WrittenFormula written = matrix(internal::subscripted(letter, "", style_.latex), rows);
    for (const std::string& name : names) written.row_names.push_back(row_name(name));
    written.cell_names.assign(rows.rows, std::vector<std::string>(rows.columns));
    const std::string comma = rows.columns > 9 ? "," : "";
    for (std::size_t row = 0; row < rows.rows; ++row) {
      for (std::size_t k = 0; k < rows.columns; ++k) {
        const std::string index = std::to_string(row + 1) + comma + std::to_string(k + 1);
        written.cell_names[row][k] = internal::subscripted(letter, index, style_.latex);
      }
    }
    return written;
  }

  std::string transform(const std::string& below, const std::string& above) const {
    if (style_.latex) return "T_{" + below + "}^{" + above + "}";
    constexpr const char* superscripts[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = internal::subscripted("T", below, false);
    for (const char c : above) text += c >= '0' && c <= '9' ? superscripts[c - '0'] : "ʷ";
    return text;
  }

  std::string theta() const { return internal::subscripted("theta", "", style_.latex); }

  std::string angle(const PlanarAngle& angle) {
    std::string text = angle.angle.is_zero() ? "" : notation_.angle(angle.angle);
    for (const auto& [number, multiple] : angle.angle.multiples) symbols_.insert(number);
    if (angle.fifteenths == 0) return text.empty() ? "0" : text;
    const char* minus = style_.latex ? "-" : "−";
    const std::string degrees =
        std::to_string(std::abs(angle.fifteenths) * 15) + (style_.latex ? "^{\\circ}" : "°");
    const std::string sign = angle.fifteenths < 0 ? minus : "+";
    if (text.empty()) return (angle.fifteenths < 0 ? minus : "") + degrees;
    return text + ' ' + sign + ' ' + degrees;
  }

  std::vector<WrittenSymbol> symbols() const {
    std::vector<WrittenSymbol> found;
    for (const int number : symbols_) {
      const Symbol& symbol = arm_.symbols[static_cast<std::size_t>(number)];
      if (symbol.coordinate >= 0 && symbol.ratio == 1 && symbol.value == 0) continue;
      const bool length = symbol.kind == SymbolKind::length;
      std::string meaning = symbol.meaning;
      if (symbol.coordinate >= 0) {
        meaning += ": " + number_of(symbol.ratio) + " q" + std::to_string(symbol.coordinate + 1) +
                   " + " + number_of(symbol.value);
      }
      found.push_back(
          {notation_.symbol(number), symbol.name(), symbol.value, length ? "m" : "rad", meaning});
    }
    return found;
  }

  std::vector<std::pair<std::string, std::string>> abbreviations() const {
    std::vector<std::pair<std::string, std::string>> found;
    for (const Trig& trig : trigs_) {
      const std::string meaning = notation_.meaning(trig);
      if (!meaning.empty()) found.emplace_back(notation_.trig(trig), meaning);
    }
    return found;
  }

 private:
  std::string row_name(const std::string& name) const {
    if (!style_.latex) return name == "theta" ? "θ" : name;
    if (name == "theta") return "\\theta";
    return name.size() == 2 ? (name[0] == 'w' ? "\\omega_" : "v_") + name.substr(1) : name;
  }

  static std::string number_of(double value) { return internal::decimal(value); }

  bool in_plane(const ExpressionMatrix& pose) const {
    return arm_.planar && pose(0, 2).is_zero() && pose(1, 2).is_zero() && pose(2, 0).is_zero() &&
           pose(2, 1).is_zero() && pose(2, 3).is_zero() && pose(2, 2) == Expression(1);
  }

  void name_cells(WrittenFormula& written) const {
    constexpr const char* axes[] = {"x", "y", "z"};
    const std::size_t size = written.cells.size();
    written.cell_names.assign(size, std::vector<std::string>(size));
    for (std::size_t row = 0; row + 1 < size; ++row) {
      for (std::size_t column = 0; column < size; ++column) {
        const std::string index = std::to_string(row + 1) + std::to_string(column + 1);
        written.cell_names[row][column] =
            column + 1 == size ? axes[row] : internal::subscripted("r", index, style_.latex);
      }
    }
  }

  void note(const internal::Tree& tree) {
    if (tree.kind == internal::Tree::Kind::symbol) symbols_.insert(tree.symbol);
    if (tree.kind == internal::Tree::Kind::trig) {
      trigs_.insert(tree.trig);
      for (const auto& [number, multiple] : tree.trig.angle.multiples) symbols_.insert(number);
    }
    for (const internal::Tree& part : tree.parts) note(part);
  }

  const SymbolicArm& arm_;
  FormulaStyle style_;
  Notation notation_;
  std::set<int> symbols_;
  std::set<Trig> trigs_;
};

bool is_identity(const ExpressionMatrix& matrix) {
  for (std::size_t row = 0; row < matrix.rows; ++row) {
    for (std::size_t column = 0; column < matrix.columns; ++column) {
      if (!(matrix(row, column) == Expression(row == column ? 1 : 0))) return false;
    }
  }
  return true;
}

WrittenSection links_section(DocumentWriter& writer, const SymbolicArm& arm) {
  WrittenSection section{.key = "links", .title = "Transforms of the links"};
  const ExpressionMatrix base = base_formula(arm), flange = flange_formula(arm);
  if (!is_identity(base)) section.formulas.push_back(writer.pose(writer.transform("0", "w"), base));
  for (std::size_t i = 1; i <= arm.links(); ++i) {
    section.formulas.push_back(writer.pose(
        writer.transform(std::to_string(i), std::to_string(i - 1)), link_formula(arm, i, i - 1)));
  }
  if (!is_identity(flange)) {
    section.formulas.push_back(
        writer.pose(writer.transform("t", std::to_string(arm.links())), flange));
  }
  return section;
}

WrittenSection products_section(DocumentWriter& writer, const SymbolicArm& arm) {
  WrittenSection section{.key = "products", .title = "Poses of the links in the base"};
  for (std::size_t i = 2; i <= arm.links(); ++i) {
    section.formulas.push_back(
        writer.pose(writer.transform(std::to_string(i), "0"), link_formula(arm, i, 0)));
  }
  return section;
}

WrittenSection tool_section(DocumentWriter& writer, const SymbolicArm& arm) {
  WrittenSection section{.key = "tool", .title = "Pose of the tool in the world"};
  const ExpressionMatrix pose = tool_formula(arm);
  section.formulas.push_back(writer.pose("T", pose));
  if (arm.planar) {
    section.formulas.push_back({"x", {{writer.text(pose(0, 3))}}});
    section.formulas.push_back({"y", {{writer.text(pose(1, 3))}}});
    section.formulas.push_back({writer.theta(), {{writer.angle(planar_angle(arm))}}});
  }
  return section;
}

const char* frame_meaning(Frame frame) {
  switch (frame) {
    case Frame::base:
      return "velocity of the tool's origin, in the world's axes";
    case Frame::tool:
      return "velocity of the tool's origin, in the tool's axes";
    case Frame::space:
      return "spatial twist, at the world's origin";
  }
  return "";
}

ExpressionMatrix task_rows_of(const ExpressionMatrix& matrix, const Task& task) {
  ExpressionMatrix rows{0, matrix.columns, {}};
  for (std::size_t row = 0; row < matrix.rows; ++row) {
    if (!task.rows[row]) continue;
    for (std::size_t k = 0; k < matrix.columns; ++k) rows.entries.push_back(matrix(row, k));
    ++rows.rows;
  }
  return rows;
}

/// The Jacobian, or its time derivative.
WrittenSection jacobian_section(DocumentWriter& writer, const SymbolicArm& arm,
                                const FormulaContent& content, bool derivative) {
  ExpressionMatrix matrix = jacobian_formula(arm, content.frame);
  if (derivative) matrix = time_derivative(arm, matrix);
  const std::string what = derivative ? "Time derivative of the Jacobian" : "Jacobian";
  WrittenSection section{
      .key = derivative ? "derivative" : "jacobian",
      .title = what + " in the " + name(content.frame) + " frame: " + frame_meaning(content.frame)};
  section.remarks.push_back("Columns: joints " + listed(arm.joint_names) + ".");
  if (content.task != Task::planar()) {
    section.remarks.front() +=
        " Rows: " + listed(row_names({content.task.rows, Frame::base})) + ".";
  }
  section.formulas.push_back(writer.jacobian(
      task_rows_of(matrix, content.task), row_names({content.task.rows, Frame::base}), derivative));
  return section;
}

}  // namespace

std::string written(const Expression& expression, const SymbolicArm& arm,
                    const FormulaStyle& style) {
  return DocumentWriter(arm, style).text(expression);
}

FormulaDocument formula_document(const SymbolicArm& arm, const FormulaContent& content,
                                 const FormulaStyle& style) {
  DocumentWriter writer(arm, style);
  FormulaDocument document{.title = "Formulas of " + arm.name,
                           .convention = internal::convention_text(arm.convention, style.latex),
                           .latex = style.latex};
  if (content.forward) document.sections.push_back(links_section(writer, arm));
  if (content.products) document.sections.push_back(products_section(writer, arm));
  if (content.forward) document.sections.push_back(tool_section(writer, arm));
  if (content.jacobian) {
    document.sections.push_back(jacobian_section(writer, arm, content, false));
  }
  if (content.derivative) {
    document.sections.push_back(jacobian_section(writer, arm, content, true));
  }
  document.symbols = writer.symbols();
  document.abbreviations = writer.abbreviations();
  if (arm.rounding > 1e-15) {
    document.notes.push_back(
        "Constant angles near a multiple of 15 degrees are taken as that multiple; the largest "
        "change is " +
        number(arm.rounding) + " rad.");
  }
  return document;
}

}  // namespace beeline
