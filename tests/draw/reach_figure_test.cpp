#include <array>
#include <gtest/gtest.h>
#include <string>

#include <beeline/draw/figure.h>
#include <beeline/draw/timing_figure.h>
#include <beeline/model/catalog.h>
#include <beeline/reach/surface.h>

#include "tests/degrees.h"
#include "tests/refusal.h"

namespace beeline {
namespace {

using testing::deg;

ReachMap map_of(const char* name, const ReachGridOptions& options) {
  const Arm arm = built_in(name);
  const ReachGrid grid(arm, options);
  return {{arm, grid}, reach_cells(arm, grid, 0, grid.positions())};
}

TEST(ReachFigure, HasTheArmAndAScale) {
  const ReachMap map = map_of("puma560", {.resolution = 0.2, .directions = 60 * deg});
  for (const ReachMeasure measure : {ReachMeasure::directions, ReachMeasure::branches}) {
    const Figure figure = reach_figure(slice_of(map, 2, 0.2, measure));
    const std::string svg = render(figure, Format::svg);
    EXPECT_NE(svg.find("puma560"), std::string::npos);
    EXPECT_NE(svg.find("z = 0.2 m"), std::string::npos);
    std::size_t tiles = 0;
    for (const Item& item : figure.columns[0][0].drawing.items) {
      if (const auto* of_shade = std::get_if<Tiles>(&item.shape)) tiles += of_shade->tiles.size();
    }
    EXPECT_GT(tiles, 5);
  }
}

TEST(ReachFigure, RefusesSlicesThatDiffer) {
  const ReachMap map = map_of("ur5", {.resolution = 0.4});
  const auto figure = [&](double at, ReachMeasure measure) {
    return reach_figure(std::array{slice_of(map, 2, 0), slice_of(map, 2, at, measure)});
  };
  EXPECT_EQ(figure(0, ReachMeasure::directions).columns.size(), 3u);
  EXPECT_REFUSED(figure(0.4, ReachMeasure::directions), "z = 0.4 m");
  EXPECT_REFUSED(figure(0, ReachMeasure::margin), "largest margin");
}

}  // namespace
}  // namespace beeline
