#pragma once

#include <algorithm>

#include <beeline/reach/place.h>
#include <beeline/reach/reach.h>
#include <beeline/reach/reach_map.h>
#include <beeline/reach/surface.h>

#include "kept_array.h"
#include "record.h"

namespace beeline::python {

template <>
inline std::vector<ReachMeasure> choices() {
  using enum ReachMeasure;
  return {directions, branches, manipulability, margin};
}

template <>
inline std::vector<ReachOrientations> choices() {
  using enum ReachOrientations;
  return {fixed, headings, directions, rolls, any};
}
template <>
inline std::string spelling(ReachOrientations orientations) {
  return name(orientations);
}

/// An axis of the world, 0 to 2 in C++.
enum class WorldAxis { x, y, z };
template <>
inline std::vector<WorldAxis> choices() {
  return {WorldAxis::x, WorldAxis::y, WorldAxis::z};
}
template <>
inline std::string spelling(WorldAxis axis) {
  return {"xyz"[static_cast<int>(axis)]};
}

/// An Arm of Python, kept as it is.
struct KeptArm {
  nb::object object;
  const Arm& operator*() const { return nb::cast<const Arm&>(object); }
};

template <>
struct Value<KeptArm> {
  static std::string type() { return "Arm"; }
  static nb::object to(const KeptArm& value) { return value.object; }
  static KeptArm from(nb::handle value, const char* name) {
    if (!nb::isinstance<Arm>(value)) raise_type(name, type(), value);
    return {nb::borrow(value)};
  }
  static bool same(const KeptArm& a, const KeptArm& b) { return a.object.equal(b.object); }
};

template <>
struct Fields<ReachAxis> {
  static constexpr const char* name = "ReachAxis";
  static constexpr const char* doc = "Equal cells along one coordinate, m, or rad for azimuths.";
  static constexpr auto all() {
    return std::tuple(field("cells", &ReachAxis::cells, "Their number."),
                      field("lower", &ReachAxis::lower, "Where the first one begins."),
                      field("step", &ReachAxis::step, "Their edge."));
  }
  static void check(const ReachAxis& axis) {
    if (axis.cells < 1 || axis.cells > 1'000'000) throw Error("an axis has 1 to 1e6 cells");
    if (!(std::isfinite(axis.lower) && std::isfinite(axis.step) && axis.step > 0)) {
      throw Error("an axis begins at a finite coordinate and has cells of an edge above 0");
    }
  }
};

template <>
struct Fields<ReachGridOptions> {
  static constexpr const char* name = "ReachGridOptions";
  static constexpr auto all() {
    using Options = ReachGridOptions;
    return std::tuple(
        field("resolution", &Options::resolution,
              "Edge of the cells, m; default: a twentieth of the radius of the arm's reach."),
        field("lower", &Options::lower,
              "Corner of the box of positions, m, in the world, (3,); default: of the box around "
              "the arm's reach, so that the centres are multiples of the resolution."),
        field("upper", &Options::upper,
              "The opposite corner, (3,). With `azimuths` corners are (radius, height, 0)."),
        field("azimuths", &Options::azimuths,
              "Angle between azimuths, rad, 0.01 to 2 pi: positions then have cylindrical "
              "coordinates about the axis of the first joint, whose inverse kinematics is solved "
              "once for all azimuths."),
        field("orientation", &Options::orientation,
              "One orientation of the tool for all cells, world_R_tool (3, 3); default: tool "
              "directions, or headings of a planar arm."),
        field("any_orientation", &Options::any_orientation,
              "Any orientation will do: of maps by sampling."),
        field("directions", &Options::directions,
              "Angle between tool directions, or headings, rad, 0.01 to pi/2; default: 30 "
              "degrees."),
        field("rolls", &Options::rolls,
              "Angle between rolls about the tool direction, rad, 0.01 to 2 pi; default: any roll "
              "will do."));
  }
};

template <>
struct Fields<ReachOptions> {
  static constexpr auto all() {
    return std::tuple(
        field("samples", &ReachOptions::samples,
              "Above 0, by sampling: a cell is reached if the tool is in it with one of so many "
              "configurations, which fill the joint ranges evenly. Else by inverse kinematics."),
        field("redundant_values", &ReachOptions::redundant_values,
              "Values of the redundant joint at which all solutions of an arm of seven joints are "
              "computed, 1 to 1000; where there is none, the range between them is searched."),
        field("threads", &ReachOptions::threads,
              "0: one for each core. The results do not depend on it."),
        field("budget", &ReachOptions::budget, ""));
  }
};

/// What a ReachMapHeader says besides the arm and the grid: ReachOptions of the same names.
struct MapOptions {
  int redundant_values = ReachOptions().redundant_values;
  std::int64_t samples = 0;
};

template <>
struct Fields<MapOptions> {
  static constexpr const char* name = "MapOptions";
  static constexpr auto all() {
    return std::tuple(field("redundant_values", &MapOptions::redundant_values,
                            "As reach_cells() takes it, 1 to 1000."),
                      field("samples", &MapOptions::samples,
                            "Configurations of a map by sampling; 0: by inverse kinematics."));
  }
  static void check(const MapOptions& made) {
    if (made.redundant_values < 1 || made.redundant_values > 1000) {
      throw Error("redundant_values is " + std::to_string(made.redundant_values) +
                  "; it can be 1 to 1000");
    }
    if (made.samples < 0 || made.samples > max_samples) {
      throw Error("samples is " + std::to_string(made.samples) + "; it can be 0 to 1e12");
    }
  }
};

/// ReachCells as arrays.
struct CellArrays {
  KeptArray<std::uint8_t> branches;
  KeptArray<float> manipulability, margin;
  Ending ending = Ending::complete;
  explicit operator bool() const { return ending == Ending::complete; }
};

template <>
struct Fields<CellArrays> {
  static constexpr const char* name = "ReachCells";
  static constexpr const char* doc =
      "What an arm can do at the centres of cells, with all solutions of inverse kinematics within "
      "the joint limits, counted modulo 2 pi; by sampling, anywhere in a cell. Arrays of the shape "
      "ReachGrid.shape, or (N, ...) of "
      "N of the positions.";
  static constexpr const char* truth = "False if the budget ended the computation.";
  static constexpr std::size_t required = 3;
  static constexpr auto all() {
    return std::tuple(
        field("branches", &CellArrays::branches,
              "The number of solutions; 0: not reached. A redundant arm: the largest number at one "
              "value of its redundant joint; 1 where the arm has no closed form. By sampling, the "
              "samples in the cell, at most 255."),
        field("manipulability", &CellArrays::manipulability,
              "The largest of a solution, sqrt(det(J J^T)) in metres and radians; NaN: not "
              "reached."),
        field("margin", &CellArrays::margin,
              "The largest margin of a solution to the joint limits: 1 in the middle of all "
              "ranges, 0 on a limit; NaN: not reached."),
        field("ending", &CellArrays::ending, "Unless `complete`, the cells are not to be used."));
  }
  static void check(const CellArrays& cells) {
    const auto shape = cells.branches.shape();
    if (!std::ranges::equal(shape, cells.manipulability.shape()) ||
        !std::ranges::equal(shape, cells.margin.shape())) {
      throw Error("branches, manipulability and margin have different shapes");
    }
  }
};

/// ReachPositions as arrays.
struct PositionArrays {
  KeptArray<float> directions;
  KeptArray<std::uint8_t> branches;
  KeptArray<float> manipulability, margin;
};

template <>
struct Fields<PositionArrays> {
  static constexpr const char* name = "ReachPositions";
  static constexpr const char* doc =
      "The best of all orientations at each position. Arrays (x, y, z), or (N,) of N of the "
      "positions.";
  static constexpr auto all() {
    using Positions = PositionArrays;
    return std::tuple(
        field("directions", &Positions::directions, "Fraction of the directions reached."),
        field("branches", &Positions::branches, "The largest number of solutions."),
        field("manipulability", &Positions::manipulability, "The largest; NaN: not reached."),
        field("margin", &Positions::margin, "The largest; NaN: not reached."));
  }
};

template <>
struct Fields<ReachMap::Totals> {
  static constexpr const char* name = "ReachTotals";
  static constexpr const char* doc = "Counts over the cells of a map.";
  static constexpr auto all() {
    using Totals = ReachMap::Totals;
    return std::tuple(
        field("cells", &Totals::cells, "Those that are here: of a file with part of a map, some."),
        field("reached", &Totals::reached, "Of these."),
        field("positions", &Totals::positions, "Those that are here."),
        field("reached_positions", &Totals::reached_positions,
              "Of these, reached in some orientation."),
        field("volume", &Totals::volume, "Of these, m^3; of planar arms their area, m^2."));
  }
};

template <>
struct Fields<ReachShard> {
  static constexpr const char* name = "ReachShard";
  static constexpr const char* doc =
      "One of `count` equal shares of a map: for one of as many processes.";
  static constexpr std::size_t required = 2;
  static constexpr bool as_tuple = true;
  static constexpr auto all() {
    return std::tuple(field("number", &ReachShard::number, "From 1 to count."),
                      field("count", &ReachShard::count, "Number of shares."));
  }
};

/// The options of compute_reach_map() besides ReachOptions.
struct ShardOptions {
  ReachShard shard;
};

template <>
struct Fields<ShardOptions> {
  static constexpr auto all() {
    return std::tuple(
        field("shard", &ShardOptions::shard,
              "Which part of the map, (number, count); merge_reach_maps() joins the parts."));
  }
};

}  // namespace beeline::python
