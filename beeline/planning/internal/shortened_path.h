#pragma once

#include <cstdint>
#include <vector>

#include <beeline/planning/internal/free_edges.h>

namespace beeline::internal {

/// Which straight joint motions are used: those without a blocked sample, or those proved.
enum class EdgeTest { samples, proof };

/// Shortens a path of straight joint motions: leaves out waypoints, then tries straight motions
/// between random places of the path, `shortcuts` times. Its ends remain, and each of its motions
/// passes the test if each of the given path does.
void shorten(FreeEdges& edges, EdgeTest test, std::uint64_t random_seed, int shortcuts,
             std::vector<Configuration>& waypoints);

}  // namespace beeline::internal
