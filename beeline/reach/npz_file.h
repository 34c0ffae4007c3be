#pragma once

#include <string>

#include <beeline/error.h>
#include <beeline/reach/reach_map.h>

namespace beeline {

/// Writes all cells of a map as numpy's .npz, which numpy.load() reads: the arrays `branches` (or
/// `samples`), `manipulability` and `margin`, one value for each cell, with the axes x, y, z (or
/// radius, height, azimuth), direction and roll, those left out of which the grid has one; `x`,
/// `y`, `z` (or `radius`, `height`, `azimuth`) the coordinates of the centres, m and rad;
/// `directions` (unit vectors), `fractions` of the sphere, `headings` and `rolls` (rad) where the
/// grid has them; `arm` its JSON. Of a cylindrical map all azimuths are written. Throws FileError
/// for a file that cannot be written, and for an incomplete map.
void write_npz(const ReachMap& map, const std::string& path);

}  // namespace beeline
