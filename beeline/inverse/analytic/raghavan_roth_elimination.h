#pragma once

#include <beeline/model/internal/chain.h>

namespace beeline::internal {

/// The constants of six revolute links as plain numbers, for the kernels. Lengths are in units of
/// `unit`, in frame 0 of the chain; the last frame is the one before Chain::tool.
struct RevoluteLinks {
  double cos_alpha[6], sin_alpha[6], translation[6][3], theta_offset[6];
  double unit = 1;               ///< sum of the link lengths, metres
  double determinant_scale = 0;  ///< root mean square of the Jacobian's over all angles, units^3
};
RevoluteLinks revolute_links(const Chain& chain);

/// The elimination of Raghavan & Roth ("Inverse kinematics of the general 6R manipulator and
/// related linkages", 1993). The closure equation E_1(q_1) ... E_6(q_6) = G, a product of rotations
/// about the axes at q = 0, is split into
///     E_a E_b E_c (line d) = E_v^-1 E_u^-1 G (line d).
/// Line d is the axis of joint d at q = 0. G may also stand between E_v^-1 and E_u^-1 or before
/// both, and the joints may be taken in reverse order. A line with unit direction l and a point p
/// on it is represented by 14 numbers, l, p, p.p, p.l, p x l and (p.p) l - 2 (p.l) p: components of
/// a vector and a bivector of conformal geometry. Rigid motions act linearly on them. Both sides
/// are therefore linear in the products of (1, cos, sin) of their angles. Eliminating the eight
/// products of u and v from the 14 equations leaves six equations in a, b, c. One of these angles,
/// `hidden`, is kept as a parameter: the six equations and their multiples by the half tangent of
/// `first` are twelve linear equations in twelve products of the half tangents of `first` and
/// `second` (dialytic elimination). Their determinant, a trigonometric polynomial of the hidden
/// angle, vanishes at the solutions.
struct Elimination {
  int index = 0;                          ///< index for make_elimination()
  int hidden = 0, first = 0, second = 0;  ///< joints a, b, c in some order
  int u = 0, v = 0;                       ///< joints of the right side
  int last = 0;                           ///< joint d, computed at the end
  bool reversed = false;                  ///< whether it is for joints 6 to 1, G^-1 and angles -q
  int degree = 8;  ///< degree of the determinant: 8, or 12 for arms of special geometry
  /// Whether most zeros of the determinant belong to two solutions each.
  bool double_zeros = false;
  double origin[3] = {};  ///< origin of p, in units

  /// Coefficients of the left side: (1, cos, sin) of hidden x (vv, uv, uu) of first x (vv, uv, uu)
  /// of second, with u, v the sine and cosine of the half angle.
  double left[14][27] = {};
  /// The line of the right side is before_k G line_k, k = 3 i + j, with angles u at i and v at j
  /// quarter turns. Each row has one number of all k: the rotation's rows, then the translation;
  /// the point, then the direction.
  double before[12][16] = {};
  double line[6][16] = {};
};

/// Number of choices of the left joints, of the roles of a, b, c, and of the direction: 3 x 6 x 2.
inline constexpr int elimination_count = 36;
Elimination make_elimination(const Chain& chain, int index);

}  // namespace beeline::internal
