#pragma once

namespace beeline {

/// One coordinate's way between two samples that have velocities: the cubic with those values and
/// slopes at both ends, as a polynomial in u, the share of the step's time (0 to 1).
struct Cubic {
  double c0 = 0, c1 = 0, c2 = 0, c3 = 0;
  double duration = 1;  ///< of the step, seconds

  double value(double u) const { return c0 + u * (c1 + u * (c2 + u * c3)); }
  /// Derivatives by time.
  double velocity(double u) const { return (c1 + u * (2 * c2 + 3 * u * c3)) / duration; }
  double acceleration(double u) const { return (2 * c2 + 6 * u * c3) / (duration * duration); }
};

Cubic cubic_between(double from, double to, double velocity_from, double velocity_to,
                    double duration);

/// The least and the largest value within the step, ends included.
struct Extremes {
  double least, largest;
};
Extremes extremes(const Cubic& cubic);

}  // namespace beeline
