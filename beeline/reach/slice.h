#pragma once

#include <array>
#include <string>

#include <beeline/error.h>
#include <beeline/reach/reach_map.h>

namespace beeline {

/// What a picture of a map shows of a position: the best of its orientations.
enum class ReachMeasure { directions, branches, manipulability, margin };
std::string name(ReachMeasure measure);

/// The positions of a map in a plane perpendicular to an axis of the world.
struct ReachSlice {
  Arm arm;
  std::string title = arm.name();  ///< in pictures
  ReachMeasure measure = ReachMeasure::directions;
  int normal = 2;             ///< the axis: 0 x, 1 y, 2 z
  double at = 0;              ///< the coordinate of the centres of its cells, m
  std::array<int, 2> axes{};  ///< the two others
  std::array<ReachAxis, 2> grid{};
  Eigen::MatrixXf values{};  ///< (cells of axes[0], cells of axes[1]); NaN: not reached
};

/// Reads the cells around the coordinate `at` (m) of an axis; of a cylindrical map, those that
/// contain the centres of ReachGrid::cartesian_axes(). Directions are their fraction that is
/// reached. Throws Error for a coordinate outside the map and for an incomplete map.
ReachSlice slice_of(const ReachMap& map, int normal, double at,
                    ReachMeasure measure = ReachMeasure::directions);

}  // namespace beeline
