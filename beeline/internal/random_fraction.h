#pragma once

#include <random>

namespace beeline::internal {

/// Returns a number from 0 to 1, 1 excluded, by the 53 upper bits of the engine's next one. The
/// standard library's distributions differ between systems; the engine does not.
inline double random_fraction(std::mt19937_64& engine) {
  return static_cast<double>(engine() >> 11) * 0x1p-53;
}

}  // namespace beeline::internal
