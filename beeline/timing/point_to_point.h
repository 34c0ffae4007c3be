#pragma once

#include <span>
#include <vector>

#include <beeline/timing/s_curve.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// What the joints that could be quicker do, so that all begin and end together.
enum class Synchronise {
  time,      ///< each follows its own curve, stretched to the slowest joint's duration
  straight,  ///< all follow one curve, in proportion: a straight line in joint space
};

struct PointToPointOptions {
  Synchronise synchronise = Synchronise::time;
};

/// A motion of all joints from rest to rest, each with a curve from s_curve.h.
struct PointToPoint {
  Configuration from;  ///< radians, metres
  Configuration to;
  std::vector<SCurve> curves;  ///< one for each coordinate, all of the same duration
  double duration = 0;         ///< seconds
};

/// The quickest motion that keeps the limits on velocity, acceleration and jerk. For `time` it
/// lasts as long as the slowest joint needs alone; for `straight` at least as long, as each joint's
/// limits bind them all. A velocity without limit is held to `velocity_when_unknown`; acceleration
/// and jerk without limit are free.
/// Throws Error when a configuration does not fit the arm or is outside its limits, and where
/// s_curve() does.
PointToPoint point_to_point(const Arm& arm, const ConfigurationRef& from,
                            const ConfigurationRef& to, const PointToPointOptions& options = {});

/// The same into the caller's motion, without allocating when that has had as many joints before.
void point_to_point(const Arm& arm, const ConfigurationRef& from, const ConfigurationRef& to,
                    PointToPoint& motion, const PointToPointOptions& options = {});

/// The same for joints with these limits, one for each number of `from` and `to`.
void point_to_point(std::span<const Limits> limits, const ConfigurationRef& from,
                    const ConfigurationRef& to, PointToPoint& motion,
                    const PointToPointOptions& options = {});

/// The state at time t, into buffers with a place for each joint, without allocating: exactly
/// `from` until 0, and `to` from the duration on. Throws Error when t is no number or a buffer does
/// not fit.
void at(const PointToPoint& motion, double t, Eigen::Ref<Configuration> q,
        Eigen::Ref<Configuration> velocity, Eigen::Ref<Configuration> acceleration);

/// The motion at `rate` samples a second and at its end, which is exactly `to`; one sample where
/// nothing moves. Throws Error when the rate is not above zero, the motion does not fit the arm, or
/// there would be more than ten million samples.
Trajectory sampled(const Arm& arm, const PointToPoint& motion, double rate);

}  // namespace beeline
