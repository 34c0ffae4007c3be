#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/formula/expression.h>
#include <beeline/formula/symbolic_arm.h>
#include <beeline/kinematics/jacobian.h>

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
ExpressionMatrix base_formula(const SymbolicArm& arm);    ///< of the base in the world
ExpressionMatrix flange_formula(const SymbolicArm& arm);  ///< of the tool in the last link
ExpressionMatrix tool_formula(const SymbolicArm& arm);    ///< of the tool in the world

/// The orientation of a planar arm's tool in the world: the sum of an angle and a multiple of 15
/// degrees.
struct PlanarAngle {
  Angle angle;
  int fifteenths = 0;
};
PlanarAngle planar_angle(const SymbolicArm& arm);

/// The Jacobian, rows [vx vy vz wx wy wz], a column for each coordinate: the same matrix as
/// jacobian() has.
ExpressionMatrix jacobian_formula(const SymbolicArm& arm, Frame frame = Frame::base);

/// The time derivative of each entry, with the symbols SymbolicArm::rates.
ExpressionMatrix time_derivative(const SymbolicArm& arm, const ExpressionMatrix& matrix);

}  // namespace beeline
