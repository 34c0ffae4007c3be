#pragma once

#include <beeline/reach/reach_map.h>

#include "command/verb.h"

namespace beeline::command {

/// MAP, a file of `reach map`.
Positional map_argument(std::string* target);

/// What a map is of, and how many of its cells are reached.
Answer map_totals(const ReachMap& map);

/// The answer where the computation of the map `out` ended before it was complete.
Answer interrupted_map(const std::string& out, Ending ending);

}  // namespace beeline::command
