#pragma once

namespace beeline {

/// Returns the equivalent angle in [-pi, pi], rad.
double wrap_angle(double radians);

/// a ⊖ b (Dellaert, *Serial Link Manipulators*, section 1.8): the rotation by the smallest angle
/// that takes b to a, in [-pi, pi], rad.
double angle_difference(double a, double b);

/// Returns `radians` plus the multiple of 2 pi that brings it nearest to `reference`.
double nearest_angle(double radians, double reference);

}  // namespace beeline
