#pragma once

#include <beeline/error.h>
#include <beeline/model/joint.h>

namespace beeline {

/// The two conventions of Denavit-Hartenberg parameters. A table does not show which one it uses,
/// so it must be stated.
enum class DhConvention {
  standard,  ///< T = Rz(theta) Tz(d) Tx(a) Rx(alpha): Denavit & Hartenberg 1955, Paul 1981
  modified,  ///< T = Tx(a) Rx(alpha) Rz(theta) Tz(d): Craig 1986, with a and alpha of link i-1
};

/// One row of a Denavit-Hartenberg table, metres and radians. The joint's coordinate is added to
/// theta (revolute) or d (prismatic).
struct DhRow {
  double a = 0;
  double alpha = 0;
  double d = 0;
  double theta = 0;
  JointKind kind = JointKind::revolute;
};

/// Returns the joint of one row, with the convention's link frame.
/// Throws Error for a helical row, which neither convention has.
Joint dh_joint(const DhRow& row, DhConvention convention);

}  // namespace beeline
