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
};

/// Position: by Taylor's formula |p''| / 8 at its largest. With J_j the tool's velocity by joint j,
///     p'' = sum_j dq_j^2 w_j x J_j + 2 sum_{i<j} dq_i dq_j w_i x J_j,
/// w_i being axis i (zero where it slides). J_j is as long as the tool's distance from axis j,
/// which the joints behind j change by at most what they move the tool, and the travel along the
/// axis. Orientation: the angular velocity w = sum_j dq_j w_j changes at |w'| <= A = sum_{i<j}
/// |dq_i dq_j| (zero where all axes are parallel). SO(3) is locally a sphere of radius 2, where the
/// angle f between the motion and the shortest turn satisfies f'' >= -A - W^2 tan(f/4), W =
/// `turned` (second variation of length, do Carmo, "Riemannian Geometry", ch. 9). While W < pi, f <
/// pi and tan(f/4) <= f/pi; comparing with the solution of f'' = -A - (W^2/pi) f leaves
///     f <= (A/8) / cos(W / (2 sqrt(pi))).
/// Throws Error when q_a or q_b does not fit the arm.
ChordBound chord_bound(const Arm& arm, const ConfigurationRef& q_a, const ConfigurationRef& q_b);

}  // namespace beeline
