#pragma once

#include <string>
#include <utility>
#include <vector>

#include <beeline/error.h>
#include <beeline/formula/formula.h>
#include <beeline/kinematics/task.h>

namespace beeline {

struct FormulaStyle {
  bool latex = false;    ///< otherwise text with Unicode subscripts
  bool numbers = false;  ///< constants as numbers, not as symbols
  bool degrees = false;  ///< values of angles in degrees: those of constants, and at singularities
};

/// An expression with common factors before brackets: `c₁(a₁ + q₂)`.
std::string written(const Expression& expression, const SymbolicArm& arm,
                    const FormulaStyle& style = {});

/// A written formula: `left` equals a matrix of cells, or one cell.
struct WrittenFormula {
  std::string left;
  std::vector<std::vector<std::string>> cells = {};  ///< rows
  std::vector<std::string> row_names = {};           ///< of the rows of a Jacobian
  /// Names of the cells, for a matrix that is too wide to be printed as such; cells without a name
  /// are left out then.
  std::vector<std::vector<std::string>> cell_names = {};
  std::string explanation = {};  ///< a sentence in front of it
};

struct WrittenSection {
  std::string key;  ///< the member of the JSON document
  std::string title;
  std::vector<std::string> remarks = {};  ///< sentences below the title
  std::vector<WrittenFormula> formulas = {};
  std::vector<std::string> sentences = {};  ///< behind the formulas
};

struct WrittenSymbol {
  std::string name;
  std::string code_name;  ///< in generated code
  double value = 0;       ///< of a constant
  std::string unit, meaning;
  std::string formula = {};  ///< of the variable of a mimic joint: 0.3 − 2q₁
  std::string joint = {};    ///< that it follows, with
  double multiplier = 1, offset = 0;
};

/// Formulas of an arm as strings, in order.
struct FormulaDocument {
  std::string title;
  std::string convention;
  std::vector<WrittenSymbol> symbols = {};                              ///< constants that occur
  std::vector<std::pair<std::string, std::string>> abbreviations = {};  ///< c12, cos(q1 + q2)
  std::vector<std::string> notes = {};
  bool latex = false;  ///< how the strings are written
  std::vector<WrittenSection> sections = {};
};

/// Which formulas a document has.
struct FormulaContent {
  bool links = true;         ///< the transform of each link
  bool products = false;     ///< the pose of each link in the base
  bool tool = true;          ///< the pose of the tool
  bool jacobian = false;     ///< the rows of the task, in its frame
  bool derivative = false;   ///< the time derivative of the same
  bool determinant = false;  ///< of the rows of the task, and the singularities that it shows
  bool inverse = false;      ///< inverse kinematics of a planar arm in steps
  Frame frame = Frame::base;
  Task task = Task::spatial();  ///< its rows; planar arms have Task::planar()
};

/// Whether FormulaContent::inverse can be derived: for planar arms RR, RP, PR, PP (the position is
/// given) and with a third joint (the pose), described by planar links.
bool has_inverse_formula(const SymbolicArm& arm);

/// Derives and writes formulas. Throws Error for a formula that is too large.
FormulaDocument formula_document(const SymbolicArm& arm, const FormulaContent& content = {},
                                 const FormulaStyle& style = {});

/// The document as text, or as LaTeX that needs amsmath; `standalone` adds a preamble, so that it
/// compiles by itself.
std::string text_of(const FormulaDocument& document);
std::string latex_of(const FormulaDocument& document, bool standalone = false);

enum class CodeLanguage { python, cpp, c };

/// A function of generated code and its number of operations, signs not counted.
struct GeneratedFunction {
  std::string name;
  std::string purpose;
  int multiplications = 0, additions = 0, trigonometric = 0;
};

struct GeneratedCode {
  std::string text;  ///< one file that needs the language's mathematics alone
  std::vector<GeneratedFunction> functions = {};
};

/// Generates code for the formulas of `content`: one function for the pose of the tool, for the
/// Jacobian (with the pose), for its time derivative and for its determinant. It computes each
/// common subexpression once, has no branches and does not allocate; its size grows with the number
/// of joints. In C and C++ a macro precedes each function, BEELINE_FORMULA_FUNCTION, which may be
/// defined as `__host__ __device__` for CUDA; an include guard is named after the functions. Links,
/// products and the inverse kinematics of `content` are not generated. Constants are named, or with
/// `numbers` inserted.
GeneratedCode formula_code(const SymbolicArm& arm, const FormulaContent& content,
                           CodeLanguage language, bool numbers = false);

/// Generates code for any matrix of expressions: a function ARM_name(q, M), with the joint
/// velocities ARM_name(q, dq, M) where they occur. Of a matrix of one entry the function returns
/// the number. Throws Error for a name that is not letters, digits and underscores.
GeneratedCode formula_code(const SymbolicArm& arm, const ExpressionMatrix& matrix,
                           const std::string& name, CodeLanguage language, bool numbers = false);

}  // namespace beeline
