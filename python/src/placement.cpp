#include <beeline/draw/timing_figure.h>
#include <beeline/reach/surface.h>

#include "bindings.h"
#include "collision_fields.h"
#include "draw_fields.h"
#include "interruption.h"
#include "placement_fields.h"
#include "plane_poses.h"
#include "rows.h"

namespace beeline::python {
namespace {

using RowMajor = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

}  // namespace

SliceArray arrays_of(const ReachSlice& slice) {
  const auto axis = [](int k) { return static_cast<WorldAxis>(k); };
  const Index rows = slice.values.rows(), columns = slice.values.cols();
  SliceArray arrays{.arm = {nb::cast(slice.arm)},
                    .title = slice.title,
                    .measure = slice.measure,
                    .normal = axis(slice.normal),
                    .at = slice.at,
                    .axes = {axis(slice.axes[0]), axis(slice.axes[1])},
                    .grid = {slice.grid.begin(), slice.grid.end()},
                    .values = kept_array<float>({{rows, columns}})};
  Eigen::Map<RowMajor>(arrays.values.data(), rows, columns) = slice.values;
  return arrays;
}

ReachSlice slice_of(const SliceArray& arrays) {
  const auto index = [](WorldAxis axis) { return static_cast<int>(axis); };
  const auto shape = arrays.values.shape();
  return {.arm = *arrays.arm,
          .title = arrays.title,
          .measure = arrays.measure,
          .normal = index(arrays.normal),
          .at = arrays.at,
          .axes = {index(arrays.axes[0]), index(arrays.axes[1])},
          .grid = {arrays.grid[0], arrays.grid[1]},
          .values = Eigen::Map<const RowMajor>(arrays.values.data(), shape[0], shape[1])};
}

SlicePlane::SlicePlane(nb::handle axis, nb::handle coordinate, nb::handle shown)
    : normal(static_cast<int>(Value<WorldAxis>::from(axis, "axis"))),
      at(Value<double>::from(coordinate, "at")),
      measure(Value<ReachMeasure>::from(shown, "measure")) {}

void SlicePlane::takes(Signature& signature) {
  signature.takes("axis", Value<WorldAxis>::type(), "The axis that the plane is perpendicular to.")
      .takes("at", "float", "Its coordinate, m, in the world.")
      .takes("measure", Value<ReachMeasure>::type(),
             "The best of all orientations at a position; directions: the fraction of them that is "
             "reached.",
             "'directions'");
}

namespace {

Picture picture_of(const SliceArray& arrays) {
  const ReachSlice slice = slice_of(arrays);
  return without_lock([&] { return compose(reach_figure(slice)); });
}

}  // namespace

std::function<BlockedAtMount(const Pose&)> Value<std::function<BlockedAtMount(const Pose&)>>::from(
    nb::handle value, const char* name) {
  if (value.is_none()) return {};
  return [model = shared_model(value, name)](const Pose& world_T_mount) {
    return blocked_at_mounts(*model)(world_T_mount);
  };
}

namespace {

/// The picture of a slice or of two.
Picture picture_from(nb::handle slice) {
  const SliceArray* single = nullptr;
  if (nb::try_cast<const SliceArray*>(slice, single) && single) return picture_of(*single);
  if (!is_list(slice)) {
    raise_type("slice", "a ReachSlice or a list of two", slice);
  }
  const auto pair = Value<std::array<SliceArray, 2>>::from(slice, "slice");
  const std::array<ReachSlice, 2> slices{slice_of(pair[0]), slice_of(pair[1])};
  return without_lock([&] { return compose(reach_figure(slices)); });
}

void bind_placements(nb::module_& m) {
  bind_record<Placement>(m);
  nb::class_<PlacementResult> result = bind_record<PlacementResult>(m);
  result.def_prop_ro(
      "reason", [](const PlacementResult& self) { return Value<Reason>::to(reason_of(self)); },
      getter("reason", "Reason"),
      "Why there is no placement, or why the search ended early; empty otherwise.");
  Signature find("find_placements", "PlacementResult", comment("find_placements"));
  find.takes("map", "ReachMap", "Of directions, headings or rolls.")
      .takes("poses", arm_poses_like, arm_poses_doc)
      .options<PlacementOptions>();
  find.returns("True if there is a placement; else it has a `reason`.");
  define(
      m,
      [](const ReachMap& map, nb::handle poses, const nb::kwargs& keywords) {
        const std::vector<Pose> reached = PosePlane(map.arm()).poses(poses, "poses");
        auto asked = options<PlacementOptions>(keywords);
        check_options_of(map.arm(), keywords);
        check_threads(asked.threads);
        return unlocked(asked.budget, [&] { return find_placements(map, reached, asked); });
      },
      find, nb::arg("map"), nb::arg("poses"), nb::arg("keywords"));
}

void bind_slice(nb::module_& m) {
  nb::class_<SliceArray> slice = bind_record<SliceArray>(m);
  slice.def_prop_ro(
      "coordinates",
      [](const SliceArray& self) {
        const auto centres = [](const ReachAxis& axis) {
          const nb::object cells = nb::cast(axis);  // .attr() alone would not keep it
          return nb::object(cells.attr("centres"));
        };
        return nb::make_tuple(centres(self.grid[0]), centres(self.grid[1]));
      },
      nb::for_getter(nb::sig("def coordinates(self) -> tuple[numpy.typing.NDArray[numpy.float64], "
                             "numpy.typing.NDArray[numpy.float64]]")),
      "Of the centres along the two axes of the values, m.");
  slice.def("_repr_svg_", [](const SliceArray& self) { return notebook_svg(picture_of(self)); });
  Signature title("with_title", "ReachSlice", "Returns a copy with another title.");
  title.takes("self").takes("title", "str", "What pictures name it.");
  define(
      slice,
      [](const SliceArray& self, nb::handle text) {
        SliceArray copy = self;
        copy.title = Value<std::string>::from(text, "title");
        return copy;
      },
      title, nb::arg("title"));
}

void bind_slices(nb::module_& m) {
  bind_slice(m);
  Signature of("slice_of", "ReachSlice",
               "Returns the positions of a map in a plane: those around the coordinate `at` of an "
               "axis. Raises Error for a coordinate outside the map, and for an incomplete map.");
  of.takes("map", "ReachMap", "The map.");
  SlicePlane::takes(of);
  define(
      m,
      [](const ReachMap& map, nb::handle axis, nb::handle at, nb::handle measure) {
        const SlicePlane plane(axis, at, measure);
        return arrays_of(without_lock(
            [&] { return beeline::slice_of(map, plane.normal, plane.at, plane.measure); }));
      },
      of, nb::arg("map"), nb::arg("axis"), nb::arg("at"), nb::arg("measure") = "directions");

  Signature figure(
      "reach_figure", "Picture",
      "Draws a slice of a map: each position that is reached in the colour of its value, with a "
      "scale beside it, and the arm; or slices of two maps beside each other, with one scale. "
      "Raises Error for another number of slices, and for two of different measures or planes.");
  figure.takes("slice", "ReachSlice | " + Value<std::vector<SliceArray>>::argument_type(),
               "Of slice_of(), or the two of slices_of().");
  define(m, &picture_from, figure, nb::arg("slice"));

  Signature image("write_vti", "None", comment("write_vti"));
  image.takes("map", "ReachMap", "The map.").takes("path", path_like, "A .vti file.");
  define(
      m,
      [](const ReachMap& map, nb::handle path) {
        const std::string file = path_from(path, "path");
        without_lock([&] { write_vti(map, file); });
      },
      image, nb::arg("map"), nb::arg("path"));
}

}  // namespace

void bind_placement(nb::module_& m) {
  bind_placements(m);
  bind_slices(m);
}

}  // namespace beeline::python
