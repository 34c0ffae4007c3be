#pragma once

#include <array>

#include <beeline/model/chain.h>

namespace beeline {

/// What six revolute joints are, as plain numbers for the kernels. Lengths in units of `unit`, in
/// the frame of joint 1 that Chain::base places; the last frame is that before Chain::tool.
struct SixLinks {
  double cos_alpha[6], sin_alpha[6], step[6][3], rest[6];
  double unit = 1;  ///< metres: the arm's extent
};
SixLinks six_links(const Chain& chain);

/// The loop E_1(q_1) ... E_6(q_6) = G of six rotations about lines that stand where the axes are at
/// q = 0, cut in two (Raghavan & Roth, "Inverse kinematics of the general 6R manipulator", 1993):
///     E_a E_b E_c (line of d) = E_v^-1 E_u^-1 G (line of d)      (G may also stand between u and v
/// or beyond both; or all of it backwards). A line with direction l and a point p on it goes by its
/// 14 features l, p, p.p, p.l, p x l, (p.p) l - 2 (p.l) p: components of a vector and a bivector of
/// conformal geometry, on which any rigid motion acts linearly. So either side is linear in the
/// products of (1, cos, sin) of its angles. Eliminating the eight of u and v leaves six equations
/// in three angles. One of these is `hidden`: sought along the circle, by the determinant of the
/// six equations and their shifts in the monomials of the half angles of the other two.
struct GeneralElimination {
  int hidden = 0, first = 0, second = 0;  ///< joints a, b, c in some order
  int u = 0, v = 0;                       ///< the joints of the other side
  int last = 0;                           ///< joint d, found in the end
  bool reversed = false;                  ///< stands for joints 6 to 1, G^-1 and angles -q
  int degree = 8;                         ///< of the determinant in the hidden angle; 12 at most
  bool twofold = false;                   ///< most of these zeros belong to two solutions each
  double origin[3] = {};                  ///< where p is measured from, in units

  /// The left side's coefficients: (1, cos, sin) of hidden x (vv, uv, uu) of first x of second,
  /// with u, v the sine and cosine of the half angle.
  double left[14][27] = {};
  /// The right side's line is before_k G line_k, k = 3 i + j: u at i, v at j quarter turns.
  /// Rotation's rows, then the translation; point, then direction. One number of all k in a row.
  double before[12][16] = {};
  double line[6][16] = {};
};

/// The ways to cut: which joints are on the left, which of them are hidden, first and second, and
/// in what direction.
inline constexpr int general_eliminations = 36;
GeneralElimination general_elimination(const Chain& chain, int which);

}  // namespace beeline
