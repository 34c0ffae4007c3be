#pragma once

#include <beeline/timing/point_to_point.h>

namespace beeline::internal {

/// point_to_point() from a start that may be anywhere outside the position limits.
PointToPoint motion_from_outside(const Arm& arm, const ConfigurationRef& from,
                                 const ConfigurationRef& to, Synchronise synchronise);

}  // namespace beeline::internal
