#pragma once

#include <beeline/reach/surface.h>

#include "record.h"

namespace beeline::python {

template <>
struct Fields<ReachSide>
    : Members<&ReachSide::volume, &ReachSide::volume_only_here, &ReachSide::volume_more_directions,
              &ReachSide::directions, &ReachSide::manipulability, &ReachSide::margin> {};

template <>
struct Fields<ReachComparison>
    : Members<&ReachComparison::sides, &ReachComparison::both, &ReachComparison::step> {};

}  // namespace beeline::python
