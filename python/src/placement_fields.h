#pragma once

#include "reach_fields.h"
#include "reason.h"

namespace beeline::python {

/// PlacementOptions::blocked_by: a CollisionModel, which the function keeps.
template <>
struct Value<std::function<BlockedAtMount(const Pose&)>> {
  using Function = std::function<BlockedAtMount(const Pose&)>;
  static std::string type() { return "CollisionModel | None"; }
  static nb::object to(const Function&) { return nb::none(); }
  static Function from(nb::handle value, const char* name);
};

template <>
struct Fields<PlacementOptions>
    : Members<&PlacementOptions::lower, &PlacementOptions::upper, &PlacementOptions::step,
              &PlacementOptions::headings, &PlacementOptions::count, &PlacementOptions::max_checked,
              &PlacementOptions::lines, &PlacementOptions::blocked_by, &PlacementOptions::threads,
              &PlacementOptions::budget> {};

template <>
struct Fields<Placement>
    : Members<&Placement::world_T_mount, &Placement::heading, &Placement::margin,
              &Placement::manipulability, &Placement::solutions, &Placement::duration> {};

template <>
struct Fields<PlacementResult>
    : Members<&PlacementResult::placements, &PlacementResult::mounts, &PlacementResult::checked,
              &PlacementResult::reaching, &PlacementResult::blocked,
              &PlacementResult::blocked_reason, &PlacementResult::without_lines,
              &PlacementResult::blocked_lines, &PlacementResult::ending> {};

/// The positions of a map in a plane perpendicular to an axis of the world. Notebooks draw it.
struct SliceArray {
  KeptArm arm;
  std::string title;  ///< in pictures: the arm's name, unless with_title() set it
  ReachMeasure measure = ReachMeasure::directions;
  WorldAxis normal = WorldAxis::z;  ///< the axis that the plane is perpendicular to
  double at = 0;
  std::vector<WorldAxis> axes;  ///< the two axes of the values
  std::vector<ReachAxis> grid;
  KeptArray<float> values;
};

SliceArray arrays_of(const ReachSlice& slice);
ReachSlice slice_of(const SliceArray& arrays);

/// The plane of a slice as Python's arguments `axis`, `at` and `measure`.
struct SlicePlane {
  int normal;
  double at;
  ReachMeasure measure;
  SlicePlane(nb::handle axis, nb::handle coordinate, nb::handle shown);
  static void takes(Signature& signature);
};

/// Their parts of the module, of bind_reach().
void bind_placement(nb::module_& module);
void bind_comparison(nb::module_& module);

template <>
struct Fields<SliceArray>
    : Members<&SliceArray::arm, &SliceArray::title, &SliceArray::measure, &SliceArray::normal,
              &SliceArray::at, &SliceArray::axes, &SliceArray::grid, &SliceArray::values> {
  static constexpr const char* name = "ReachSlice";

  static void check(const SliceArray& slice) {
    const auto shape = slice.values.shape();
    const bool fits = slice.axes.size() == 2 && slice.grid.size() == 2 && shape.size() == 2 &&
                      slice.axes[0] != slice.axes[1] && slice.axes[0] != slice.normal &&
                      slice.axes[1] != slice.normal && shape[0] == slice.grid[0].cells &&
                      shape[1] == slice.grid[1].cells;
    if (!fits) throw Error("the slice's axes, cells and values do not fit together");
  }
};

}  // namespace beeline::python
