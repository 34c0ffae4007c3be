#pragma once

#include <beeline/reach/surface.h>

#include "record.h"

namespace beeline::python {

template <>
struct Fields<ReachSide>
    : Members<&ReachSide::volume, &ReachSide::alone, &ReachSide::better, &ReachSide::directions,
              &ReachSide::manipulability, &ReachSide::margin> {};

template <>
struct Fields<ReachComparison>
    : Members<&ReachComparison::sides, &ReachComparison::both, &ReachComparison::step> {};

}  // namespace beeline::python
