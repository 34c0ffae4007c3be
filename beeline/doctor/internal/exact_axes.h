#pragma once

#include <beeline/model/arm.h>

namespace beeline::internal {

/// The arm with its joint axes moved to the special position that they nearly have: exactly
/// parallel or perpendicular where they are so within 2e-3 rad, concurrent where they pass each
/// other within 5e-5 m.
struct ExactAxes {
  Arm arm;
  double angle = 0;     ///< largest change of an angle between neighbours, rad
  double distance = 0;  ///< largest distance between neighbours that are made to meet, m
};
ExactAxes with_exact_axes(const Arm& arm);

}  // namespace beeline::internal
