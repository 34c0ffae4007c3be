#pragma once

#include <beeline/planning/free_path.h>

#include "collision_fields.h"
#include "planning_fields.h"

namespace beeline::python {

template <>
inline constexpr bool reports<FreePathOptions> = false;
template <>
struct Fields<FreePathOptions> : Members<&FreePathOptions::random_seed, &FreePathOptions::max_edges,
                                         &FreePathOptions::shortcuts, &FreePathOptions::budget> {};

template <>
struct Fields<FreePath> : Members<&FreePath::status, &FreePath::reason, &FreePath::waypoints,
                                  &FreePath::goal, &FreePath::length, &FreePath::edges> {};

template <>
inline constexpr bool reports<FreeMotionOptions> = false;
template <>
struct Fields<FreeMotionOptions>
    : Members<&FreeMotionOptions::random_seed, &FreeMotionOptions::max_edges,
              &FreeMotionOptions::shortcuts, &FreeMotionOptions::joint_blend,
              &FreeMotionOptions::profile, &FreeMotionOptions::interpolation,
              &FreeMotionOptions::speed_scale, &FreeMotionOptions::tool_speed,
              &FreeMotionOptions::rate, &FreeMotionOptions::duration,
              &FreeMotionOptions::max_samples, &FreeMotionOptions::recover_clearance,
              &FreeMotionOptions::budget> {};

template <>
struct Fields<FreeMotion>
    : Members<&FreeMotion::status, &FreeMotion::reason, &FreeMotion::trajectory, &FreeMotion::path,
              &FreeMotion::blends, &FreeMotion::clearance, &FreeMotion::limits> {};

}  // namespace beeline::python
