#pragma once

#include <beeline/reach/reach_map.h>

#include "command/verb.h"

/// What a map is of, and how many of its cells are reached.
Answer map_totals(const beeline::ReachMap& map);
