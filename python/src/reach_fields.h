#pragma once

#include <algorithm>

#include <beeline/reach/place.h>
#include <beeline/reach/reach.h>
#include <beeline/reach/reach_map.h>
#include <beeline/reach/surface.h>

#include "inverse_fields.h"
#include "kept_array.h"
#include "record.h"

namespace beeline::python {

/// An axis of the world, 0 to 2 in C++.
enum class WorldAxis { x, y, z };
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
struct Fields<ReachAxis> : Members<&ReachAxis::cells, &ReachAxis::lower, &ReachAxis::step> {
  static void check(const ReachAxis& axis) {
    if (axis.cells < 1 || axis.cells > 1'000'000) throw Error("an axis has 1 to 1e6 cells");
    if (!(std::isfinite(axis.lower) && std::isfinite(axis.step) && axis.step > 0)) {
      throw Error("an axis begins at a finite coordinate and has cells of an edge above 0");
    }
  }
};

template <>
struct Fields<ReachGridOptions>
    : Members<&ReachGridOptions::resolution, &ReachGridOptions::lower, &ReachGridOptions::upper,
              &ReachGridOptions::azimuths, &ReachGridOptions::orientation,
              &ReachGridOptions::any_orientation, &ReachGridOptions::directions,
              &ReachGridOptions::rolls> {};

template <>
struct Fields<ReachOptions>
    : Members<&ReachOptions::samples, &ReachOptions::redundant_values, &ReachOptions::blocked_by,
              &ReachOptions::threads, &ReachOptions::budget> {};

template <>
struct Fields<ReachScene>
    : Members<&ReachScene::digest, &ReachScene::clearance, &ReachScene::files> {
  static constexpr std::size_t required = 1;
};

/// What a ReachMapHeader says besides the arm and the grid: ReachOptions of the same names.
struct MapOptions {
  /// As reach_cells() takes it, 1 to 1000.
  int redundant_values = ReachOptions().redundant_values;
  std::int64_t samples = 0;  ///< configurations of a map by sampling; 0: by inverse kinematics
  /// The scene in which solutions are free, of the model of blocked_by; None: all solutions count.
  std::optional<ReachScene> scene = std::nullopt;
};

template <>
struct Fields<MapOptions>
    : Members<&MapOptions::redundant_values, &MapOptions::samples, &MapOptions::scene> {
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

/// What an arm can do at the centres of cells, with all solutions of inverse kinematics within the
/// joint limits, counted modulo 2 pi; by sampling, anywhere in a cell. Arrays of the shape
/// ReachGrid.shape, or (N, ...) of N of the positions.
struct CellArrays {
  KeptArray<std::uint8_t> branches;
  KeptArray<float> manipulability, margin;
  Ending ending = Ending::complete;
  /// False if the budget ended the computation.
  explicit operator bool() const { return ending == Ending::complete; }
};

template <>
struct Fields<CellArrays> : Members<&CellArrays::branches, &CellArrays::manipulability,
                                    &CellArrays::margin, &CellArrays::ending> {
  static constexpr const char* name = "ReachCells";
  static constexpr std::size_t required = 3;

  static void check(const CellArrays& cells) {
    const auto shape = cells.branches.shape();
    if (!std::ranges::equal(shape, cells.manipulability.shape()) ||
        !std::ranges::equal(shape, cells.margin.shape())) {
      throw Error("branches, manipulability and margin have different shapes");
    }
  }
};

/// The best of all orientations at each position. Arrays (x, y, z), or (N,) of N of the positions.
struct PositionArrays {
  KeptArray<float> directions;
  KeptArray<std::uint8_t> branches;
  KeptArray<float> manipulability, margin;
};

template <>
struct Fields<PositionArrays> : Members<&PositionArrays::directions, &PositionArrays::branches,
                                        &PositionArrays::manipulability, &PositionArrays::margin> {
  static constexpr const char* name = "ReachPositions";
};

template <>
struct Fields<ReachMap::Totals>
    : Members<&ReachMap::Totals::cells, &ReachMap::Totals::reached, &ReachMap::Totals::positions,
              &ReachMap::Totals::reached_positions, &ReachMap::Totals::volume> {
  static constexpr const char* name = "ReachTotals";
};

template <>
struct Fields<ReachShard> : Members<&ReachShard::number, &ReachShard::count> {
  static constexpr std::size_t required = 2;
  static constexpr bool as_tuple = true;
};

/// The options of compute_reach_map() besides ReachOptions.
struct ShardOptions {
  ReachShard shard;  ///< which part of the map, (number, count); merge_reach_maps() joins the parts
};

template <>
struct Fields<ShardOptions> : Members<&ShardOptions::shard> {};

}  // namespace beeline::python
