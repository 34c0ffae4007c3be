#pragma once

#include <cmath>

#include <beeline/model/internal/kept.h>

namespace beeline::internal {

/// Returns the arm with coordinate k fixed at a value. Its joint, and the joints that mimic it,
/// become parts of the links, and the arm has one coordinate less. Throws Error when it has only
/// one.
Arm with_locked(const Arm& arm, int k, double value);

/// The arm of with_locked(), which a thread keeps.
struct LockedArm {
  Arm arm;

  struct Key {
    int k = 0;
    double value = 0;
    bool operator==(const Key& other) const {  // 0 is not -0: an arm may keep the sign
      return k == other.k && value == other.value &&
             std::signbit(value) == std::signbit(other.value);
    }
  };
  static LockedArm make(const Arm& arm, const Key& key) {
    return {with_locked(arm, key.k, key.value)};
  }
};

/// Returns q without coordinate k, and q with coordinate k inserted at `value`.
Configuration without(const Configuration& q, int k);
Configuration with(const Configuration& q, int k, double value);

}  // namespace beeline::internal
