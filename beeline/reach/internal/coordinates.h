#pragma once

#include <vector>

#include <beeline/reach/grid.h>

namespace beeline::internal {

/// The coordinates of the cells along an axis of a map, as files have them: m and rad.
struct Coordinates {
  const char* name;
  std::vector<double> values;
  Eigen::Index columns = 1;  ///< numbers of each; 3 of directions
};

/// Those of the positions, then of directions and their fractions, headings and rolls where the
/// grid has them.
std::vector<Coordinates> coordinates_of(const ReachGrid& grid);

}  // namespace beeline::internal
