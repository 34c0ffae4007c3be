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
  std::string left;                                  ///< left of the equals sign
  std::vector<std::vector<std::string>> cells = {};  ///< rows of cells
  std::vector<std::string> row_names = {};           ///< of the rows of a Jacobian
  /// Of the cells of a matrix that is too wide to be printed as such; cells without a name are left
  /// out then.
  std::vector<std::vector<std::string>> cell_names = {};
  std::string explanation = {};  ///< a sentence in front of it
};

/// A part of a FormulaDocument.
struct WrittenSection {
  std::string key;                        ///< such as `jacobian`, the member of the JSON document
  std::string title;                      ///< above the formulas
  std::vector<std::string> remarks = {};  ///< sentences below the title
  std::vector<WrittenFormula> formulas = {};  ///< in order
  std::vector<std::string> sentences = {};    ///< sentences behind the formulas
};

/// A symbol that occurs in a FormulaDocument.
struct WrittenSymbol {
  std::string name;          ///< as it is written
  std::string code_name;     ///< in generated code
  double value = 0;          ///< of a constant
  std::string unit;          ///< of the value
  std::string meaning;       ///< in words
  std::string formula = {};  ///< of the variable of a mimic joint, such as 0.3 − 2q₁
  std::string joint = {};    ///< of the variable of a mimic joint: the joint that it follows
  double multiplier = 1;     ///< factor of the joint that it follows
  double offset = 0;         ///< offset of the joint that it follows
};

/// Formulas of an arm as strings, in order.
struct FormulaDocument {
  std::string title;                        ///< names the arm
  std::string convention;                   ///< how the transforms are composed
  std::vector<WrittenSymbol> symbols = {};  ///< constants that occur
  std::vector<std::pair<std::string, std::string>> abbreviations =
      {};                                     ///< such as c12 and cos(q1 + q2)
  std::vector<std::string> notes = {};        ///< sentences at the end
  bool latex = false;                         ///< how the strings are written
  std::vector<WrittenSection> sections = {};  ///< in order
};

/// Which formulas a document has.
struct FormulaContent {
  bool links = true;            ///< the transform of each link
  bool products = false;        ///< the pose of each link in the base
  bool tool = true;             ///< the pose of the tool
  bool jacobian = false;        ///< the rows of the task, in its frame
  bool derivative = false;      ///< the time derivative of the Jacobian
  bool determinant = false;     ///< of the rows of the task, and the singularities that it shows
  bool inverse = false;         ///< inverse kinematics of a planar arm in steps
  Frame frame = Frame::base;    ///< of the Jacobian
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
  std::string name;         ///< as in the code
  std::string purpose;      ///< what it computes
  int multiplications = 0;  ///< number of multiplications
  int additions = 0;        ///< number of additions
  int trigonometric = 0;    ///< number of cosines and sines
};

/// A file of code, which needs the language's mathematics alone.
struct GeneratedCode {
  std::string text;                               ///< the whole file
  std::vector<GeneratedFunction> functions = {};  ///< in the order of the file
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
