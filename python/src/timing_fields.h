#pragma once

#include <beeline/timing/point_to_point.h>
#include <beeline/timing/retime.h>

#include "arm_fields.h"
#include "joint_path_fields.h"
#include "reason.h"
#include "trajectory_fields.h"

namespace beeline::python {

template <>
inline std::vector<Profile> choices() {
  return {Profile::fastest, Profile::jerk, Profile::trapezoidal, Profile::quintic,
          Profile::s_curve};
}

template <>
inline std::vector<Synchronise> choices() {
  return {Synchronise::time, Synchronise::straight};
}
template <>
inline std::string spelling(Synchronise synchronise) {
  return synchronise == Synchronise::time ? "time" : "straight";
}

template <>
struct Fields<SCurve> {
  static constexpr const char* name = "SCurve";
  static constexpr const char* doc =
      "The minimum-time motion of one joint from rest to rest under limits on velocity, "
      "acceleration and jerk (Biagiotti and Melchiorri, *Trajectory Planning for Automatic "
      "Machines "
      "and Robots*, section 3.4): seven phases of constant jerk.";
  static constexpr auto all() {
    return std::tuple(
        field("distance", &SCurve::distance, "rad or m, of either sign."),
        field("duration", &SCurve::duration, "s."),
        field("jerk_time", &SCurve::jerk_time, "Of each of the four phases of constant jerk, s."),
        field("acceleration_time", &SCurve::acceleration_time,
              "Of each of the two phases of constant acceleration, s."),
        field("cruise_time", &SCurve::cruise_time, "At constant velocity, s."),
        field("velocity", &SCurve::velocity, "The largest that is reached, signed."),
        field("acceleration", &SCurve::acceleration,
              "The largest that is reached; inf where the velocity jumps."),
        field("jerk", &SCurve::jerk,
              "The largest that is reached; inf where the acceleration jumps."));
  }
};

template <>
struct Fields<JointState> {
  static constexpr const char* name = "JointState";
  static constexpr const char* doc = "The state of a joint along its motion.";
  static constexpr auto all() {
    return std::tuple(field("position", &JointState::position, "Relative to the start, rad or m."),
                      field("velocity", &JointState::velocity, "Per second."),
                      field("acceleration", &JointState::acceleration, "Per second squared."),
                      field("jerk", &JointState::jerk, "Per second cubed."));
  }
};

template <>
struct Fields<PointToPoint> {
  static constexpr const char* name = "PointToPoint";
  static constexpr const char* doc =
      "A motion of all joints from rest to rest, each along an s-curve.";
  static constexpr auto all() {
    return std::tuple(field("from_", &PointToPoint::from, "Configuration (n,)."),
                      field("to", &PointToPoint::to, "Configuration (n,)."),
                      field("curves", &PointToPoint::curves,
                            "One for each coordinate, all of the same duration."),
                      field("duration", &PointToPoint::duration, "s."));
  }
  static void check(const PointToPoint& motion);
};

template <>
struct Fields<PathLimits> {
  static constexpr const char* name = "PathLimits";
  static constexpr const char* doc =
      "The limits of a motion along a path in joint space; inf: no limit.";
  static constexpr std::size_t required = 3;
  static constexpr auto all() {
    return std::tuple(
        field("velocity", &PathLimits::velocity, "rad/s or m/s, (n,)."),
        field("acceleration", &PathLimits::acceleration, "rad/s^2 or m/s^2, (n,)."),
        field("jerk", &PathLimits::jerk, "rad/s^3 or m/s^3, (n,)."),
        field("speed", &PathLimits::speed,
              "The largest ds/dt at each grid point of the path; empty: no such limit."),
        field("fraction", &PathLimits::fraction,
              "The fraction of the limits of acceleration and jerk that may be used at each grid "
              "point, above 0 to 1; empty: all of them."));
  }
};

template <>
struct Fields<TimeScaling> {
  static constexpr const char* name = "TimeScaling";
  static constexpr const char* doc =
      "A time scaling s(t) of a path: the path parameter as a function of time.";
  static constexpr const char* truth = "True if there is a time scaling.";
  static constexpr auto all() {
    return std::tuple(
        field("reason", &TimeScaling::reason, "Why there is no time scaling; otherwise empty."),
        field("s", &TimeScaling::s, "Path parameter, strictly increasing, (N,)."),
        field("t", &TimeScaling::t, "Seconds, strictly increasing from 0, (N,)."),
        field("speed", &TimeScaling::speed, "ds/dt, (N,)."),
        field("acceleration", &TimeScaling::acceleration,
              "d2s/dt2, (N,); the mean of both sides where it jumps."),
        field("smooth", &TimeScaling::smooth,
              "Whether d2s/dt2 is continuous: then s(t) is the quintic Hermite polynomial between "
              "points; else d2s/dt2 is constant there."));
  }
};

template <>
struct Fields<RetimeOptions> {
  static constexpr const char* name = "RetimeOptions";
  static constexpr auto all() {
    return std::tuple(
        field(
            "profile", &RetimeOptions::profile,
            "Form of the time scaling: minimum time under limits of velocity and acceleration "
            "(`fastest`), of jerk too (`jerk`), or a fixed form. Every profile keeps "
            "known jerk limits; `fastest` and `trapezoidal` leave jerk free where it is not known. "
            "None: `jerk`."),
        field("interpolation", &RetimeOptions::interpolation, "Of the result."),
        field("speed_scale", &RetimeOptions::speed_scale,
              "k from 1e-6 to 1: velocity limits are multiplied by k, acceleration by k^2, jerk by "
              "k^3."),
        field("tool_speed", &RetimeOptions::tool_speed,
              "Limit of the tool origin's speed, m/s, 1e-8 or more."),
        field("rate", &RetimeOptions::rate,
              "Samples per second; 0: every sample of the path, and as many more as the "
              "interpolation needs."),
        field("duration", &RetimeOptions::duration,
              "Seconds to which the quickest motion is slowed down, without a rate; None: the "
              "shortest."),
        field("max_samples", &RetimeOptions::max_samples,
              "With a rate, 2 or more: there is no motion if it makes more."),
        field("no_unwrap", &RetimeOptions::no_unwrap,
              "Keep the jumps of continuous joints whose values wrap."),
        field("budget", &RetimeOptions::budget, ""));
  }
};

template <>
struct Fields<Retimed> {
  static constexpr const char* name = "Retimed";
  static constexpr const char* doc = "A trajectory with new times. False if there is none.";
  static constexpr const char* truth = "True if there is a motion, and the best.";
  static constexpr auto all() {
    return std::tuple(
        field("profile", &Retimed::profile, "Of the time scaling."),
        field("reason", &Retimed::reason, "Why there is no motion, or not the best."),
        field("trajectory", &Retimed::trajectory, "Empty when there is none."),
        field("limits", &Retimed::limits, "Of the trajectory, relative to the arm's limits."),
        field("tool_speed", &Retimed::tool_speed, "A bound on the tool origin's speed, m/s."),
        field("sections", &Retimed::sections, "Number of sections of the path between stops."),
        field("unwrapped", &Retimed::unwrapped,
              "Joints of the given trajectory that were unwrapped."),
        field("ending", &Retimed::ending,
              "Unless `complete`, the trajectory is that of the sections so far, up to a stop."));
  }
};

}  // namespace beeline::python
