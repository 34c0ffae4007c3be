#pragma once

#include <beeline/model/arm.h>

namespace beeline::internal {

/// Proved bounds on the tool's motion while the joints move linearly, q(t) = (1 - t) q_a + t q_b
/// with t from 0 to 1; metres and radians. The chord is interpolate(T(q_a), T(q_b), t).
struct ChordBound {
  double position = 0;     ///< bound of |d(t)|, d(t) = p(t) - chord position at t
  double orientation = 0;  ///< bound of the angle between the orientations of tool and chord; <= pi
  double path_length = 0;  ///< bound of the length of the path of the tool's origin
  double rotation = 0;     ///< bound of the integral of |w|: W, the sum of all joints' rotations
  /// d(t) = -4 t (1 - t) curvature_term + e(t), where |e(t)| <= remainder * min(1, 6 t, 6 (1 - t)).
  Vector3 curvature_term = Vector3::Zero();
  double remainder = 0;
  Vector3 angular_acceleration = Vector3::Zero();  ///< w' at t = 1/2, radians
  double angular_remainder = 0;                    ///< bound of |w''| / 6, see orientation_gap()
};

/// Let m_j be the velocity of the tool's origin that joint j causes, W_j = dq_j w_j its angular
/// velocity (zero for a prismatic joint), and B_j = sum_{i<j} W_i the angular velocity of the link
/// before it. Then, evaluated at t = 1/2,
///     p'' = sum_j (W_j + 2 B_j) x m_j,    w' = sum_j B_j x W_j.
/// Norms alone bound their rates of change: |W_j'| <= |B_j||W_j| and
/// m_j' = B_j x m_j + W_j x sum_{k>=j} m_k.
///
/// Position: d'' = p'' with d(0) = d(1) = 0, so |d| <= |p''|/8 for a constant p'', and |d| <= c/48
/// for |p''| = c |t - 1/2|. Hence curvature_term = p''(1/2)/8 and remainder = max |p'''|/48.
/// Orientation: orientation_gap() with the chord, whose angular acceleration is zero.
///
/// Throws Error when q_a or q_b does not fit the arm.
ChordBound chord_bound(const Arm& arm, const ConfigurationRef& q_a, const ConfigurationRef& q_b);

}  // namespace beeline::internal
