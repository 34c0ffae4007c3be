#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/formula/document.h>
#include <beeline/formula/internal/document_writer.h>
#include <beeline/formula/internal/numeric_twists.h>
#include <beeline/formula/internal/planar_inverse.h>
#include <beeline/formula/internal/singularity.h>

namespace beeline {
namespace {

using internal::DocumentWriter;

/// Returns a sentence on the names of an arm's dimensions.
struct Sentence {
  const char* text;
  const char* latex;
};

constexpr Sentence convention_sentence(NamingConvention convention) {
  switch (convention) {
    case NamingConvention::planar:
      return {"Planar links: Tᵢ = Rz(qᵢ + θᵢ) Tx(aᵢ), for a prismatic joint Rz(θᵢ) Tx(aᵢ + qᵢ).",
              "Planar links: $T_i = R_z(q_i + \\theta_i)\\,T_x(a_i)$, for a prismatic joint "
              "$R_z(\\theta_i)\\,T_x(a_i + q_i)$."};
    case NamingConvention::standard:
      return {
          "Standard Denavit-Hartenberg parameters: Tᵢ = Rz(qᵢ + θᵢ) Tz(dᵢ) Tx(aᵢ) Rx(αᵢ), "
          "for a prismatic joint Rz(θᵢ) Tz(qᵢ + dᵢ) Tx(aᵢ) Rx(αᵢ).",
          "Standard Denavit--Hartenberg parameters: $T_i = "
          "R_z(q_i + \\theta_i)\\,T_z(d_i)\\,T_x(a_i)\\,R_x(\\alpha_i)$, for a prismatic joint "
          "$R_z(\\theta_i)\\,T_z(q_i + d_i)\\,T_x(a_i)\\,R_x(\\alpha_i)$."};
    case NamingConvention::modified:
      return {
          "Modified Denavit-Hartenberg parameters: Tᵢ = Tx(aᵢ₋₁) Rx(αᵢ₋₁) Rz(qᵢ + θᵢ) Tz(dᵢ), "
          "for a prismatic joint Tx(aᵢ₋₁) Rx(αᵢ₋₁) Rz(θᵢ) Tz(qᵢ + dᵢ).",
          "Modified Denavit--Hartenberg parameters: $T_i = "
          "T_x(a_{i-1})\\,R_x(\\alpha_{i-1})\\,R_z(q_i + \\theta_i)\\,T_z(d_i)$, for a prismatic "
          "joint $T_x(a_{i-1})\\,R_x(\\alpha_{i-1})\\,R_z(\\theta_i)\\,T_z(q_i + d_i)$."};
    case NamingConvention::offsets:
      break;
  }
  return {
      "Tᵢ is the offset of joint i in link i−1, a translation (xᵢ, yᵢ, zᵢ) and fixed rotations, "
      "then the motion of the joint.",
      "$T_i$ is the offset of joint $i$ in link $i-1$, a translation $(x_i, y_i, z_i)$ and fixed "
      "rotations, then the motion of the joint."};
}

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
  const ExpressionMatrix base = base_formula(arm), tool = tool_offset_formula(arm);
  if (!is_identity(base)) section.formulas.push_back(writer.pose(writer.transform("0", "w"), base));
  for (std::size_t i = 1; i <= arm.links(); ++i) {
    section.formulas.push_back(writer.pose(
        writer.transform(std::to_string(i), std::to_string(i - 1)), link_formula(arm, i, i - 1)));
  }
  if (!is_identity(tool)) {
    section.formulas.push_back(
        writer.pose(writer.transform("t", std::to_string(arm.links())), tool));
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
    const std::optional<PlanarAngle> theta = planar_angle(arm);
    if (theta) section.formulas.push_back({writer.theta(), {{writer.angle(*theta)}}});
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

/// Writes the Jacobian, or its time derivative.
WrittenSection jacobian_section(DocumentWriter& writer, const SymbolicArm& arm,
                                const FormulaContent& content, bool derivative) {
  ExpressionMatrix matrix = jacobian_formula(arm, content.frame);
  if (derivative) matrix = time_derivative(arm, matrix);
  const std::string what = derivative ? "Time derivative of the Jacobian" : "Jacobian";
  WrittenSection section{
      .key = derivative ? "derivative" : "jacobian",
      .title = what + " in the " + name(content.frame) + " frame: " + frame_meaning(content.frame)};
  const std::string joints = listed(arm.joint_names);
  section.remarks.push_back("Columns: joints " +
                            (writer.notation().latex() ? internal::escaped_latex(joints) : joints) +
                            ". Rows: " + listed(row_names({content.task.rows, Frame::base})) + ".");
  section.formulas.push_back(writer.jacobian(
      task_rows_of(matrix, content.task), row_names({content.task.rows, Frame::base}), derivative));
  return section;
}

WrittenSection determinant_section(DocumentWriter& writer, const SymbolicArm& arm, const Task& task,
                                   const FormulaStyle& style) {
  const DeterminantFormula determinant = determinant_formula(arm, task);
  WrittenSection section{.key = "determinant", .title = "Determinant of the Jacobian"};
  section.remarks.push_back("Rows: " + listed(row_names(task)) +
                            ". Expanded for the velocity of the origin of " + determinant.origin +
                            ", in the axes of " + determinant.axes + ".");
  const std::string left = writer.notation().latex() ? "\\det J" : "det J";
  section.formulas.push_back({left, {{writer.text(determinant)}}});
  section.sentences = internal::singularities(arm, determinant, style);
  return section;
}

WrittenSection inverse_section(DocumentWriter& writer, const SymbolicArm& arm) {
  const internal::InverseDerivation derivation = internal::planar_inverse(arm);
  WrittenSection section{.key = "inverse", .title = "Inverse kinematics"};
  const std::string given = derivation.theta >= 0 ? "x, y, theta" : "x, y";
  section.remarks.push_back("Given the tool's " + given + ".");
  section.formulas = writer.derivation(derivation);
  section.sentences = writer.remarks(derivation);
  return section;
}

/// Returns notes on numbers that were rounded, and on numbers that could be.
std::vector<std::string> notes_of(const SymbolicArm& arm) {
  std::vector<std::string> notes;
  if (arm.rounding > 1e-14) {
    notes.push_back(
        "Constant angles near a multiple of 15 degrees are taken as exact. The largest change is " +
        number(arm.rounding) + " rad; it changes the pose by at most " + number(arm.deviation) +
        " (m, and of the entries of the rotation) at three random configurations.");
  }
  // A smaller value is the rounding of other lengths.
  if (arm.dropped_length > 1e-15 * internal::length_scale(arm)) {
    notes.push_back("Lengths up to " + number(arm.dropped_length) + " m are taken as zero.");
  }
  constexpr double near = 1e-3;  // rad; such angles were probably rounded when they were written
  int count = 0;
  double largest = 0;
  for (const Symbol& symbol : arm.symbols) {
    if (symbol.kind != SymbolKind::angle) continue;
    const double distance = std::abs(std::remainder(symbol.value, std::numbers::pi / 12));
    if (distance > near) continue;
    ++count;
    largest = std::max(largest, distance);
  }
  if (count > 0) {
    const double tolerance = std::pow(10, std::ceil(std::log10(std::max(largest, 1e-15))));
    notes.push_back("Constant angles within " + number(largest) +
                    " rad of a multiple of 15 degrees: " + std::to_string(count) +
                    ". An angle tolerance of " + number(tolerance) +
                    " rad (angle_tolerance, --angle-tolerance) takes them as exact, which makes "
                    "the formulas shorter.");
  }
  return notes;
}

}  // namespace

std::string written(const Expression& expression, const SymbolicArm& arm,
                    const FormulaStyle& style) {
  return DocumentWriter(arm, style).text(expression);
}

bool has_inverse_formula(const SymbolicArm& arm) { return internal::has_inverse_derivation(arm); }

FormulaDocument formula_document(const SymbolicArm& arm, const FormulaContent& content,
                                 const FormulaStyle& style) {
  DocumentWriter writer(arm, style);
  const Sentence convention = convention_sentence(arm.convention);
  FormulaDocument document{.title = "Formulas of " + arm.name,
                           .convention = style.latex ? convention.latex : convention.text,
                           .latex = style.latex};
  if (content.links) document.sections.push_back(links_section(writer, arm));
  if (content.products) document.sections.push_back(products_section(writer, arm));
  if (content.tool) document.sections.push_back(tool_section(writer, arm));
  if (content.jacobian) {
    document.sections.push_back(jacobian_section(writer, arm, content, false));
  }
  if (content.derivative) {
    document.sections.push_back(jacobian_section(writer, arm, content, true));
  }
  if (content.determinant) {
    document.sections.push_back(determinant_section(writer, arm, content.task, style));
  }
  if (content.inverse) document.sections.push_back(inverse_section(writer, arm));
  document.symbols = writer.symbols();
  document.abbreviations = writer.abbreviations();
  document.notes = notes_of(arm);
  return document;
}

}  // namespace beeline
