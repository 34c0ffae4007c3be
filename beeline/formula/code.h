#pragma once

#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/formula/document.h>

namespace beeline {

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
