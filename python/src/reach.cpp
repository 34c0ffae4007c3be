#include <beeline/reach/reach.h>

#include "bindings.h"
#include "placement_fields.h"
#include "reach_arrays.h"

namespace beeline::python {
namespace {

/// A number of 0 to count - 1.
Index number_below(nb::handle value, const char* name, Index count) {
  return integer_from(value, name, 0, count - 1);
}

/// The array of number(i) for each i below `count`.
template <class Number>
nb::object numbers(Index count, Number number) {
  std::vector<double> values;
  for (Index i = 0; i < count; ++i) values.push_back(number(i));
  return Value<std::vector<double>>::to(values);
}

/// The tool's z axis of each direction.
nb::object direction_rows(const ReachGrid& grid) {
  NewArray rows({grid.directions(), 3});
  for (Index d = 0; d < grid.directions(); ++d) {
    Eigen::Map<Vector3>(rows.data() + 3 * d) = grid.rotation(d, 0).col(2);
  }
  return rows.release_read_only();
}

/// The pose of a cell, or the poses of many.
nb::object poses_of(const ReachGrid& grid, nb::handle cell) {
  if (PyIndex_Check(cell.ptr()) && !is_array(cell)) {
    return Value<Pose>::to(grid.pose(number_below(cell, "cell", grid.cells())));
  }
  const auto cells = Value<std::vector<std::size_t>>::from(cell, "cell");
  NewArray poses({std::ssize(cells), 4, 4});
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto number = static_cast<Index>(cells[i]);
    if (number >= grid.cells()) {
      throw Error("cell must be a whole number from 0 to " + std::to_string(grid.cells() - 1));
    }
    write_pose(grid.pose(number), poses.data() + 16 * i);
  }
  return poses.release();
}

/// Adds a property whose value is computed once.
template <class Get>
void bind_kept(nb::class_<GridOfArm>& bound, const char* name, const std::string& type,
               const char* doc, Get get) {
  bound.def_prop_ro(
      name,
      [name, get](nb::handle_t<GridOfArm> self) {
        return kept(self, name, [&] { return get(nb::cast<const GridOfArm&>(self).grid); });
      },
      getter(name, type), doc);
}

/// The centres along an axis of the grid; a grid of the other kind has no such axis.
nb::object centres_along(const ReachGrid& grid, std::size_t axis, bool cylindrical,
                         const char* name) {
  if (grid.cylindrical() != cylindrical) {
    throw nb::attribute_error(
        (std::string(grid.cylindrical()
                         ? "positions by azimuths have radius, height and azimuth, not "
                         : "a box of positions has x, y and z, not ") +
         name)
            .c_str());
  }
  const ReachAxis& cells = grid.axes()[axis];
  return numbers(cells.cells, [&](Index i) { return cells.centre(i); });
}

void bind_coordinates(nb::class_<GridOfArm>& grid) {
  static constexpr const char* names[] = {"x", "y", "z", "radius", "height", "azimuth"};
  for (std::size_t k = 0; k < 6; ++k) {
    const char* doc = k < 3    ? "Coordinates of the centres, m, in the world."
                      : k == 3 ? "Radii of the centres about the axis of the first joint, m."
                      : k == 4 ? "Heights of the centres, m, in the world."
                               : "Azimuths of the centres, from x towards y, rad.";
    bind_kept(grid, names[k], array_type, doc,
              [k](const ReachGrid& self) { return centres_along(self, k % 3, k >= 3, names[k]); });
  }
  bind_kept(grid, "directions", array_type,
            "The tool's z axis of each direction or heading, unit vectors (n, 3); with azimuths, "
            "at azimuth 0.",
            direction_rows);
  bind_kept(grid, "fractions", array_type,
            "The fraction of all directions that each stands for, (n,).",
            [](const ReachGrid& self) {
              return numbers(self.directions(), [&](Index d) { return self.fraction(d); });
            });
  bind_kept(grid, "headings", std::string(array_type) + " | None",
            "Rotations about the world's z, rad, (n,): of planar arms, else None.",
            [](const ReachGrid& self) -> nb::object {
              if (self.orientations() != ReachOrientations::headings) return nb::none();
              return numbers(self.directions(), [&](Index d) { return self.heading(d); });
            });
  bind_kept(grid, "rolls", std::string(array_type) + " | None",
            "Rotations about the tool direction, rad, (n,); None where any roll will do, and "
            "without directions.",
            [](const ReachGrid& self) -> nb::object {
              if (self.orientations() != ReachOrientations::rolls) return nb::none();
              return numbers(self.rolls(), [&](Index r) { return self.roll(r); });
            });
  bind_kept(grid, "orientation", std::string(array_type) + " | None",
            "Orientation of all cells, world_R_tool (3, 3), if it is fixed; else None.",
            [](const ReachGrid& self) -> nb::object {
              if (self.orientations() != ReachOrientations::fixed) return nb::none();
              return read_only(Value<Rotation>::to(self.orientation()));
            });
}

void bind_counts(nb::class_<GridOfArm>& grid) {
  grid.def_prop_ro(
      "axes",
      [](const GridOfArm& self) {
        const auto& axes = self.grid.axes();
        return Value<std::vector<ReachAxis>>::to({axes.begin(), axes.end()});
      },
      getter("axes", "list[ReachAxis]"), comment("ReachGrid::axes"));
  grid.def_prop_ro(
      "cylindrical", [](const GridOfArm& self) { return self.grid.cylindrical(); },
      "Whether positions are radius, height and azimuth; orientations then turn with the azimuth.");
  grid.def_prop_ro(
      "orientations",
      [](const GridOfArm& self) { return Value<ReachOrientations>::to(self.grid.orientations()); },
      getter("orientations", Value<ReachOrientations>::type()),
      "How the cells are orientated: all alike, headings of a planar arm, tool directions with any "
      "roll, tool directions with rolls, or any way.");
  grid.def_prop_ro(
      "shape",
      [](const GridOfArm& self) {
        return nb::tuple(nb::cast<nb::list>(
            Value<std::vector<Index>>::to(cells_shape(self.grid, self.grid.positions()))));
      },
      getter("shape", "tuple[int, ...]"),
      "Of arrays of all cells: along the three axes, then the direction or heading, then the roll, "
      "where the grid has them.");
  grid.def_prop_ro(
      "positions", [](const GridOfArm& self) { return self.grid.positions(); },
      "Number of positions.");
  grid.def_prop_ro(
      "cells", [](const GridOfArm& self) { return self.grid.cells(); }, "Number of cells.");
}

void bind_places(nb::class_<GridOfArm>& grid) {
  Signature pose("pose", array_type, "Returns the pose world_T_tool at the centre of a cell.");
  pose.takes("self").takes("cell", std::string("int | ") + array_like,
                           "Its number, as in flattened arrays of all cells; or many (N,).");
  pose.returns("(4, 4), or (N, 4, 4).");
  define(
      grid, [](const GridOfArm& self, nb::handle cell) { return poses_of(self.grid, cell); }, pose,
      nb::arg("cell"));
  Signature cell("cell_of", "int | None",
                 "Returns the number of the cell nearest to a pose in direction and roll, whatever "
                 "the orientation where it is fixed; None for a position outside.");
  cell.takes("self").takes("world_T_tool", array_like, "Pose of the tool (4, 4).");
  define(
      grid,
      [](const GridOfArm& self, nb::handle tool) {
        return Value<std::optional<Index>>::to(
            self.grid.cell_of(Value<Pose>::from(tool, "world_T_tool")));
      },
      cell, nb::arg("world_T_tool"));
  Signature position(
      "position_of", "int | None",
      "Returns the number of the position whose cell contains a point; None for a point outside.");
  position.takes("self").takes("point", array_like, "m, in the world, (3,).");
  define(
      grid,
      [](const GridOfArm& self, nb::handle point) {
        return Value<std::optional<Index>>::to(
            self.grid.position_of(finite_from<Vector3>(point, "point")));
      },
      position, nb::arg("point"));
  Signature centre("centre", array_type,
                   "Returns the centre of a position, m, in the world, (3,).");
  centre.takes("self").takes("p", "int", "Its number, as in flattened arrays (x, y, z).");
  define(
      grid,
      [](const GridOfArm& self, nb::handle p) {
        return Value<Vector3>::to(self.grid.centre(number_below(p, "p", self.grid.positions())));
      },
      centre, nb::arg("p"));
}

GridOfArm made_grid(nb::handle arm, const ReachGridOptions& asked) {
  const KeptArm kept = Value<KeptArm>::from(arm, "arm");
  return {kept, ReachGrid(*kept, asked)};
}

void bind_grid_state(nb::class_<GridOfArm>& grid) {
  grid.def("__repr__",
           [](const GridOfArm& self) { return "ReachGrid(" + described(self.grid) + ")"; });
  bind_equality(grid,
                [](const GridOfArm& a, const GridOfArm& b) { return same_grid(a.grid, b.grid); });
  grid.def(
      "__getstate__",
      [](const GridOfArm& self) {
        return nb::make_tuple(self.arm.object, state_of(self.grid.options()));
      },
      nb::sig("def __getstate__(self) -> tuple[object, ...]"));
  grid.def(
      "__setstate__",
      [](GridOfArm& self, const nb::tuple& state) {
        if (nb::len(state) != 2 || !nb::isinstance<nb::tuple>(state[1])) {
          throw Error("the pickled state does not belong to a ReachGrid");
        }
        const auto asked = restored<ReachGridOptions>(nb::borrow<nb::tuple>(state[1]));
        new (&self) GridOfArm(made_grid(state[0], asked));
      },
      nb::sig("def __setstate__(self, state: tuple[object, ...], /) -> None"));
}

CellArrays computed_cells(const Arm& arm, const ReachGrid& grid, nb::handle first, nb::handle last,
                          const nb::kwargs& keywords) {
  auto [asked] = reach_options(arm, keywords);
  const Index begin = Value<Index>::from(first, "first");
  const Index end = Value<std::optional<Index>>::from(last, "last").value_or(grid.positions());
  cells_shape(grid, std::max<Index>(0, end - begin));  // refuses too many
  return arrays_of(grid, unlocked(asked.budget, [&, &with = asked] {
                     return reach_cells(arm, grid, begin, end, with);
                   }));
}

void bind_cells(nb::module_& m) {
  Signature cells(
      "reach_cells", "ReachCells",
      "Computes what an arm can do at the cells of a range of positions. Where any roll will do, a "
      "direction is reached if some value of the last joint reaches it, and the margin is over "
      "the other joints. Raises Error for positions that the grid does not have, for an arm with "
      "fewer joints than a pose has components, without rolls for an arm whose last joint does not "
      "turn about the tool's z axis, for azimuths of an arm whose solutions cannot all be "
      "computed, and by sampling for azimuths, one orientation, and a joint without position "
      "limits that is not revolute or that others follow.");
  cells.takes_arm()
      .takes("grid", "ReachGrid", "The cells.")
      .takes("first", "int", "First position.", "0")
      .takes("last", "int | None", "The one after the last position; None: all.", "None")
      .options<ReachOptions>();
  define(
      m,
      [](const Arm& arm, const GridOfArm& grid, nb::handle first, nb::handle last,
         const nb::kwargs& keywords) {
        return computed_cells(arm, grid.grid, first, last, keywords);
      },
      cells, nb::arg("arm"), nb::arg("grid"), nb::arg("first") = 0, nb::arg("last") = nb::none(),
      nb::arg("options"));

  Signature positions("reach_positions", "ReachPositions",
                      "Summarises cells: the best of all orientations at each position. A "
                      "direction is reached if it is with some roll. Raises Error for cells of "
                      "another grid, and for ones that were not computed to the end.");
  positions.takes("grid", "ReachGrid", "The grid of the cells.")
      .takes("cells", "ReachCells", "Of whole positions.");
  define(
      m,
      [](const GridOfArm& grid, const CellArrays& computed) {
        return summary_of(grid.grid, cells_of(grid.grid, computed));
      },
      positions, nb::arg("grid"), nb::arg("cells"));
}

}  // namespace

