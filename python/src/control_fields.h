#pragma once

#include <beeline/control/cartesian.h>
#include <beeline/control/joint.h>
#include <beeline/control/replay.h>

#include "planning_fields.h"

namespace beeline::python {

template <>
struct Fields<PidGains> : Members<&PidGains::kp, &PidGains::ki, &PidGains::kd> {};

template <>
inline constexpr bool reports<SimulationOptions> = false;
template <>
struct Fields<SimulationOptions>
    : Members<&SimulationOptions::tolerance, &SimulationOptions::max_steps,
              &SimulationOptions::time_step, &SimulationOptions::budget> {};

/// Those besides CartesianOptions::simulation, whose members are keywords too.
template <>
struct Fields<CartesianOptions>
    : Members<&CartesianOptions::method, &CartesianOptions::task, &CartesianOptions::gain,
              &CartesianOptions::intermediate> {};

template <>
inline constexpr bool reports<JointMoveOptions> = false;
template <>
struct Fields<JointMoveOptions>
    : Members<&JointMoveOptions::synchronise, &JointMoveOptions::rate, &JointMoveOptions::duration,
              &JointMoveOptions::recover, &JointMoveOptions::budget> {};

template <>
struct Fields<StartJump>
    : Members<&StartJump::velocity, &StartJump::fraction, &StartJump::joint, &StartJump::assumed> {
};

template <>
struct Fields<ControlledMotion>
    : Members<&ControlledMotion::status, &ControlledMotion::reason, &ControlledMotion::trajectory,
              &ControlledMotion::arrivals, &ControlledMotion::steps, &ControlledMotion::slowed,
              &ControlledMotion::overshoot, &ControlledMotion::error, &ControlledMotion::limits,
              &ControlledMotion::start_jump, &ControlledMotion::recovery> {};

template <>
struct Fields<SpeedChange> : Members<&SpeedChange::time, &SpeedChange::speed> {
  static constexpr std::size_t required = 2;
  static constexpr bool as_tuple = true;
};

template <>
inline constexpr bool reports<ReplayOptions> = false;
template <>
struct Fields<ReplayOptions>
    : Members<&ReplayOptions::rate, &ReplayOptions::speed, &ReplayOptions::start,
              &ReplayOptions::speed_at, &ReplayOptions::ramp, &ReplayOptions::no_unwrap,
              &ReplayOptions::limit_tolerance, &ReplayOptions::budget> {};

template <>
struct Fields<Replay>
    : Members<&Replay::status, &Replay::reason, &Replay::trajectory, &Replay::lead_in,
              &Replay::slowdown, &Replay::limits, &Replay::unwrapped> {};

}  // namespace beeline::python
