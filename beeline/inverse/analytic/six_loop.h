#pragma once

#include <array>
#include <optional>
#include <string>

#include <beeline/model/chain.h>

namespace beeline {

/// A rigid motion as plain numbers, for the kernels: p -> rotation p + translation.
struct Rigid {
  double rotation[3][3];
  double translation[3];
};
Rigid rigid(const Pose& pose);

/// A six-joint arm that reaches its goal is a closed loop of six joints,
///     K_d J_d K_e J_e K_f J_f K_a J_a K_b J_b K_c J_c = I,
/// with constant motions K before the joints' own J, which turn about z or slide along it. The
/// loop may be cut anywhere, and is cut so that the last three joints a, b, c belong together:
/// their axes meet in one point, or are parallel. That is how most industrial arms are built
/// (Pieper 1968), and what makes them solvable step by step: a and c only turn that point, or that
/// direction, about itself, which leaves two equations for d and f with e eliminated (the canonical
/// subproblems of Paden and Kahan, and Elias & Wen, "IK-Geo", 2024, seen as one).
struct SixLoop {
  enum class Family { meeting, parallel };
  Family family = Family::meeting;
  std::array<int, 6> order{};     ///< which joints of the arm d, e, f, a, b, c are
  std::array<Rigid, 6> before{};  ///< K_d to K_c; what stands at `goal_place` is not used
  int goal_place = 0;             ///< 0 to 3: there K is the goal's inverse,
  Rigid tool{}, base{};           ///< tool * goal^-1 * base
  std::array<bool, 3> slides{};   ///< d, e, f; e never slides
  std::array<double, 6> sign{};   ///< joint's angle or travel = sign * q + rest
  std::array<double, 6> rest{};
  double sin_alpha[2] = {0, 0};  ///< meeting: of the angles from axis a to b and from b to c
  double cos_alpha[2] = {1, 1};
  double height = 0;  ///< parallel: how far c's origin lies above a's
  double size = 1;    ///< metres: the loop's extent, for what counts as zero

  /// The two equations are b_i.w + a_i.u + k_i = 0 (i = 1, 2) with u = (cos, sin) of joint d and w
  /// that of f (or travel and its square). Where `first` is w, weight . (1, 2) is free of u for
  /// every goal, and the equation number `second` then gives u; the same with u and w exchanged.
  enum class First { w, u, neither };
  First first = First::neither;
  double weight[2] = {0, 0};
  int second = 0;
};

/// The loop by which six joints are solved, if they have one. `chain` has six links, each driven by
/// a coordinate of its own, turning or sliding. Geometry counts as special up to 1e-9 of its size.
std::optional<SixLoop> six_loop(const Chain& chain);

/// In words: `three axes meet (joints 4, 5, 6)`.
std::string description(const SixLoop& loop, int missing = -1);

}  // namespace beeline
