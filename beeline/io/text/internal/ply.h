#pragma once

#include <vector>

#include <beeline/io/text/internal/byte_blocks.h>
#include <beeline/pose/so3.h>

namespace beeline::internal {

/// Reads the points of a PLY file: the properties x, y and z, float or double, of its element
/// vertex; ASCII or binary, of either byte order. Other properties, and elements in front of
/// vertex, are skipped; elements behind it are not read. The bytes of the coordinates may be
/// any number. Throws FileError for anything else, more than max_cloud_points, a file that is cut
/// off, and one that continues where the header ends it.
std::vector<Vector3> points_from_ply(ByteBlocks& bytes);

}  // namespace beeline::internal
