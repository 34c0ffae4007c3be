#pragma once

#include "reach_fields.h"
#include "reason.h"

namespace beeline::python {

template <>
struct Fields<PlacementOptions> {
  static constexpr auto all() {
    using Options = PlacementOptions;
    return std::tuple(
        field("lower", &Options::lower,
              "Corner of the box of the mount's positions, m, in the world of the poses, (3,); "
              "default: in x and y where all poses are within reach, z = 0."),
        field("upper", &Options::upper, "The opposite corner, (3,)."),
        field("step", &Options::step, "Between positions, m; default: the map's cells."),
        field("headings", &Options::headings, "Rotations about z in equal steps, 1 to 360."),
        field("count", &Options::count, "Placements to return, 1 to 1000."),
        field("max_checked", &Options::max_checked,
              "Mounts that are checked, those first which the map ranks first; at least 1."),
        field("lines", &Options::lines,
              "Only placements from which the tool can move in straight lines through the poses, "
              "one after the other. The search ends after ten times `count` mounts, at least 100, "
              "without."),
        field("threads", &Options::threads,
              "0: one for each core. The result does not depend on it."),
        field("budget", &Options::budget, ""));
  }
};

template <>
struct Fields<Placement> {
  static constexpr const char* name = "Placement";
  static constexpr const char* doc = "A mount of the arm from which it reaches all poses.";
  static constexpr auto all() {
    return std::tuple(
        field("world_T_mount", &Placement::world_T_mount, "As Arm.with_mount() takes it, (4, 4)."),
        field("heading", &Placement::heading, "Rotation about z, rad, from 0 to 2 pi."),
        field("margin", &Placement::margin,
              "The least margin to the joint limits over all poses, at `solutions`."),
        field("manipulability", &Placement::manipulability, "The least of these."),
        field("solutions", &Placement::solutions,
              "Of each pose, the configuration with the largest margin, (N, n)."),
        field("duration", &Placement::duration, "Of the lines, s; 0 without the option `lines`."));
  }
};

template <>
struct Fields<PlacementResult> {
  static constexpr const char* name = "PlacementResult";
  static constexpr const char* doc = "Where an arm can stand to reach all poses.";
  static constexpr const char* truth = "True if there is a placement.";
  static constexpr auto all() {
    using Result = PlacementResult;
    return std::tuple(
        field("placements", &Result::placements,
              "The largest margin first, then manipulability; of each position the best heading."),
        field("mounts", &Result::mounts, "Of the grid."),
        field("checked", &Result::checked, "Of these, by inverse kinematics at every pose."),
        field("reaching", &Result::reaching, "Of these, all poses reached."),
        field("without_lines", &Result::without_lines, "Of these, refused because of the lines."),
        field("ending", &Result::ending, "Whether the budget ended the search."));
  }
};

/// A ReachSlice whose axes have names and whose values are an array.
struct SliceArray {
  KeptArm arm;
  std::string title;
  ReachMeasure measure = ReachMeasure::directions;
  WorldAxis normal = WorldAxis::z;
  double at = 0;
  std::vector<WorldAxis> axes;
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
struct Fields<SliceArray> {
  static constexpr const char* name = "ReachSlice";
  static constexpr const char* doc =
      "The positions of a map in a plane perpendicular to an axis of the world. Notebooks draw it.";
  static constexpr auto all() {
    using Slice = SliceArray;
    return std::tuple(
        field("arm", &Slice::arm, "The arm."),
        field("title", &Slice::title, "In pictures: the arm's name, unless with_title() set it."),
        field("measure", &Slice::measure, "What the values are: the best of all orientations."),
        field("normal", &Slice::normal, "The axis that the plane is perpendicular to."),
        field("at", &Slice::at, "Its coordinate, of the centres of the cells, m."),
        field("axes", &Slice::axes, "The two axes of the values."),
        field("grid", &Slice::grid, "The cells along these."),
        field("values", &Slice::values, "(cells of axes[0], cells of axes[1]); NaN: not reached."));
  }
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
