#pragma once

/// The C interface of reachability and manipulability maps, in the module of the command, together
/// with memory.h. Radians and metres.

extern "C" {

/// Returns the handle of a map, which is not computed yet, of an arm in the text of `beeline show
/// --out`. `resolution`: the edge of the cells. `orientation`: the one of the tool, 9 numbers by
/// columns; or null for tool directions, or headings of a planar arm, `directions` apart. `rolls`:
/// the angle between rolls about the direction for an arm whose last joint does not rotate the tool
/// about its z axis; with another arm any roll will do. An arm that has no map is refused.
int beeline_reach(const char* arm, double resolution, double directions, double rolls,
                  const double* orientation);
/// Writes the cells, the lower end and the edge of the cells along x, y and z, and the numbers of
/// directions (or headings) and of rolls at each position: 11 numbers.
int beeline_reach_grid(int map, double* numbers);
/// Writes the orientations at each position, the roll fastest, 9 numbers by columns each.
int beeline_reach_orientations(int map, double* numbers);
/// Computes the map and returns how many of its cells are reached. Calls the module's function
/// `progress` with the fraction computed, now and then.
int beeline_reach_compute(int map);
/// Returns a measure of the positions (ix ny + iy) nz + iz of a map that is computed, NaN where
/// none is reached: 0 the fraction of directions, 1 branches, 2 manipulability, 3 margin. Or null.
const float* beeline_reach_values(int map, int measure);

/// Computes the isosurface of `count` values, one for each position (reach_surface()), and returns
/// the number of its triangles. Its arrays are valid until the next one.
int beeline_reach_surface(int map, const float* values, int count, double level);
/// Returns the number of its vertices.
int beeline_reach_vertex_count(int map);
/// Returns the coordinates, 3 for each vertex, or null.
const float* beeline_reach_vertices(int map);
/// Returns the vertices of the triangles, 3 for each, or null.
const int* beeline_reach_triangles(int map);

int beeline_reach_release(int map);
}
