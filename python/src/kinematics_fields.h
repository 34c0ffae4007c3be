#pragma once

#include <beeline/batch/batch.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/kinematics/task.h>

#include "reason.h"
#include "record.h"

namespace beeline::python {

/// As frame_named(), which says what the names mean.
template <>
inline Error unknown_choice<Frame>(const char* /*argument*/, const std::string& name) {
  frame_named(name);  // throws
  return unknown_name("frame", name, {});
}

template <>
struct Fields<Deviation> : Members<&Deviation::position, &Deviation::orientation> {
  static constexpr std::size_t required = 2;
  static constexpr bool as_tuple = true;
};

template <>
struct Fields<BatchOptions> : Members<&BatchOptions::threads> {};

template <>
struct Fields<JointRatesOptions>
    : Members<&JointRatesOptions::task, &JointRatesOptions::frame, &JointRatesOptions::damping> {};

template <>
struct Fields<RateExcess>
    : Members<&RateExcess::coordinate, &RateExcess::rate, &RateExcess::limit> {};

template <>
struct Fields<JointRates>
    : Members<&JointRates::status, &JointRates::rates, &JointRates::tool_velocity,
              &JointRates::residual, &JointRates::singular, &JointRates::lost_directions,
              &JointRates::excesses, &JointRates::without_limit, &JointRates::scale,
              &JointRates::reason> {};

template <>
struct Fields<ManipulabilityMeasures>
    : Members<&ManipulabilityMeasures::singular_values, &ManipulabilityMeasures::manipulability,
              &ManipulabilityMeasures::condition> {};

template <>
struct Fields<ManipulabilityEllipsoids>
    : Members<&ManipulabilityEllipsoids::axes, &ManipulabilityEllipsoids::velocity,
              &ManipulabilityEllipsoids::force> {};

template <>
struct Fields<ManipulabilityGradient>
    : Members<&ManipulabilityGradient::manipulability, &ManipulabilityGradient::gradient> {};

}  // namespace beeline::python
