#include <numbers>

#include <beeline/reach/internal/coordinates.h>

namespace beeline::internal {
namespace {

std::vector<double> equal_angles(Eigen::Index count) {
  std::vector<double> angles;
  for (Eigen::Index i = 0; i < count; ++i) {
    angles.push_back(2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count));
  }
  return angles;
}

std::vector<double> centres_of(const ReachAxis& axis) {
  std::vector<double> centres;
  for (Eigen::Index i = 0; i < axis.cells; ++i) centres.push_back(axis.centre(i));
  return centres;
}

}  // namespace

std::vector<Coordinates> coordinates_of(const ReachGrid& grid) {
  const auto& axes = grid.axes();
  std::vector<Coordinates> all;
  if (grid.cylindrical()) {
    all = {{"radius", centres_of(axes[0])},
           {"height", centres_of(axes[1])},
           {"azimuth", centres_of(axes[2])}};
  } else {
    all = {{"x", centres_of(axes[0])}, {"y", centres_of(axes[1])}, {"z", centres_of(axes[2])}};
  }
  const ReachOrientations orientations = grid.orientations();
  if (orientations == ReachOrientations::headings) {
    all.push_back({"headings", equal_angles(grid.directions())});
  }
  if (orientations == ReachOrientations::rolls) {
    all.push_back({"rolls", equal_angles(grid.rolls())});
  }
  if (orientations == ReachOrientations::rolls || orientations == ReachOrientations::directions) {
    Coordinates directions{.name = "directions", .values = {}, .columns = 3};
    Coordinates fractions{.name = "fractions", .values = {}};
    for (Eigen::Index d = 0; d < grid.directions(); ++d) {
      for (const double c : grid.direction_grid().direction(d)) directions.values.push_back(c);
      fractions.values.push_back(grid.fraction(d));
    }
    all.push_back(std::move(directions));
    all.push_back(std::move(fractions));
  }
  return all;
}

}  // namespace beeline::internal
