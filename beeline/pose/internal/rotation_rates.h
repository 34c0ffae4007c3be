#pragma once

#include <beeline/pose/so3.h>

namespace beeline {

/// How a rotation vector r changes, and the angular velocity of so3_exp(r) with its rate, in the
/// axes that r is written in: w = J(r) r' with the left Jacobian
///     J(r) = I + (1 - cos a)/a^2 [r]x + (a - sin a)/a^3 [r]x^2,   a = |r|
/// (Chirikjian, "Stochastic Models, Information Theory, and Lie Groups", vol. 2, 10.86).
struct Turning {
  Vector3 velocity;
  Vector3 acceleration;
};

/// w and w' of so3_exp(r) from r' and r''.
Turning angular_motion(const Vector3& r, const Turning& rates);

/// The other way round: r' and r'' that make w and w'; |r| < 2 pi.
Turning rotation_vector_rates(const Vector3& r, const Turning& motion);

/// How far two rotations that begin and end as one come apart, radians: with |w'| <= a + b |t -
/// 1/2| for the difference of their angular accelerations over the time from 0 to 1, and a way of
/// `turned` at most, `swing` being a + b / 6: see chord_bound(). pi from turned = pi on.
double swing_bound(double swing, double turned);

}  // namespace beeline
