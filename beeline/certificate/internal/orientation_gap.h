#pragma once

namespace beeline::internal {

/// Bounds the largest angle f between two rotations R_1(t), R_2(t), t from 0 to 1, that agree at
/// both ends: radians, at most pi. `rotation` is at least the integrals of |w_1| and |w_2|, and
/// `angular_acceleration` = a + b / 6 with |w_1' - w_2'| <= a + b |t - 1/2|.
///
/// SO(3) is locally a sphere of radius 2. By the second variation of arc length (do Carmo,
/// "Riemannian Geometry", ch. 9), with W = `rotation`,
///     f'' >= -|w_1' - w_2'| - W^2 tan(f/4).
/// While W < pi, f < pi and tan(f/4) <= f/pi. The Green's function of f'' + k^2 f is at most k /
/// sin k times the Green's function of f'', so with k = W / sqrt(pi)
///     f <= (a + b / 6) / 8 * k / sin k.
/// Returns pi if W >= pi.
double orientation_gap(double angular_acceleration, double rotation);

}  // namespace beeline::internal
