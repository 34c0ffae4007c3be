#include "reach.h"

#include <algorithm>
#include <array>
#include <limits>

#include <beeline/io/text/arm.h>
#include <beeline/reach/reach.h>
#include <beeline/reach/surface.h>

#include "fault.h"
#include "handles.h"
#include "progress.h"

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
Map planned(const Arm& arm, const ReachGridOptions& options, double rolls) {
  try {
    return planned(arm, options);
  } catch (const Error&) {
    if (arm.planar() || options.orientation) throw;
    ReachGridOptions rolled = options;
    rolled.rolls = rolls;
    return planned(arm, rolled);
  }
}

std::array<std::vector<float>, 4> measures_of(const ReachPositions& best) {
  std::array<std::vector<float>, 4> measures{best.directions,
                                             {best.branches.begin(), best.branches.end()},
                                             best.manipulability,
                                             best.margin};
  for (std::size_t p = 0; p < best.branches.size(); ++p) {
    if (best.branches[p] > 0) continue;
    for (auto& measure : measures) measure[p] = std::numeric_limits<float>::quiet_NaN();
  }
  return measures;
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

int beeline_reach_compute(int map) {
  return guarded([&] {
    Map& known = maps().at(map);
    const ReachCells cells = reach_cells(known.arm, known.grid, 0, known.grid.positions(),
                                         {.budget = {.progress = report_progress}});
    known.measures = measures_of(reach_positions(known.grid, cells));
    return static_cast<int>(std::count_if(cells.branches.begin(), cells.branches.end(),
                                          [](std::uint8_t branches) { return branches > 0; }));
  });
}

const float* beeline_reach_values(int map, int measure) {
  return array([&] { return maps().at(map).measures.at(measure).data(); });
}

int beeline_reach_surface(int map, const float* values, int count, double level) {
  return guarded([&] {
    Map& known = maps().at(map);
    known.surface = reach_surface(known.grid, {values, values + count}, level);
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
