#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <beeline/error.h>
#include <beeline/formula/expression.h>
#include <beeline/kinematics/task.h>
#include <beeline/model/arm.h>

namespace beeline {

/// One factor of a transform: a rotation about, or a translation along, an axis of the current
/// frame (Corke, "A simple and systematic approach to assigning Denavit-Hartenberg parameters",
/// 2007).
struct ElementaryTransform {
  bool rotation = true;
  int axis = 2;                    ///< 0, 1, 2: x, y, z
  int multiple_of_15_degrees = 0;  ///< a rotation by this multiple of 15 degrees, or
  int symbol = -1;                 ///< by multiple * symbol, if this is not -1
  int multiple = 1;
  Expression distance = {};  ///< a translation by this, metres
};

/// How the transform of link i is composed, and named.
enum class NamingConvention {
  planar,    ///< Rz(q_i) Tx(a_i), or Tx(q_i + a_i) for a prismatic joint
  standard,  ///< Rz(q_i + theta_i) Tz(d_i) Tx(a_i) Rx(alpha_i): DhConvention::standard
  modified,  ///< Tx(a_(i-1)) Rx(alpha_(i-1)) Rz(q_i + theta_i) Tz(d_i): DhConvention::modified
  offsets    ///< the offset of joint i, then its motion
};

struct SymbolicOptions {
  /// Constant angles within this distance (rad) of a multiple of 15 degrees are taken as exact.
  /// SymbolicArm::rounding reports the largest distance.
  double angle_tolerance = 1e-9;
  /// An Error is thrown for a matrix with more symbols, Expression::size(), in total.
  std::size_t max_symbols = 50000;
};

/// An arm whose dimensions have names, those of Denavit-Hartenberg parameters or of planar links
/// where all joints fit, else those of the joints' offsets: each transform of eq. 1.1 (Dellaert,
/// *Serial Link Manipulators*) as a product of elementary transforms.
struct SymbolicArm {
  std::string name;  ///< of the arm
  NamingConvention convention =
      NamingConvention::offsets;              ///< how transforms are composed, and named
  bool planar = false;                        ///< whether the arm is planar
  int dof = 0;                                ///< number of coordinates
  std::vector<Symbol> symbols = {};           ///< constants, variables and rates
  std::vector<int> groups = {};               ///< of each angle symbol, see Angle
  std::vector<int> coordinates = {};          ///< the symbol of each coordinate
  std::vector<int> rates = {};                ///< the symbol of its time derivative
  std::vector<std::string> joint_names = {};  ///< of each coordinate
  /// Transform 0 is the base in the world, transform i link i in link i-1, transform n+1 the tool
  /// in link n.
  std::vector<std::vector<ElementaryTransform>> transforms = {};
  double rounding = 0;   ///< largest change of an angle by SymbolicOptions::angle_tolerance, rad
  double deviation = 0;  ///< largest difference of a link's or the tool's pose matrix from the
                         ///< arm's (m for positions), over three random configurations
  double dropped_length = 0;  ///< largest length that was taken as zero, m: 1e-12 of the arm's
                              ///< largest length and at most 1e-12 m
  SymbolicOptions options = {};

  std::size_t links() const { return transforms.size() - 2; }
};

/// Names the dimensions of an arm. If all joints fit, the names are those of standard or modified
/// Denavit-Hartenberg parameters, or of planar links; otherwise each joint has the offset x, y, z
/// and named angles. The link frames are those of the arm. The transforms are compared with
/// link_poses() at random configurations before they are returned; each formula below is compared
/// with them in turn.
SymbolicArm symbolic_arm(const Arm& arm, const SymbolicOptions& options = {});

/// The values of all symbols at a configuration and joint velocities (empty: zero), for
/// Expression::value(). Throws Error when a size does not fit the arm.
std::vector<double> symbol_values(const SymbolicArm& arm, const ConfigurationRef& q,
                                  const ConfigurationRef& rates = Configuration());

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
  int multiple_of_15_degrees = 0;
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
