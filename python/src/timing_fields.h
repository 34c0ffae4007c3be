#pragma once

#include <beeline/timing/point_to_point.h>
#include <beeline/timing/retime.h>

#include "arm_fields.h"
#include "joint_path_fields.h"
#include "reason.h"
#include "trajectory_fields.h"

namespace beeline::python {

template <>
struct Fields<SCurve>
    : Members<&SCurve::distance, &SCurve::duration, &SCurve::jerk_time, &SCurve::acceleration_time,
              &SCurve::cruise_time, &SCurve::velocity, &SCurve::acceleration, &SCurve::jerk> {};

template <>
struct Fields<JointState> : Members<&JointState::position, &JointState::velocity,
                                    &JointState::acceleration, &JointState::jerk> {};

template <>
struct Fields<PointToPoint> : Members<&PointToPoint::from, &PointToPoint::to, &PointToPoint::curves,
                                      &PointToPoint::duration> {
  static void check(const PointToPoint& motion);
};

template <>
struct Fields<PointToPointOptions>
    : Members<&PointToPointOptions::synchronise, &PointToPointOptions::from_outside> {};

template <>
struct Fields<PathLimits> : Members<&PathLimits::velocity, &PathLimits::acceleration,
                                    &PathLimits::jerk, &PathLimits::speed, &PathLimits::fraction> {
  static constexpr std::size_t required = 3;
};

template <>
struct Fields<TimeScaling>
    : Members<&TimeScaling::reason, &TimeScaling::s, &TimeScaling::t, &TimeScaling::speed,
              &TimeScaling::acceleration, &TimeScaling::smooth> {};

template <>
struct Fields<RetimeOptions>
    : Members<&RetimeOptions::profile, &RetimeOptions::interpolation, &RetimeOptions::joint_blend,
              &RetimeOptions::speed_scale, &RetimeOptions::tool_speed, &RetimeOptions::rate,
              &RetimeOptions::duration, &RetimeOptions::max_samples, &RetimeOptions::no_unwrap,
              &RetimeOptions::recover, &RetimeOptions::budget> {};

template <>
struct Fields<Retimed>
    : Members<&Retimed::profile, &Retimed::reason, &Retimed::trajectory, &Retimed::limits,
              &Retimed::tool_speed, &Retimed::sections, &Retimed::blends, &Retimed::unwrapped,
              &Retimed::recovery, &Retimed::ending> {};

}  // namespace beeline::python
