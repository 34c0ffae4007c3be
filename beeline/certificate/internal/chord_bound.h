#pragma once

#include <beeline/model/arm.h>

namespace beeline {

/// Proved bounds on the tool's motion while every joint moves in proportion from one configuration
/// to another, which makes t from 0 to 1 of it; metres and radians.
struct ChordBound {
  double position = 0;     ///< distance from the point at t of the straight line between its ends
  double orientation = 0;  ///< turn from the one at t of the shortest turn between its ends, to pi
  double moved = 0;        ///< length of the way of the tool's origin
  double turned = 0;       ///< length of the way of its orientation: all joints' turns added
  /// The distance above as a vector is -4 t (1 - t) bend, but for something of length `rest` at
  /// most, and of 6 t rest, 6 (1 - t) rest near the ends.
  Vector3 bend = Vector3::Zero();
  double rest = 0;
  Vector3 swing = Vector3::Zero();  ///< the change of the angular velocity, half-way
  double swing_rest = 0;            ///< what to add to its size for how it differs at other times
};

/// With m_j the tool's velocity that joint j makes, W_j = dq_j w_j its angular velocity (zero where
/// it slides), and B_j = sum_{i<j} W_i that of the link before it,
///     p'' = sum_j (W_j + 2 B_j) x m_j,    w' = sum_j B_j x W_j,
/// taken at t = 1/2. How far they change on both sides is bounded by sizes alone: |W_j'| <=
/// |B_j||W_j|, and m_j' = B_j x m_j + W_j x sum_{k>=j} m_k.
/// Position: the distance d has d'' = p'', d(0) = d(1) = 0; of a constant p'' that is p''/8 at
/// most, of one that grows as |t - 1/2| it is 1/48. So bend = p''(1/2)/8 and rest = |p'''|/48 at
/// most.
///
/// Orientation: SO(3) is locally a sphere of radius 2, where the angle f between the motion and the
/// shortest turn satisfies f'' >= -|w'| - W^2 tan(f/4), W = `turned` (second variation of length,
/// do Carmo, "Riemannian Geometry", ch. 9). While W < pi, f < pi and tan(f/4) <= f/pi. Green's
/// function of f'' + k^2 f is at most k / sin k times that of f'', so with k = W / sqrt(pi)
///     f <= (|w'(1/2)| + |w''| / 6) / 8 * k / sin k.
///
/// Throws Error when q_a or q_b does not fit the arm.
ChordBound chord_bound(const Arm& arm, const ConfigurationRef& q_a, const ConfigurationRef& q_b);

/// That bound on f for two rotations that coincide at t = 0 and t = 1: `acceleration` is a + b / 6
/// where the difference of their angular accelerations is at most a + b |t - 1/2|, and `rotated`
/// bounds the length of the path of either. Radians; pi where rotated >= pi.
double orientation_bound(double acceleration, double rotated);

}  // namespace beeline
