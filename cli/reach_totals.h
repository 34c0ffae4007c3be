#pragma once

#include <beeline/reach/reach_map.h>

#include "command/verb.h"

namespace beeline::command {

/// MAP, a file of `reach map`.
Positional map_argument(std::string* target);

/// The scene in which a map's solutions are free: "cell.json, 0.001 m are required".
std::string scene_name(const ReachScene& scene);
/// The same in JSON; null: all solutions count.
Json scene_document(const ReachMap& map);

/// What a map is of, and how many of its cells are reached.
Answer map_totals(const ReachMap& map);

/// The answer where the computation of the map `out` ended before it was complete.
Answer interrupted_map(const std::string& out, Ending ending);

}  // namespace beeline::command
