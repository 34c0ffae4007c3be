#pragma once

#include <string>
#include <vector>

#include <beeline/formula/formula.h>
#include <beeline/formula/internal/tree.h>

namespace beeline::internal {

/// A step of a derivation: the quantity `symbol` equals `right`.
struct InverseStep {
  std::string explanation;  ///< sentence that introduces the step; may be empty
  int symbol = -1;
  Tree right;
};

/// A sentence in which each @ stands for the next of the symbols.
struct InverseRemark {
  std::string sentence;
  std::vector<int> symbols = {};
};

/// The inverse kinematics of a planar arm in steps. Its functions are `sqrt`, `branch` (+-sqrt) and
/// `atan2`.
struct InverseDerivation {
  /// Symbols of the arm, then x, y, theta and intermediate quantities.
  std::vector<Symbol> symbols;
  int x = -1, y = -1,
      theta = -1;  ///< symbols of the given pose; theta is -1 if the orientation is free
  std::vector<InverseStep> steps = {};
  /// Conditions for a solution, and the number of solutions.
  std::vector<InverseRemark> remarks = {};
};

/// Whether the arm is planar, its links are named as planar ones, and it is RR, RP, PR, PP (for a
/// position), RRR, RPR, PRR, PPR, RRP, PRP or RPP (for a pose), without mimic joints, mount or tool
/// beside the last link's axis.
bool has_inverse_derivation(const SymbolicArm& arm);

/// Derives the joint coordinates from the tool's position, or pose for three joints (Siciliano et
/// al., section 2.12.2, for RRR). Each real solution is compared with the forward kinematics at
/// random configurations before it is returned. Throws Error unless has_inverse_derivation(), and
/// for dimensions with which the steps divide by zero.
InverseDerivation planar_inverse(const SymbolicArm& arm);

}  // namespace beeline::internal
