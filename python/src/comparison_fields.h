#pragma once

#include <beeline/reach/surface.h>

#include "record.h"

namespace beeline::python {

template <>
struct Fields<ReachSide> {
  static constexpr const char* name = "ReachSide";
  static constexpr const char* doc =
      "What one of two maps has, at the points at which they are compared. Volumes are areas, m^2, "
      "if both arms are planar.";
  static constexpr auto all() {
    using Side = ReachSide;
    return std::tuple(
        field("volume", &Side::volume, "Reached in some orientation, m^3."),
        field("alone", &Side::alone, "Of it, not reached by the other."),
        field("better", &Side::better,
              "Where it reaches more of the directions than the other, m^3."),
        field("directions", &Side::directions,
              "Mean fraction reached, where either arm reaches some."),
        field("manipulability", &Side::manipulability,
              "Mean of the largest at each point, where both arms reach some orientation; NaN if "
              "nowhere."),
        field("margin", &Side::margin, "As `manipulability`, of the margin to the joint limits."));
  }
};

template <>
struct Fields<ReachComparison> {
  static constexpr const char* name = "ReachComparison";
  static constexpr const char* doc = "What two maps have, each alone and both.";
  static constexpr auto all() {
    using Comparison = ReachComparison;
    return std::tuple(
        field("sides", &Comparison::sides, "Of the first map and of the second."),
        field("both", &Comparison::both, "Volume that both reach, m^3."),
        field("step", &Comparison::step, "Between the points at which they are compared, m."));
  }
};

}  // namespace beeline::python
