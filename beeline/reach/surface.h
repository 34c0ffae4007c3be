#pragma once

#include <Eigen/Core>
#include <vector>

#include <beeline/error.h>
#include <beeline/reach/grid.h>

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
/// and one without a value. Each edge belongs to two triangles, in opposite directions. Where two
/// diagonally opposite corners of a face are above the level, they are apart. Without a value above
/// the level there are no vertices.
///
/// Throws Error for another number of values, a level that is NaN, and fewer than three azimuths of
/// a cylindrical grid.
ReachSurface reach_surface(const ReachGrid& grid, const std::vector<float>& values, double level);

}  // namespace beeline
