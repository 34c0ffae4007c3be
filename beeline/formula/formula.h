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

/// One factor of a transform: a rotation about an axis of the current frame, or a translation along
/// it (Corke, "A simple and systematic approach to assigning Denavit-Hartenberg parameters", 2007).
struct ElementaryTransform {
  bool rotation = true;
  int axis = 2;                    ///< axis of the current frame: 0, 1, 2 for x, y, z
  int multiple_of_15_degrees = 0;  ///< angle of a rotation in multiples of 15 degrees
  int symbol = -1;  ///< symbol of the angle, which is multiple * symbol; -1: no symbol
  int multiple = 1;
  Expression distance = {};  ///< distance of a translation, metres
};

/// The composition and naming of the transform of link i.
enum class NamingConvention {
  planar,    ///< Rz(q_i) Tx(a_i), or Tx(q_i + a_i) for a prismatic joint
  standard,  ///< Rz(q_i + theta_i) Tz(d_i) Tx(a_i) Rx(alpha_i): DhConvention::standard
  modified,  ///< Tx(a_(i-1)) Rx(alpha_(i-1)) Rz(q_i + theta_i) Tz(d_i): DhConvention::modified
  offsets    ///< the offset of joint i, then its motion
};

struct SymbolicOptions {
  /// Distance from a multiple of 15 degrees up to which a constant angle is taken as exact, rad.
  /// SymbolicArm::rounding reports the largest change.
  double angle_tolerance = 1e-9;
  /// Max total number of symbols of a matrix's entries; an Error is thrown above it.
  std::size_t max_symbols = 50000;
};

/// An arm whose dimensions have names. Each transform of eq. 1.1 (Dellaert, *Serial Link
/// Manipulators*) is a product of elementary transforms. If all joints fit, the names are
/// Denavit-Hartenberg parameters or the names of planar links; otherwise they are the offsets of
/// the joints.
struct SymbolicArm {
  std::string name;  ///< name of the arm
  /// Composition and naming of the transforms.
  NamingConvention convention = NamingConvention::offsets;
  bool planar = false;                        ///< whether the arm is planar
  int dof = 0;                                ///< number of coordinates
  std::vector<Symbol> symbols = {};           ///< constants, variables and rates
  std::vector<int> groups = {};               ///< group of each angle symbol, see Angle
  std::vector<int> coordinates = {};          ///< symbol of each coordinate
  std::vector<int> rates = {};                ///< symbol of the time derivative of each coordinate
  std::vector<std::string> joint_names = {};  ///< joint name of each coordinate
  /// Elementary transforms of each transform. Transform 0 is the base in the world, transform i is
  /// link i in link i-1, and transform n+1 is the tool in link n.
  std::vector<std::vector<ElementaryTransform>> transforms = {};
  double rounding = 0;   ///< largest change of an angle by SymbolicOptions::angle_tolerance, rad
  double deviation = 0;  ///< largest difference of a pose matrix of a link or the tool from the
                         ///< arm's pose matrix (m for positions), over three random configurations
  double dropped_length = 0;  ///< largest length that was taken as zero, m: 1e-12 of the arm's
                              ///< largest length and at most 1e-12 m
  SymbolicOptions options = {};

  std::size_t links() const { return transforms.size() - 2; }
};

/// Names the dimensions of an arm. If all joints fit, the names are standard or modified
/// Denavit-Hartenberg parameters, or the names of planar links; otherwise each joint has the offset
/// x, y, z and named angles. The link frames are the arm's link frames. The transforms are compared
/// with link_poses() at random configurations before they are returned. Each formula below is then
/// compared with the transforms.
SymbolicArm symbolic_arm(const Arm& arm, const SymbolicOptions& options = {});

/// Returns the values of all symbols at a configuration and joint velocities (empty: zero), for
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

  /// Returns the numerical matrix for given values of all symbols, see symbol_values().
  Eigen::MatrixXd value(std::span<const double> symbols) const;
};

/// Returns the 4 x 4 matrix of link i in link k <= i; link 0 is the base. This function and all
/// functions below throw Error for a formula that is too large.
ExpressionMatrix link_formula(const SymbolicArm& arm, std::size_t i, std::size_t k);
ExpressionMatrix base_formula(const SymbolicArm& arm);         ///< base in the world
ExpressionMatrix tool_offset_formula(const SymbolicArm& arm);  ///< tool in the last link
ExpressionMatrix tool_formula(const SymbolicArm& arm);         ///< tool in the world

/// The orientation of a planar arm's tool in the world: the sum of an angle and a multiple of 15
/// degrees. Other arms have none, nor do arms whose fixed rotations out of the plane hide the sum.
struct PlanarAngle {
  Angle angle;
  int multiple_of_15_degrees = 0;
};
std::optional<PlanarAngle> planar_angle(const SymbolicArm& arm);

/// Returns the Jacobian, as jacobian() does: rows [vx vy vz wx wy wz], one column for each
/// coordinate.
ExpressionMatrix jacobian_formula(const SymbolicArm& arm, Frame frame = Frame::base);

/// The determinant of a square Jacobian as the product of a constant and of powers of factors. It
/// does not depend on the frame of the Jacobian. The frame is chosen so that the block-triangular
/// form has the smallest blocks: the origin of one frame, and the axes of another.
struct DeterminantFormula {
  Expression constant = 0;                               ///< factor without joint coordinates
  std::vector<std::pair<Expression, int>> factors = {};  ///< pairs of a factor and its exponent
  std::string origin = {},
              axes = {};  ///< names of the frames of the origin and the axes: "link 3", "the tool"
  /// Index of the origin's frame: 0 the world, i + 1 link i, n + 2 the tool.
  std::size_t origin_frame = 0;

  double value(std::span<const double> symbols) const;
};

/// Derives the determinant of the task's rows. Throws Error when the task has another number of
/// rows than the arm has joints, or the formula is too large.
DeterminantFormula determinant_formula(const SymbolicArm& arm, const Task& task);

/// Returns the time derivative of each entry, with the symbols SymbolicArm::rates.
ExpressionMatrix time_derivative(const SymbolicArm& arm, const ExpressionMatrix& matrix);

}  // namespace beeline
