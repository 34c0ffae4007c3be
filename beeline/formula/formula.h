#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <beeline/error.h>
#include <beeline/formula/expression.h>
#include <beeline/formula/symbolic_arm.h>
#include <beeline/kinematics/task.h>

namespace beeline {

/// A matrix of expressions, row by row.
struct ExpressionMatrix {
  std::size_t rows = 0, columns = 0;
  std::vector<Expression> entries = {};

  const Expression& operator()(std::size_t row, std::size_t column) const {
    return entries[row * columns + column];
  }
  Expression& operator()(std::size_t row, std::size_t column) {
    return entries[row * columns + column];
  }

  /// The numbers for given values of all symbols, see symbol_values().
  Eigen::MatrixXd value(std::span<const double> symbols) const;
};

/// The 4 x 4 matrix of link i in link k <= i; link 0 is the base. These and all formulas below
/// throw Error for a formula that is too large.
ExpressionMatrix link_formula(const SymbolicArm& arm, std::size_t i, std::size_t k);
ExpressionMatrix base_formula(const SymbolicArm& arm);         ///< of the base in the world
ExpressionMatrix tool_offset_formula(const SymbolicArm& arm);  ///< of the tool in the last link
ExpressionMatrix tool_formula(const SymbolicArm& arm);         ///< of the tool in the world

/// The orientation of a planar arm's tool in the world: the sum of an angle and a multiple of 15
/// degrees. None for other arms, and where fixed rotations out of the plane hide the sum.
struct PlanarAngle {
  Angle angle;
  int fifteenths = 0;
};
std::optional<PlanarAngle> planar_angle(const SymbolicArm& arm);

/// The Jacobian, rows [vx vy vz wx wy wz], a column for each coordinate: the same matrix as
/// jacobian() has.
ExpressionMatrix jacobian_formula(const SymbolicArm& arm, Frame frame = Frame::base);

/// The determinant of a square Jacobian as the product of a constant and of powers of factors. It
/// does not depend on the frame, so the Jacobian is taken where its block-triangular form has the
/// smallest blocks: at the origin of one frame, in the axes of another.
struct DeterminantFormula {
  Expression constant = 0;                               ///< without joint coordinates
  std::vector<std::pair<Expression, int>> factors = {};  ///< factor, exponent
  std::string origin = {}, axes = {};                    ///< "link 3", "the tool"
  std::size_t origin_frame = 0;  ///< the same: 0 the world, i + 1 link i, n + 2 the tool

  double value(std::span<const double> symbols) const;
};

/// Throws Error when the task has another number of rows than the arm has joints, or the formula is
/// too large.
DeterminantFormula determinant_formula(const SymbolicArm& arm, const Task& task);

/// The time derivative of each entry, with the symbols SymbolicArm::rates.
ExpressionMatrix time_derivative(const SymbolicArm& arm, const ExpressionMatrix& matrix);

}  // namespace beeline
