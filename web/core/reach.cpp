#include "reach.h"

#include <algorithm>
#include <array>
#include <limits>

#include <beeline/reach/reach.h>
#include <beeline/reach/surface.h>
#include <beeline/read/arm.h>

#include "fault.h"
#include "handles.h"

using namespace beeline;
using web::guarded;

namespace {

struct Map {
  Arm arm;
  ReachGrid grid;
  std::array<std::vector<float>, 4> measures = {};
  ReachSurface surface = {};
};

web::Handles<Map>& maps() {
  static web::Handles<Map> handles("map");
  return handles;
}

/// Throws Error for an arm that has no such map.
Map planned(const Arm& arm, const ReachGridOptions& options) {
  const ReachGrid grid(arm, options);
  if (grid.positions() > std::numeric_limits<int>::max()) throw Error("the map is too large");
  (void)reach_cells(arm, grid, 0, 0);
  return {arm, grid};
}

/// Rolls are there where the arm has no map without them.
Map planned(const Arm& arm, ReachGridOptions options, double rolls) {
  try {
    return planned(arm, options);
  } catch (const Error&) {
    if (arm.planar() || options.orientation) throw;
    options.rolls = rolls;
    return planned(arm, options);
  }
}

void append(Map& map, const ReachPositions& best) {
  for (std::size_t p = 0; p < best.branches.size(); ++p) {
    const bool reached = best.branches[p] > 0;
    const auto branches = static_cast<float>(best.branches[p]);
    const std::array values{best.directions[p], branches, best.manipulability[p], best.margin[p]};
    for (std::size_t k = 0; k < values.size(); ++k) {
      map.measures[k].push_back(reached ? values[k] : std::numeric_limits<float>::quiet_NaN());
    }
  }
}

/// The array that `find` returns, or null where it throws.
template <class Find>
auto array(const Find& find) {
  decltype(find()) found = nullptr;
  guarded([&] { return found = find(), 0; });
  return found;
}

}  // namespace

int beeline_reach(const char* arm, double resolution, double directions, double rolls,
                  const double* orientation) {
  return guarded([&] {
    ReachGridOptions options;
    if (resolution > 0) options.resolution = resolution;
    if (orientation != nullptr) options.orientation = Eigen::Map<const Rotation>(orientation);
    if (orientation == nullptr) options.directions = directions;
    return maps().add(planned(arm_from_text(arm, "arm.json"), options, rolls));
  });
}

int beeline_reach_grid(int map, double* numbers) {
  return guarded([&] {
    const ReachGrid& grid = maps().at(map).grid;
    for (const ReachAxis& axis : grid.axes()) {
      for (const double number : {static_cast<double>(axis.cells), axis.lower, axis.step}) {
        *numbers++ = number;
      }
    }
    *numbers++ = static_cast<double>(grid.directions());
    *numbers = static_cast<double>(grid.rolls());
    return 0;
  });
}

int beeline_reach_orientations(int map, double* numbers) {
  return guarded([&] {
    const ReachGrid& grid = maps().at(map).grid;
    for (Eigen::Index d = 0; d < grid.directions(); ++d) {
      for (Eigen::Index r = 0; r < grid.rolls(); ++r, numbers += 9) {
        Eigen::Map<Rotation>(numbers, 3, 3) = grid.rotation(d, r);
      }
    }
    return 0;
  });
}

int beeline_reach_compute(int map, int first, int last) {
  return guarded([&] {
    Map& known = maps().at(map);
    if (static_cast<std::size_t>(first) != known.measures[0].size()) {
      throw Error("the next position is " + std::to_string(known.measures[0].size()));
    }
    const ReachCells cells = reach_cells(known.arm, known.grid, first, last);
    append(known, reach_positions(known.grid, cells));
    return static_cast<int>(cells.branches.end() - cells.branches.begin() -
                            std::count(cells.branches.begin(), cells.branches.end(), 0));
  });
}

const float* beeline_reach_values(int map, int measure) {
  return array([&] { return maps().at(map).measures.at(measure).data(); });
}

int beeline_reach_surface(int map, const float* values, double level) {
  return guarded([&] {
    Map& known = maps().at(map);
    known.surface = reach_surface(known.grid, {values, values + known.grid.positions()}, level);
    return static_cast<int>(known.surface.triangles.cols());
  });
}

int beeline_reach_vertex_count(int map) {
  return guarded([&] { return static_cast<int>(maps().at(map).surface.vertices.cols()); });
}

const float* beeline_reach_vertices(int map) {
  return array([&] { return maps().at(map).surface.vertices.data(); });
}

const int* beeline_reach_triangles(int map) {
  return array([&] { return maps().at(map).surface.triangles.data(); });
}

int beeline_reach_release(int map) {
  return guarded([&] { return maps().release(map), 0; });
}
