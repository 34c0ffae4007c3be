#include <beeline/reach/internal/coordinates.h>

namespace beeline::internal {
namespace {

/// value(0) to value(count - 1).
std::vector<double> values(Eigen::Index count, const auto& value) {
  std::vector<double> all;
  for (Eigen::Index i = 0; i < count; ++i) all.push_back(value(i));
  return all;
}

std::vector<double> centres_of(const ReachAxis& axis) {
  return values(axis.cells, [&](Eigen::Index i) { return axis.centre(i); });
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
    all.push_back(
        {"headings", values(grid.directions(), [&](Eigen::Index d) { return grid.heading(d); })});
  }
  if (orientations == ReachOrientations::rolls) {
    all.push_back({"rolls", values(grid.rolls(), [&](Eigen::Index r) { return grid.roll(r); })});
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
