#pragma once

#include <array>

namespace beeline {

/// The real roots of c[0] + c[1] x + ... + c[4] x^4, at most four, each as often as it counts; a
/// double root that rounding has made complex counts as real (of a fourfold root it may not).
/// Returns how many; c[4] must not vanish. Ferrari's way by the largest root of the resolvent, each
/// root polished by Newton.
int quartic_roots(const std::array<double, 5>& c, std::array<double, 4>& roots);

}  // namespace beeline
