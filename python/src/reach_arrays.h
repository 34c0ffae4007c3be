#pragma once

#include "interruption.h"
#include "reach_fields.h"
#include "rows.h"

namespace beeline::python {

/// ReachGrid in Python: with the arm that it was made for, of which copies and pickles make it.
struct GridOfArm {
  KeptArm arm;
  ReachGrid grid;
};
bool same_grid(const ReachGrid& a, const ReachGrid& b);
/// `15 x 15 x 15 positions of 0.12 m, 54 directions`.
std::string described(const ReachGrid& grid);

/// Whether cells have directions or headings, along an axis of their arrays.
bool has_directions(const ReachGrid& grid);

/// The shape of the cells of `count` positions: (x, y, z) of all, else (count,); then the direction
/// or heading, and the roll, where the grid has them. Throws Error for more cells than are kept in
/// memory.
std::vector<Index> cells_shape(const ReachGrid& grid, Index count);

/// The cells of a range of positions as arrays, which are filled part by part.
class CellWriter {
 public:
  CellWriter(const ReachGrid& grid, Index count);
  /// Copies cells that follow those before.
  void append(const ReachCells& cells);
  CellArrays finish(Ending ending);

 private:
  CellArrays arrays_;
  Index written_ = 0;
};

CellArrays arrays_of(const ReachGrid& grid, const ReachCells& cells);

/// The cells of arrays, which are cells of whole positions. Throws Error for another shape, and for
/// ones that were not computed to the end.
ReachCells cells_of(const ReachGrid& grid, const CellArrays& arrays);

PositionArrays summary_of(const ReachGrid& grid, const ReachCells& cells);

/// The part of ReachMap in the module, and its files.
void bind_map(nb::module_& module);
/// The scene of the option blocked_by, a model; none without. Throws Error for one of another arm.
std::optional<ReachScene> scene_of(const Arm& arm, const nb::kwargs& keywords);

/// The options of computing cells. Throws Error for a negative number of threads, and for a model
/// of another arm.
template <class... Others>
std::tuple<ReachOptions, Others...> reach_options(const Arm& arm, const nb::kwargs& keywords) {
  std::tuple<ReachOptions, Others...> asked{options<ReachOptions, Others...>(keywords)};
  check_threads(std::get<0>(asked).threads);
  std::get<0>(asked).scene = scene_of(arm, keywords);
  return asked;
}

/// Opens a file of a map. Throws Error in a build without HDF5, as the functions of files do.
ReachMap loaded_map(const std::string& path);
void bind_map_files(nb::module_& module, nb::class_<ReachMap>& map);

}  // namespace beeline::python
