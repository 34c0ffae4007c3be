#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include <beeline/error.h>
#include <beeline/reach/grid.h>
#include <beeline/reach/reach_map.h>

namespace beeline {

/// A closed triangle mesh.
struct ReachSurface {
  Eigen::Matrix3Xf vertices;   ///< m, in the world
  Eigen::Matrix3Xi triangles;  ///< indices of vertices, counterclockwise seen from outside
};

/// Computes the isosurface that separates the positions whose value is `level` or more from the
/// others: marching cubes (Lorensen & Cline, SIGGRAPH 1987) between the centres of the cells, their
/// polygons traced around the faces of a cube (Bloomenthal, Graphics Gems IV, 1994), each with a
/// vertex in its middle. `values` has one for each position of the grid, as in ReachPositions.
///
/// Between two centres the values are linear in the coordinates of the grid. NaN counts as below
/// the level, and so does everything outside the grid: the surface is midway between a centre above
/// and one without a value. Each edge belongs to two triangles, in opposite directions. If only two
/// diagonally opposite corners of a face are above the level, the surface separates them. Without a
/// value above the level there are no vertices.
///
/// Throws Error for another number of values, a level that is NaN, and fewer than three azimuths of
/// a cylindrical grid.
ReachSurface reach_surface(const ReachGrid& grid, const std::vector<float>& values, double level);

/// The measure that a picture shows at each position of a map, the best of its orientations.
enum class ReachMeasure { directions, branches, manipulability, margin };
std::string name(ReachMeasure measure);

/// The positions of a map in a plane perpendicular to an axis of the world.
struct ReachSlice {
  Arm arm;                         ///< the arm of the map
  std::string title = arm.name();  ///< title in pictures
  /// Measure that the values have, the best of all orientations.
  ReachMeasure measure = ReachMeasure::directions;
  int normal = 2;                   ///< axis perpendicular to the plane: 0 x, 1 y, 2 z
  double at = 0;                    ///< coordinate of the cells' centres along this axis, m
  std::array<int, 2> axes{};        ///< the two other axes
  std::array<ReachAxis, 2> grid{};  ///< cells along `axes`
  Eigen::MatrixXf values{};         ///< (cells of axes[0], cells of axes[1]); NaN: not reached
};

/// Reads the cells around the coordinate `at` (m) of an axis. For a cylindrical map, reads the
/// cells that contain the centres of ReachGrid::cartesian_axes(). The measure `directions` is the
/// fraction of the directions that are reached. Throws Error for a coordinate outside the map and
/// for an incomplete map.
ReachSlice slice_of(const ReachMap& map, int normal, double at,
                    ReachMeasure measure = ReachMeasure::directions);

/// Writes the positions of a map as an image of VTK, which ParaView opens: the cell data
/// `directions` (the fraction that is reached), `branches`, `manipulability` and `margin`, each the
/// best of the orientations at a position; the last two are NaN where none is reached. The image of
/// a cylindrical map has the cells of ReachGrid::cartesian_axes(). Throws Error for more than 1e9
/// cells, FileError for a file that cannot be written, and for an incomplete map.
void write_vti(const ReachMap& map, const std::string& path);

/// Measures of one of two maps, at the points where they are compared. Volumes are areas, m^2, if
/// both arms are planar.
struct ReachSide {
  double volume = 0;            ///< volume reached in some orientation, m^3
  double volume_only_here = 0;  ///< volume that the other map does not reach, m^3
  /// Volume of the points with a larger fraction of directions reached than on the other map, m^3.
  double volume_more_directions = 0;
  /// Mean fraction of directions reached, over the points that either map reaches.
  double directions = 0;
  /// Mean of the largest manipulability at each point, over the points that both maps reach; NaN if
  /// there are none.
  double manipulability = 0;
  /// Mean of the largest margin to the joint limits at each point, over the points that both maps
  /// reach; NaN if there are none.
  double margin = 0;
};

/// Comparison of two maps.
struct ReachComparison {
  std::array<ReachSide, 2> sides;  ///< measures of the first map and of the second
  double both = 0;                 ///< volume that both maps reach, m^3
  double step = 0;                 ///< distance between the compared points, m
};

/// Compares two maps, of two arms, mounts or tools, in the same world: at the centres of cells
/// along x, y and z that cover both, each map with the position that contains the point. Maps of
/// the same box are compared cell by cell. Fractions of directions are comparable between maps with
/// the same kind of orientations. Throws Error for maps with different kinds of orientations
/// (headings, directions, one orientation), for a map by sampling with one by inverse kinematics,
/// for an incomplete map, and for more than 1e8 points.
ReachComparison compare_reach(const ReachMap& first, const ReachMap& second);

/// The slices of both maps at the same cells, as slice_of() reads them.
std::array<ReachSlice, 2> slices_of(const ReachMap& first, const ReachMap& second, int normal,
                                    double at, ReachMeasure measure = ReachMeasure::directions);

}  // namespace beeline
