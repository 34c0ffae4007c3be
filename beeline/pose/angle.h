#pragma once

namespace beeline {

/// The same direction, in [-pi, pi].
double wrap_angle(double radians);

/// The chapter's a ⊖ b (section 1.8): the smallest turn that leads from b to a, in [-pi, pi].
double angle_difference(double a, double b);

/// `radians` plus the whole number of turns that brings it nearest to `reference`.
double nearest_turn(double radians, double reference);

}  // namespace beeline