std::string described(const ReachGrid& grid) {
  std::string text;
  for (const ReachAxis& axis : grid.axes()) {
    text += (text.empty() ? "" : " x ") + std::to_string(axis.cells);
  }
  text += std::string(grid.cylindrical() ? " positions by azimuths" : " positions") + " of " +
          number(grid.axes()[0].step) + " m";
  const auto add = [&text](Index count, const char* of) {
    text += ", " + std::to_string(count) + of;
  };
  if (!has_directions(grid)) return text;
  add(grid.directions(),
      grid.orientations() == ReachOrientations::headings ? " headings" : " directions");
  if (grid.orientations() == ReachOrientations::rolls) add(grid.rolls(), " rolls");
  return text;
}

void bind_reach(nb::module_& m) {
  nb::class_<ReachAxis> axis = bind_record<ReachAxis>(m);
  axis.def_prop_ro(
      "centres",
      [](const ReachAxis& self) {
        return numbers(self.cells, [&](Index i) { return self.centre(i); });
      },
      getter("centres", std::string(array_type)), "Coordinates of the centres, m.");
  nb::class_<GridOfArm> grid(
      m, "ReachGrid", nb::dynamic_attr(),
      "The cells of a map of an arm in its world: positions on a grid and, at each of them, the "
      "same orientations. Cell numbers count the flattened array of `shape`.");
  Signature made("__init__", "None",
                 "Makes the grid. Raises Error for an orientation together with directions, rolls "
                 "or azimuths, azimuths of an arm whose first joint does not turn about an axis "
                 "parallel to z, a box that is empty or without bounds, more than a million cells "
                 "along an axis, and more than 2^52 in all.");
  made.takes("self").takes_arm().options<ReachGridOptions>();
  define(
      grid,
      [](GridOfArm* self, nb::handle arm, const nb::kwargs& keywords) {
        new (self) GridOfArm(made_grid(arm, options<ReachGridOptions>(keywords)));
      },
      made, nb::arg("arm"), nb::arg("keywords"));
  bind_coordinates(grid);
  bind_counts(grid);
  bind_places(grid);
  bind_grid_state(grid);
  bind_record<CellArrays>(m);
  bind_record<PositionArrays>(m);
  bind_cells(m);
  bind_map(m);
  bind_placement(m);
  bind_comparison(m);
}

}  // namespace beeline::python
