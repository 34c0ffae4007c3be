#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/timing/internal/from_outside.h>
#include <beeline/timing/internal/s_curve_state.h>
#include <beeline/timing/internal/uniform_section.h>
#include <beeline/timing/point_to_point.h>
#include <beeline/trajectory/internal/append.h>
#include <beeline/trajectory/internal/limit_fraction.h>
#include <beeline/trajectory/internal/motion_start.h>
#include <beeline/trajectory/internal/recovery.h>
#include <beeline/trajectory/internal/sample_rate.h>
#include <beeline/trajectory/limit_usage.h>

namespace beeline {
namespace {

constexpr double max_samples = 1e7;  // some 3 GB for seven joints

void check_limits(std::span<const Limits> limits) {
  for (std::size_t k = 0; k < limits.size(); ++k) {
    for (const double rate : {limits[k].velocity, limits[k].acceleration, limits[k].jerk}) {
      if (rate > 0) continue;
      throw Error("joint " + std::to_string(k + 1) +
                  " has a velocity, acceleration or jerk limit of " + number(rate) +
                  "; it must be above zero, or infinite if there is no limit");
    }
  }
}

void check_within(std::span<const Limits> limits, const ConfigurationRef& q, const char* which) {
  if (q.size() != static_cast<Eigen::Index>(limits.size())) {
    throw Error(which + (" of a motion of " + std::to_string(limits.size()) +
                         " joints needs as many values, not " + std::to_string(q.size())));
  }
  for (Eigen::Index k = 0; k < q.size(); ++k) {
    const Limits& limit = limits[k];
    if (within_position_limits(limit, q[k])) continue;
    throw Error(which + (": joint " + std::to_string(k + 1)) + " at " + number(q[k]) +
                " is outside its limits " + number(limit.lower) + " to " + number(limit.upper));
  }
}

/// The same, with the messages of the arm.
void check_within(const Arm& arm, const ConfigurationRef& q, const char* which) {
  const auto outside = limit_violations(arm, q);
  if (!outside.empty()) throw Error(which + (": " + sentence(outside.front())));
}

/// Accepts joints that are slightly outside.
void check_from(const Arm& arm, const ConfigurationRef& q, bool from_outside) {
  if (from_outside) {
    internal::starts_outside(arm, q, max_recover, "from");
  } else {
    internal::check_start(arm, q, "from");
  }
}

Limits with_velocity(Limits limits) {
  limits.velocity = velocity_limit_of(limits);
  return limits;
}

/// The limits that a motion keeps.
using MeantLimits = Limits (*)(Limits);

void set_own_curves(std::span<const Limits> limits, PointToPoint& motion, MeantLimits meant) {
  motion.duration = 0;
  for (std::size_t k = 0; k < limits.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    motion.curves[k] = s_curve(motion.to[i] - motion.from[i], meant(limits[k]));
    motion.duration = std::max(motion.duration, motion.curves[k].duration);
  }
  for (SCurve& curve : motion.curves) curve = stretched(curve, motion.duration);
}

/// The curve of a joint that moves by `fraction` of the distance of `curve`; it may be negative.
SCurve scaled(const SCurve& curve, double fraction) {
  SCurve part = curve;
  if (fraction == 0) return {.duration = curve.duration};
  part.distance *= fraction;
  part.velocity *= fraction;
  part.acceleration *= fraction;
  part.jerk *= fraction;
  return part;
}

/// All joints follow the curve of the one that moves farthest, with limits tightened for the
/// others.
void set_one_curve(std::span<const Limits> limits, PointToPoint& motion, MeantLimits meant) {
  const Eigen::Index joints = motion.from.size();
  double farthest = 0;
  for (Eigen::Index k = 0; k < joints; ++k) {
    farthest = std::max(farthest, std::abs(motion.to[k] - motion.from[k]));
  }
  Limits tightest;
  for (Eigen::Index k = 0; k < joints; ++k) {
    const double fraction = std::abs(motion.to[k] - motion.from[k]) / farthest;
    if (!(fraction > 0)) continue;
    const Limits limit = meant(limits[k]);
    tightest.velocity = std::min(tightest.velocity, limit.velocity / fraction);
    tightest.acceleration = std::min(tightest.acceleration, limit.acceleration / fraction);
    tightest.jerk = std::min(tightest.jerk, limit.jerk / fraction);
  }
  const SCurve curve = s_curve(farthest, tightest);
  motion.duration = curve.duration;
  for (std::size_t k = 0; k < limits.size(); ++k) {
    const auto i = static_cast<Eigen::Index>(k);
    const double distance = motion.to[i] - motion.from[i];
    motion.curves[k] = scaled(curve, distance == 0 ? 0 : distance / farthest);
    motion.curves[k].distance = distance;
  }
}

/// Samples of the motion slowed down to whole periods and averaged over one: joints whose
/// acceleration is linear between samples, as the quintics through these are. Empty where the
/// budget ends it.
Trajectory in_periods(const Arm& arm, const PointToPoint& motion, double periods, double period,
                      internal::BudgetMeter& budget) {
  constexpr std::size_t batch = 256;  // samples, of less than a microsecond
  Trajectory trajectory = at_rest(arm, motion.from);
  const auto all = static_cast<std::size_t>(periods) + (periods < 2 ? 0 : 1);
  for (std::size_t k = 1; k <= all; ++k) {
    if (k % batch == 0 && budget.ended(batch)) return {};
    trajectory.times.push_back(internal::round_to_nanoseconds(static_cast<double>(k) * period));
    trajectory.positions.push_back(motion.to);
    trajectory.velocities.push_back(trajectory.velocities.front());
    trajectory.accelerations.push_back(trajectory.accelerations.front());
  }
  if (periods < 2) return trajectory;
  const double slower = periods * period / motion.duration;
  for (Eigen::Index i = 0; i < motion.from.size(); ++i) {
    const double distance = motion.to[i] - motion.from[i];
    const SCurve& curve = motion.curves[static_cast<std::size_t>(i)];
    if (distance == 0) continue;
    const TimeScaling uniform = internal::uniform_scaling(periods, period, distance, [&](double t) {
      return at(curve, t / slower).velocity / slower;
    });
    const internal::AveragedScaling averaged(uniform, period);
    for (std::size_t k = 1; k < all; ++k) {
      if (k % batch == 0 && budget.ended(batch)) return {};
      const internal::ParameterState now = averaged.at(trajectory.times[k]);
      trajectory.positions[k][i] = motion.from[i] + now.s;
      trajectory.velocities[k][i] = now.speed;
      trajectory.accelerations[k][i] = now.acceleration;
    }
  }
  return trajectory;
}

void plan(std::span<const Limits> limits, const ConfigurationRef& from, const ConfigurationRef& to,
          PointToPoint& motion, const PointToPointOptions& options, MeantLimits meant) {
  motion.from.resize(from.size());
  motion.to.resize(to.size());
  // Assigned element by element, because `from` and `to` may refer to members of `motion`,
  // exchanged.
  for (Eigen::Index k = 0; k < from.size(); ++k) {
    const double begin = from[k], end = to[k];
    motion.from[k] = begin;
    motion.to[k] = end;
  }
  motion.curves.resize(limits.size());
  if (options.synchronise == Synchronise::straight) return set_one_curve(limits, motion, meant);
  set_own_curves(limits, motion, meant);
}

}  // namespace

PointToPoint point_to_point(const Arm& arm, const ConfigurationRef& from,
                            const ConfigurationRef& to, const PointToPointOptions& options) {
  PointToPoint motion;
  point_to_point(arm, from, to, motion, options);
  return motion;
}

void point_to_point(const Arm& arm, const ConfigurationRef& from, const ConfigurationRef& to,
                    PointToPoint& motion, const PointToPointOptions& options) {
  check_from(arm, from, options.from_outside);
  check_within(arm, to, "the motion cannot end");
  plan(arm.limits(), from, to, motion, options, motion_limits);
}

PointToPoint internal::motion_from_outside(const Arm& arm, const ConfigurationRef& from,
                                           const ConfigurationRef& to, Synchronise synchronise) {
  check_configuration(arm, from);
  check_within(arm, to, "the motion cannot end");
  PointToPoint motion;
  plan(arm.limits(), from, to, motion, {.synchronise = synchronise}, motion_limits);
  return motion;
}

void point_to_point(std::span<const Limits> limits, const ConfigurationRef& from,
                    const ConfigurationRef& to, PointToPoint& motion,
                    const PointToPointOptions& options) {
  check_limits(limits);
  check_within(limits, from, "the start");
  check_within(limits, to, "the end");
  plan(limits, from, to, motion, options, with_velocity);
}

void at(const PointToPoint& motion, double t, Eigen::Ref<Configuration> q,
        Eigen::Ref<Configuration> velocity, Eigen::Ref<Configuration> acceleration) {
  const Eigen::Index joints = motion.from.size();
  if (q.size() != joints || velocity.size() != joints || acceleration.size() != joints) {
    throw Error("the state of this motion needs buffers for " + std::to_string(joints) + " joints");
  }
  if (std::isnan(t)) throw Error("the time at which a motion is evaluated is NaN");
  if (t <= 0 || t >= motion.duration) {
    q = t >= motion.duration ? motion.to : motion.from;
    velocity.setZero();
    acceleration.setZero();
    return;
  }
  const bool first_half = t <= motion.duration / 2;
  for (Eigen::Index k = 0; k < joints; ++k) {
    const SCurve& curve = motion.curves[k];
    const JointState state =
        internal::first_half_state(curve, first_half ? t : motion.duration - t);
    q[k] = first_half ? motion.from[k] + state.position : motion.to[k] - state.position;
    velocity[k] = state.velocity;
    acceleration[k] = first_half ? state.acceleration : -state.acceleration;
  }
}

Trajectory sampled(const Arm& arm, const PointToPoint& motion, double rate, const Budget& budget,
                   double duration) {
  internal::BudgetMeter meter(budget);
  check_configuration(arm, motion.from);
  internal::check_rate(rate);
  const double longest = std::max(motion.duration, duration);
  // One period is for the averaging.
  const double steps = std::max(motion.duration * rate, std::round(duration * rate) - 1);
  if (!(longest * rate < max_samples)) {
    throw Error::of("rate", number(longest) + " s at " + number(rate) +
                                " samples per second are too many samples; lower the rate");
  }
  if (motion.duration == 0) return at_rest(arm, motion.to);
  const std::vector<Limits> limits = internal::motion_limits_of(arm);
  for (double periods = std::max(1.0, std::ceil(steps - 1e-6));;) {
    Trajectory trajectory = in_periods(arm, motion, periods, 1 / rate, meter);
    if (!meter.complete()) return {};
    const auto usage = [&](int order) {
      return internal::limit_fraction(limits, trajectory, order, meter).fraction;
    };
    const double slower = slowdown_factor(usage(1), usage(2), usage(3));
    if (!meter.complete()) return {};
    if (!(slower > 1 + 1e-12)) return trajectory;
    periods = std::max(periods + 1, std::floor(periods * std::min(slower, 1e3)));
  }
}

}  // namespace beeline
