#include <algorithm>
#include <array>
#include <cmath>

#include <beeline/control/internal/held_limits.h>
#include <beeline/error.h>
#include <beeline/trajectory/internal/end_velocity.h>
#include <beeline/trajectory/internal/interval_polynomial.h>
#include <beeline/trajectory/internal/limit_fraction.h>

namespace beeline::internal {
namespace {

constexpr std::array<double Limits::*, 4> rate_limits = {nullptr, &Limits::velocity,
                                                         &Limits::acceleration, &Limits::jerk};
constexpr double excess_slack = 1e-9;        // rounding, as a fraction of a limit
constexpr double position_rounding = 1e-12;  // rad or m

Extremes position_range(const Trajectory& trajectory, std::size_t k, int i) {
  const double q = trajectory.positions[k][i];
  if (k + 1 == trajectory.size()) return {q, q};
  return extremes(interval_polynomial(trajectory, k, i));
}

/// Returns the largest position beyond a limit between samples.
std::optional<LimitExcess> position_excess(const std::vector<Limits>& held,
                                           const Trajectory& trajectory) {
  std::optional<LimitExcess> largest;
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    for (std::size_t i = 0; i < held.size(); ++i) {
      const int coordinate = static_cast<int>(i);
      const auto inside = [&](const Extremes& range) {
        return within_position_limits(held[i], range.smallest, position_rounding) &&
               within_position_limits(held[i], range.largest, position_rounding);
      };
      if (k + 1 < trajectory.size() &&
          inside(enclosure(interval_polynomial(trajectory, k, coordinate)))) {
        continue;
      }
      const Extremes range = position_range(trajectory, k, coordinate);
      if (inside(range)) continue;
      const double beyond = std::max(held[i].lower - range.smallest, range.largest - held[i].upper);
      if (!largest || beyond > largest->fraction) largest = {0, coordinate, k, beyond, 1};
    }
  }
  return largest;
}

/// Returns the factor k on the duration with which a velocity v of linear joints at an end counts
/// as rest. Slowed down by k, the velocity is v / k. It counts as rest up to r + k d, where r is
/// the rest velocity and d is the velocity that the acceleration allows.
double slowdown_to_rest(const Trajectory& trajectory, const Limits& limits,
                        const EndVelocity& end) {
  const double rest = rest_velocity(trajectory, limits, 0), d = end.allowed - rest;
  const double v = std::abs(end.velocity);
  return (std::sqrt(rest * rest + 4 * d * v) - rest) / (2 * d);
}

}  // namespace

HeldLimits held_limits(const Arm& arm, const Trajectory& recording, double speed,
                       double limit_tolerance) {
  HeldLimits held{.limits = {}, .starts_at_rest = true, .ends_at_rest = true};
  const auto dof = static_cast<std::size_t>(arm.dof());
  for (int i = 0; i < arm.dof(); ++i) {
    const Limits known = arm.limits(i);
    Limits limits = motion_limits(known);
    limits.lower -= position_slack / 2;
    limits.upper += position_slack / 2;
    std::array<bool, 4>& recorded = held.recorded.emplace_back();
    for (int order = 1; order <= 3; ++order) {
      const auto kind = rate_limits[static_cast<std::size_t>(order)];
      const bool known_velocity = order == 1 && known.velocity < Limits::none;
      if (known_velocity && limit_tolerance == 0) continue;
      std::vector<Limits> only(dof);
      only[static_cast<std::size_t>(i)] = limits;
      const CoordinateFraction own = limit_fraction(only, recording, order);
      const double fraction = own.fraction * std::pow(std::min(1.0, speed), order);
      const bool free = order == 3 && !(known.jerk < Limits::none);
      if (!own.exact && (fraction > 1 || free)) limits.*kind = Limits::none;
      if (!own.exact || !(fraction > 1)) continue;
      if (known_velocity && fraction > 1 + limit_tolerance) continue;
      limits.*kind *= fraction;
      recorded[static_cast<std::size_t>(order)] = true;
    }
    for (std::size_t k = 0; k < recording.size(); ++k) {
      if (k + 1 < recording.size()) {
        const Extremes range = enclosure(interval_polynomial(recording, k, i));
        if (range.smallest >= limits.lower && range.largest <= limits.upper) continue;
      }
      const Extremes range = position_range(recording, k, i);
      limits.lower = std::min(limits.lower, range.smallest);
      limits.upper = std::max(limits.upper, range.largest);
    }
    held.limits.push_back(limits);
    const auto rests = [&](TrajectoryEnd end) {
      return end_velocity(recording, i, limits, end).at_rest();
    };
    held.starts_at_rest = held.starts_at_rest && rests(TrajectoryEnd::first);
    held.ends_at_rest = held.ends_at_rest && rests(TrajectoryEnd::last);
  }
  return held;
}

std::optional<LimitExcess> largest_excess(const HeldLimits& held, const Trajectory& trajectory) {
  std::optional<LimitExcess> largest = position_excess(held.limits, trajectory);
  if (largest) return largest;
  const auto take = [&](const LimitExcess& excess) {
    if (!largest || excess.slowdown > largest->slowdown) largest = excess;
  };
  for (int order = 1; order <= 3; ++order) {
    const CoordinateFraction found = limit_fraction(held.limits, trajectory, order);
    if (!(found.fraction > 1 + excess_slack)) continue;
    take({order, found.coordinate, found.sample, found.fraction,
          std::pow(found.fraction, 1.0 / order)});
  }
  // The change of velocity of linear joints at the ends, to and from rest.
  for (const TrajectoryEnd end : {TrajectoryEnd::first, TrajectoryEnd::last}) {
    const bool first = end == TrajectoryEnd::first;
    if (!trajectory.velocities.empty() || !(first ? held.starts_at_rest : held.ends_at_rest)) {
      continue;
    }
    for (std::size_t i = 0; i < held.limits.size(); ++i) {
      const int coordinate = static_cast<int>(i);
      const EndVelocity found = end_velocity(trajectory, coordinate, held.limits[i], end);
      if (found.at_rest()) continue;
      const double fraction = std::abs(found.velocity) / found.allowed;
      take({2, coordinate, first ? 0 : trajectory.size() - 1, fraction,
            slowdown_to_rest(trajectory, held.limits[i], found)});
    }
  }
  if (largest && !held.recorded.empty()) {
    largest->recorded = held.recorded[static_cast<std::size_t>(largest->coordinate)]
                                     [static_cast<std::size_t>(largest->order)];
  }
  return largest;
}

Reason exceeded_limit(const Arm& arm, const Trajectory& trajectory, const LimitExcess& excess) {
  const Joint& joint = arm.joint_of(excess.coordinate);
  const auto order = static_cast<std::size_t>(excess.order);
  constexpr std::array<const char*, 4> names = {"position", "velocity", "acceleration", "jerk"};
  Reason reason{ReasonCode::limit_exceeded,
                {{ReasonField::time, trajectory.times[excess.sample]},
                 {ReasonField::joint, joint.name},
                 {ReasonField::quantity, names[order]}}};
  if (order == 0) {
    reason.set(ReasonField::excess, excess.fraction);
    return reason.set(ReasonField::unit, unit(joint));
  }
  const bool known = arm.limits(excess.coordinate).*rate_limits[order] < Limits::none;
  reason.set(ReasonField::use, excess.fraction).set(ReasonField::assumed, !known);
  return reason.set(ReasonField::recorded, excess.recorded);
}

}  // namespace beeline::internal
