#pragma once

#include <cstdint>
#include <vector>

#include <beeline/planning/internal/free_edges.h>

namespace beeline::internal {

/// Shortens a path of straight joint motions that are proved: leaves out waypoints, then tries
/// straight motions between random places of the path, `shortcuts` times. Its ends remain, and each
/// of its motions is proved.
void shorten(FreeEdges& edges, std::uint64_t random_seed, int shortcuts,
             std::vector<Configuration>& waypoints);

}  // namespace beeline::internal
