#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/formula/expression.h>
#include <beeline/model/arm.h>

namespace beeline {

/// One factor of a transform: a rotation about, or a translation along, an axis of the current
/// frame (Corke, "A simple and systematic approach to assigning Denavit-Hartenberg parameters",
/// 2007).
struct ElementaryTransform {
  bool rotation = true;
  int axis = 2;        ///< 0, 1, 2: x, y, z
  int fifteenths = 0;  ///< a rotation by this multiple of 15 degrees, or
  int symbol = -1;     ///< by multiple * symbol, if this is not -1
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

/// An arm whose dimensions have names: each transform of eq. 1.1 (Dellaert, *Serial Link
/// Manipulators*) as a product of elementary transforms.
struct SymbolicArm {
  std::string name;
  NamingConvention convention = NamingConvention::offsets;
  bool planar = false;
  int dof = 0;
  std::vector<Symbol> symbols = {};
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

}  // namespace beeline
