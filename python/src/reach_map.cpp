#include <beeline/reach/reach_map.h>

#include "bindings.h"
#include "collision_fields.h"
#include "reach_arrays.h"

namespace beeline::python {
namespace {

GridOfArm grid_of(const ReachMap& map) { return {{nb::cast(map.arm())}, map.grid()}; }

/// Reads the cells of the positions from `first` to `last` without Python's lock. Ctrl-C ends a
/// reader between two calls.
ReachCells read_cells(const ReachMap& map, Index first, Index last) {
  if (PyErr_CheckSignals() != 0) throw nb::python_error();
  const LockRelease release;
  return map.cells(first, last);
}

CellArrays cells_from(const ReachMap& map, Index first, Index last) {
  if (first < 0 || first > last || last > map.grid().positions()) {
    (void)map.cells(first, last);  // throws
  }
  CellWriter writer(map.grid(), last - first);
  for (Index p = first; p < last;) {
    const Index end = std::min(last, map.block_end(p));
    writer.append(read_cells(map, p, end));
    p = end;
  }
  return writer.finish(Ending::complete);
}

/// All cells, which are read once.
const CellArrays& all_cells(nb::handle self) {
  const auto& map = nb::cast<const ReachMap&>(self);
  const nb::object cells =
      kept(self, "_cells", [&] { return nb::cast(cells_from(map, 0, map.grid().positions())); });
  return nb::cast<const CellArrays&>(cells);
}

MapOptions options_of(const ReachMap& map) {
  const ReachMapHeader& header = map.header();
  return {.redundant_values = header.redundant_values,
          .samples = header.samples,
          .scene = header.scene};
}

bool same_cells(const ReachCells& a, const ReachCells& b) {
  const auto same_values = [](const auto& x, const auto& y) {
    return std::ranges::equal(x, y, [](double u, double v) { return same(u, v); });
  };
  return a.branches == b.branches && same_values(a.manipulability, b.manipulability) &&
         same_values(a.margin, b.margin);
}

bool same_map(const ReachMap& a, const ReachMap& b) {
  const auto arm = [](const ReachMap& map) { return nb::cast(map.arm()); };
  if (!arm(a).equal(arm(b)) || !same_grid(a.grid(), b.grid()) || a.slabs() != b.slabs() ||
      !Value<MapOptions>::same(options_of(a), options_of(b))) {
    return false;
  }
  for (Index p = 0, end = 0; p < a.grid().positions(); p = end) {
    end = a.block_end(p);
    if (a.has(p) && !same_cells(read_cells(a, p, end), read_cells(b, p, end))) return false;
  }
  return true;
}

/// The map of cells as arrays.
ReachMap map_of(const Arm& arm, const ReachGrid& grid, const CellArrays& cells,
                const MapOptions& made) {
  Fields<MapOptions>::check(made);
  return {{arm, grid, made.redundant_values, made.samples, made.scene}, cells_of(grid, cells)};
}

void bind_arrays(nb::class_<ReachMap>& map) {
  const auto add = [&map](const char* name, auto member, const std::string& type, const char* doc) {
    map.def_prop_ro(
        name,
        [member](nb::handle_t<ReachMap> self) {
          return read_only((all_cells(self).*member).array);
        },
        getter(name, type), doc);
  };
  add("branches", &CellArrays::branches, Value<KeptArray<std::uint8_t>>::type(),
      "Number of solutions in each cell, of the shape grid.shape; 0: not reached. Read from a file "
      "when first asked for, and kept.");
  add("manipulability", &CellArrays::manipulability, Value<KeptArray<float>>::type(),
      "The largest manipulability in each cell; NaN: not reached.");
  add("margin", &CellArrays::margin, Value<KeptArray<float>>::type(),
      "The largest margin to the joint limits in each cell; NaN: not reached.");
}

void bind_header(nb::class_<ReachMap>& map) {
  map.def_prop_ro(
      "arm",
      [](nb::handle_t<ReachMap> self) {
        return kept(self, "arm", [&] { return nb::cast(nb::cast<const ReachMap&>(self).arm()); });
      },
      getter("arm", "Arm"), "The arm.");
  map.def_prop_ro(
      "grid",
      [](nb::handle_t<ReachMap> self) {
        return kept(self, "grid",
                    [&] { return nb::cast(grid_of(nb::cast<const ReachMap&>(self))); });
      },
      getter("grid", "ReachGrid"), "The cells.");
  bind_part<MapOptions>(map, &options_of);
  map.def_prop_ro(
      "path", [](const ReachMap& self) { return Value<std::string>::to(self.path()); },
      getter("path", "str"), "Of the file; empty for a map in memory.");
  map.def_prop_ro(
      "slabs",
      [](const ReachMap& self) {
        return nb::object(nb::module_::import_("numpy").attr("array")(
            Value<std::vector<bool>>::to(self.slabs()), nb::arg("dtype") = "bool"));
      },
      getter("slabs", "numpy.typing.NDArray[numpy.bool_]"),
      "Whether each part of the map is here: a file may hold some of them.");
  map.def_prop_ro("complete", &ReachMap::complete, "Whether all are.");
}

void bind_reading(nb::class_<ReachMap>& map) {
  Signature totals("totals", "ReachTotals", "Counts the cells that are here.");
  totals.takes("self");
  define(
      map,
      [](const ReachMap& self) {
        const LockRelease release;
        return self.totals();
      },
      totals);
  Signature cells("cells", "ReachCells", comment("ReachMap::cells"));
  cells.takes("self")
      .takes("first", "int", "First position.", "0")
      .takes("last", "int | None", "The one after the last position; None: all.", "None");
  define(
      map,
      [](const ReachMap& self, nb::handle first, nb::handle last) {
        return cells_from(
            self, Value<Index>::from(first, "first"),
            Value<std::optional<Index>>::from(last, "last").value_or(self.grid().positions()));
      },
      cells, nb::arg("first") = 0, nb::arg("last") = nb::none());
  Signature positions("positions", "ReachPositions",
                      "Summarises the map: the best of all orientations at each position.");
  positions.takes("self");
  define(
      map,
      [](nb::handle_t<ReachMap> self) {
        const ReachGrid& grid = nb::cast<const ReachMap&>(self).grid();
        return summary_of(grid, cells_of(grid, all_cells(self)));
      },
      positions);
}

void bind_map_state(nb::class_<ReachMap>& map) {
  map.def("__repr__", [](const ReachMap& self) {
    const std::string from = self.path().empty() ? "" : ", " + self.path();
    return "ReachMap(" + self.arm().name() + ", " + described(self.grid()) + from +
           (self.complete() ? "" : ", incomplete") + ")";
  });
  bind_equality(map, &same_map);
  map.def(
      "__getstate__",
      [](nb::handle_t<ReachMap> self) {
        const auto& held = nb::cast<const ReachMap&>(self);
        const nb::object path = self.attr("path");
        if (!held.path().empty()) return nb::make_tuple(path);
        return nb::make_tuple(path, grid_of(held), state_of(options_of(held)), all_cells(self));
      },
      nb::sig("def __getstate__(self) -> tuple[object, ...]"));
  map.def(
      "__setstate__",
      [](ReachMap& self, const nb::tuple& state) {
        if (nb::len(state) == 1) {
          new (&self) ReachMap(loaded_map(Value<std::string>::from(state[0], "path")));
          return;
        }
        const GridOfArm* grid = nullptr;
        const CellArrays* cells = nullptr;
        if (nb::len(state) != 4 || !nb::try_cast<const GridOfArm*>(state[1], grid) || !grid ||
            !nb::isinstance<nb::tuple>(state[2]) ||
            !nb::try_cast<const CellArrays*>(state[3], cells) || !cells) {
          throw Error("the pickled state does not belong to a ReachMap");
        }
        const auto made = restored<MapOptions>(nb::borrow<nb::tuple>(state[2]));
        new (&self) ReachMap(map_of(*grid->arm, grid->grid, *cells, made));
      },
      nb::sig("def __setstate__(self, state: tuple[object, ...], /) -> None"));
}

void bind_making(nb::module_& m, nb::class_<ReachMap>& map) {
  Signature made("__init__", "None",
                 "Makes a map in memory of cells that were computed. Raises Error for cells that "
                 "were not computed to the end or do not cover all positions of the grid.");
  made.takes("self")
      .takes_arm()
      .takes("grid", "ReachGrid", "The cells.")
      .takes("cells", "ReachCells", "Of all positions, as reach_cells() returns them.")
      .options<MapOptions>();
  define(
      map,
      [](ReachMap* self, const Arm& arm, const GridOfArm& grid, const CellArrays& cells,
         const nb::kwargs& keywords) {
        new (self) ReachMap(map_of(arm, grid.grid, cells, options<MapOptions>(keywords)));
      },
      made, nb::arg("arm"), nb::arg("grid"), nb::arg("cells"), nb::arg("options"));
  Signature computed("reach_map", "ReachMap",
                     "Computes the map of an arm in memory: ReachMap of the reach_cells() of all "
                     "positions of a ReachGrid. Raises Error as ReachGrid and reach_cells() do, "
                     "and for a map that the budget ended.");
  computed.takes_arm().options<ReachGridOptions>().options<ReachOptions>();
  define(
      m,
      [](const Arm& arm, const nb::kwargs& keywords) {
        auto [with, asked] = reach_options<ReachGridOptions>(arm, keywords);
        ReachOptions& reach = with;
        const ReachGrid grid(arm, asked);
        cells_shape(grid, grid.positions());  // refuses too many
        ReachCells cells = unlocked(
            reach.budget, [&] { return reach_cells(arm, grid, 0, grid.positions(), reach); });
        return ReachMap({arm, grid, reach.redundant_values, reach.samples, reach.scene},
                        std::move(cells));
      },
      computed, nb::arg("arm"), nb::arg("options"));
}

}  // namespace

std::optional<ReachScene> scene_of(const Arm& arm, const nb::kwargs& keywords) {
  check_options_of(arm, keywords);
  if (!keywords.contains("blocked_by")) return std::nullopt;
  const CollisionModel* model = nullptr;
  if (!nb::try_cast<const CollisionModel*>(keywords["blocked_by"], model) || !model) {
    return std::nullopt;
  }
  return ReachScene{.digest = digest(*model), .clearance = model->clearance()};
}

void bind_map(nb::module_& m) {
  bind_record<ReachScene>(m);
  bind_record<ReachMap::Totals>(m);
  bind_record<ReachShard>(m);
  nb::class_<ReachMap> map(
      m, "ReachMap", nb::dynamic_attr(),
      "What an arm can do at the cells of a grid, in memory or in an HDF5 file, whose cells are "
      "read when they are asked for. Copies and pickles of a map in a file are of its path.");
  bind_making(m, map);
  bind_map_files(m, map);
  bind_header(map);
  bind_arrays(map);
  bind_reading(map);
  bind_map_state(map);
}

}  // namespace beeline::python
