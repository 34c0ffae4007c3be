#pragma once

#include <array>

namespace beeline::internal {

/// Computes the real roots of c[0] + c[1] x + ... + c[4] x^4, with their multiplicities, by
/// Ferrari's method and a few Newton steps. A double root that rounding has made complex counts as
/// real; one of multiplicity four may be missed. Returns the number of roots, 0 to 4. Needs c[4] !=
/// 0.
int quartic_roots(const std::array<double, 5>& c, std::array<double, 4>& roots);

}  // namespace beeline::internal
