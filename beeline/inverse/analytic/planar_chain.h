#pragma once

#include <complex>
#include <optional>
#include <vector>

#include <beeline/model/arm.h>

namespace beeline {

/// One joint as a motion p -> r p + t of the plane, at q = 0 and in the world's axes. Points and
/// directions of the plane are complex numbers x + iy.
struct PlanarJoint {
  bool turns = true;           ///< about `place`; else it slides along `place`
  double sign = 1;             ///< of its axis against the world's z; 1 for a slide
  std::complex<double> place;  ///< the axis's point; the unit direction of a slide
  std::optional<double> preferred =
      std::nullopt;  ///< the value where the choice is free; empty: any will do
};

/// A configuration that reaches a motion of the plane or, where none does, one that comes near.
struct PlanarCandidate {
  Configuration q;
  bool continuum = false;  ///< stands for infinitely many: the one nearest to what is preferred
};

/// All configurations with J_1(q_1) ... J_n(q_n) p == rotation p + translation, for one to three
/// joints (products of exponentials: Brockett 1984). Unchecked: what lies out of reach gives the
/// configurations at the edge of reach, with the right orientation if any joint turns.
/// Angles are those nearest to what is preferred.
std::vector<PlanarCandidate> planar_candidates(const std::vector<PlanarJoint>& joints,
                                               std::complex<double> rotation,
                                               std::complex<double> translation);

}  // namespace beeline
