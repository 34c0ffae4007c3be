#pragma once

#include <string>
#include <utility>
#include <vector>

#include <beeline/error.h>
#include <beeline/formula/formula.h>
#include <beeline/kinematics/task.h>

namespace beeline {

struct FormulaStyle {
  bool latex = false;    ///< LaTeX; otherwise text with Unicode subscripts
  bool numbers = false;  ///< numbers instead of symbols for constants
  bool degrees = false;  ///< degrees for the values of angles: of constants, and at singularities
};

/// Writes an expression with common factors before brackets: `c₁(a₁ + q₂)`.
std::string written(const Expression& expression, const SymbolicArm& arm,
                    const FormulaStyle& style = {});

/// A written formula: `left` equals a matrix of cells, or one cell.
struct WrittenFormula {
  std::string left;                                  ///< left-hand side
  std::vector<std::vector<std::string>> cells = {};  ///< cells, row by row
  std::vector<std::string> row_names = {};           ///< names of the rows of a Jacobian
  /// Names of the cells, for a matrix that is too wide to be printed as one. Cells without a name
  /// are then omitted.
  std::vector<std::vector<std::string>> cell_names = {};
  std::string explanation = {};  ///< sentence before the formula
};

/// A part of a FormulaDocument.
struct WrittenSection {
  std::string key;    ///< name of the section in the JSON document, such as `jacobian`
  std::string title;  ///< title above the formulas
  std::vector<std::string> remarks = {};      ///< sentences below the title
  std::vector<WrittenFormula> formulas = {};  ///< formulas in order
  std::vector<std::string> sentences = {};    ///< sentences after the formulas
};

/// A symbol that occurs in a FormulaDocument.
struct WrittenSymbol {
  std::string name;       ///< name as it is written
  std::string code_name;  ///< name in generated code
  double value = 0;       ///< value of a constant
  std::string unit;       ///< unit of the value
  std::string meaning;    ///< meaning in words
  /// Formula of a mimic joint's variable, such as 0.3 − 2q₁; otherwise empty.
  std::string formula = {};
  std::string joint = {};  ///< joint that a mimic joint follows; otherwise empty
  double multiplier = 1;   ///< multiplier of the followed joint's coordinate
  double offset = 0;       ///< offset of the mimic joint, rad or m
};

/// Formulas of an arm as strings, in order.
struct FormulaDocument {
  std::string title;                        ///< title, which names the arm
  std::string convention;                   ///< sentence on the composition of the transforms
  std::vector<WrittenSymbol> symbols = {};  ///< constants that occur
  /// Abbreviations with their meanings, such as c12 and cos(q1 + q2).
  std::vector<std::pair<std::string, std::string>> abbreviations = {};
  std::vector<std::string> notes = {};        ///< sentences at the end
  bool latex = false;                         ///< whether the strings are LaTeX
  std::vector<WrittenSection> sections = {};  ///< sections in order
};

/// The formulas that a document has.
struct FormulaContent {
  bool links = true;        ///< transform of each link
  bool products = false;    ///< pose of each link in the base
  bool tool = true;         ///< pose of the tool
  bool jacobian = false;    ///< Jacobian: the rows of the task, in its frame
  bool derivative = false;  ///< time derivative of the Jacobian
  /// Determinant of the task's rows, and the singularities that it shows.
  bool determinant = false;
  bool inverse = false;       ///< inverse kinematics of a planar arm in steps
  Frame frame = Frame::base;  ///< frame of the Jacobian
  Task task =
      Task::spatial();  ///< task, whose rows the Jacobian has; Task::planar() for planar arms
};

/// Whether FormulaContent::inverse can be derived: for planar arms that are described by planar
/// links. With two joints, RR, RP, PR or PP, the position is given; with a third joint, the pose.
bool has_inverse_formula(const SymbolicArm& arm);

/// Derives and writes formulas. Throws Error for a formula that is too large.
FormulaDocument formula_document(const SymbolicArm& arm, const FormulaContent& content = {},
                                 const FormulaStyle& style = {});

/// Return the document as text, or as LaTeX that needs amsmath. `standalone` adds a preamble, so
/// that the document compiles by itself.
std::string text_of(const FormulaDocument& document);
std::string latex_of(const FormulaDocument& document, bool standalone = false);

enum class CodeLanguage { python, cpp, c };

/// A function of generated code and its number of operations. Signs are not counted.
struct GeneratedFunction {
  std::string name;         ///< name in the code
  std::string purpose;      ///< quantity that it computes
  int multiplications = 0;  ///< number of multiplications
  int additions = 0;        ///< number of additions
  int trigonometric = 0;    ///< number of cosines and sines
};

/// A file of code. It needs only the mathematics of its language.
struct GeneratedCode {
  std::string text;                               ///< text of the whole file
  std::vector<GeneratedFunction> functions = {};  ///< functions in the order of the file
};

/// Generates code for the formulas of `content`: one function for the pose of the tool, for the
/// Jacobian (with the pose), for its time derivative and for its determinant. The code computes
/// each common subexpression once, has no branches and does not allocate; its size grows with the
/// number of joints. In C and C++ the macro BEELINE_FORMULA_FUNCTION precedes each function and may
/// be defined as `__host__ __device__` for CUDA; an include guard is named after the functions.
/// Links, products and the inverse kinematics of `content` are not generated. Constants have names
/// or, with `numbers`, are inserted as numbers.
GeneratedCode formula_code(const SymbolicArm& arm, const FormulaContent& content,
                           CodeLanguage language, bool numbers = false);

/// Generates code for any matrix of expressions: a function ARM_name(q, M), or ARM_name(q, dq, M)
/// if the matrix has joint velocities. For a matrix of one entry the function returns the number.
/// Throws Error for a name that is not letters, digits and underscores.
GeneratedCode formula_code(const SymbolicArm& arm, const ExpressionMatrix& matrix,
                           const std::string& name, CodeLanguage language, bool numbers = false);

}  // namespace beeline
