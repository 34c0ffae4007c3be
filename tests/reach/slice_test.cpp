#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include <beeline/model/catalog.h>
#include <beeline/reach/surface.h>

#include "tests/degrees.h"
#include "tests/refusal.h"

namespace beeline {
namespace {

using testing::deg;

ReachMap map_of_puma() {
  const Arm arm = built_in("puma560");
  const ReachGrid grid(arm, {.resolution = 0.2, .directions = 60 * deg});
  return {{arm, grid}, reach_cells(arm, grid, 0, grid.positions())};
}

TEST(ReachSlice, HasTheBestOfEachPosition) {
  const ReachMap map = map_of_puma();
  const ReachGrid& grid = map.grid();
  const ReachPositions best = reach_positions(grid, map.cells(0, grid.positions()));
  int reached = 0;
  for (int normal = 0; normal < 3; ++normal) {
    const ReachSlice slice = slice_of(map, normal, 0.31, ReachMeasure::margin);
    EXPECT_LE(std::abs(slice.at - 0.31), 0.1 + 1e-12);
    ASSERT_EQ(slice.values.size(),
              grid.axes()[slice.axes[0]].cells * grid.axes()[slice.axes[1]].cells);
    for (Eigen::Index i = 0; i < slice.values.rows(); ++i) {
      for (Eigen::Index j = 0; j < slice.values.cols(); ++j) {
        Vector3 centre;
        centre[normal] = slice.at;
        centre[slice.axes[0]] = slice.grid[0].centre(i);
        centre[slice.axes[1]] = slice.grid[1].centre(j);
        const float expected = best.margin[grid.position_of(centre).value()];
        const float value = slice.values(i, j);
        EXPECT_TRUE(value == expected || (std::isnan(value) && std::isnan(expected)));
        reached += !std::isnan(value);
      }
    }
  }
  EXPECT_GT(reached, 50);
  EXPECT_REFUSED(slice_of(map, 2, 3, ReachMeasure::margin), "z = 3 is outside the map");
}

TEST(VtiFile, HasThePositionsWithXTheFastest) {
  const ReachMap map = map_of_puma();
  const ReachGrid& grid = map.grid();
  const std::string path = ::testing::TempDir() + "/map-" + std::to_string(::getpid()) + ".vti";
  write_vti(map, path);
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  std::filesystem::remove(path);
  const std::string before = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t begin = text.find(before) + before.size();
  std::uint64_t size = 0;
  std::memcpy(&size, text.data() + begin, sizeof size);
  ASSERT_EQ(size, 4 * grid.positions());
  const ReachPositions best = reach_positions(grid, map.cells(0, grid.positions()));
  const Eigen::Index nx = grid.axes()[0].cells, ny = grid.axes()[1].cells;
  for (Eigen::Index z = 0; z < grid.axes()[2].cells; ++z) {
    const Vector3 centre(grid.axes()[0].centre(4), grid.axes()[1].centre(1),
                         grid.axes()[2].centre(z));
    float value = 0;
    std::memcpy(&value, text.data() + begin + sizeof size + 4 * ((z * ny + 1) * nx + 4),
                sizeof value);
    EXPECT_EQ(value, best.directions[grid.position_of(centre).value()]);
  }
}

}  // namespace
}  // namespace beeline
