#pragma once

#include <complex>
#include <optional>
#include <vector>

#include <beeline/model/arm.h>

namespace beeline::internal {

/// One joint as a motion p -> r p + t of the plane, at q = 0 and in world axes. Points and
/// directions of the plane are complex numbers x + iy.
struct PlanarJoint {
  bool revolute = true;  ///< rotation about the point `axis`; otherwise translation along `axis`
  double sign = 1;       ///< sign of the axis relative to the world's z; 1 for a prismatic joint
  std::complex<double> axis;  ///< a point, metres; for a prismatic joint its unit direction
  std::optional<double> preferred = std::nullopt;  ///< value of a free joint
};

/// A configuration that solves a motion of the plane or, if none does, comes near it.
struct PlanarCandidate {
  Configuration q;
  /// Whether it is one of infinitely many: the one nearest to the preferred values.
  bool continuum = false;
};

/// Solves J_1(q_1) ... J_n(q_n) p = rotation p + translation for one to three joints (product of
/// exponentials; Brockett, "Robotic manipulators and the product of exponentials formula", 1984).
/// For a motion out of reach, returns configurations at the workspace boundary, with the right
/// orientation if a joint is revolute. Angles are the ones nearest to the preferred values.
std::vector<PlanarCandidate> planar_candidates(const std::vector<PlanarJoint>& joints,
                                               std::complex<double> rotation,
                                               std::complex<double> translation);

}  // namespace beeline::internal
