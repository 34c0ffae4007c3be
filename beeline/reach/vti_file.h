#pragma once

#include <string>

#include <beeline/error.h>
#include <beeline/reach/reach_map.h>

namespace beeline {

/// Writes the positions of a map as an image of VTK, which ParaView opens: the cell data
/// `directions` (the fraction that is reached), `branches`, `manipulability` and `margin`, each the
/// best of the orientations at a position; the last two are NaN where none is reached. The image of
/// a cylindrical map has the cells of ReachGrid::cartesian_axes(). Throws Error for more than 1e9
/// cells, FileError for a file that cannot be written, and for an incomplete map.
void write_vti(const ReachMap& map, const std::string& path);

}  // namespace beeline
