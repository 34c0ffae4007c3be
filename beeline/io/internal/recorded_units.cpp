#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/internal/derived_quantity.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/internal/recorded_units.h>
#include <beeline/io/text/internal/foreign_unit.h>
#include <beeline/math/revolution.h>

namespace beeline::internal {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double slack = 1e-3;          // radians or metres, of a joint that is at its limit
constexpr double excess_of_fit = 0.05;  // radians or metres: recordings exceed limits a little

bool has_unit(const JointMap& joint_map, int k) {
  return !joint_map.empty() && joint_map[static_cast<std::size_t>(k)].unit.has_value();
}

bool slides(const Arm& arm, int k) { return kind(arm.joint_of(k)) == JointKind::prismatic; }

/// The excess of the value over the joint's limits, or over `without` if it has none; at most 0
/// within them.
double excess(const Limits& limits, double value, double without) {
  const double upper = limits.upper < Limits::none ? limits.upper : without;
  const double lower = limits.lower > -Limits::none ? limits.lower : -without;
  return std::max(value - upper, lower - value);
}

/// The largest excess of coordinate k.
UnitEvidence largest(const Trajectory& recording, const Limits& limits, int k, double without) {
  UnitEvidence found{k, recording.positions.front()[k]};
  for (const Configuration& q : recording.positions) {
    if (excess(limits, q[k], without) > excess(limits, found.value, without)) found.value = q[k];
  }
  return found;
}

bool fits(const Trajectory& recording, const Limits& limits, int k, double unit, double without) {
  return std::all_of(recording.positions.begin(), recording.positions.end(),
                     [&](const Configuration& q) {
                       return excess(limits, unit * q[k], without) <= excess_of_fit;
                     });
}

bool has_two_limits(const Limits& limits) {
  return std::isfinite(limits.lower) && std::isfinite(limits.upper);
}

/// Whether coordinate k keeps its velocity limit between all samples, in these units.
bool keeps_velocity(const Arm& arm, const Trajectory& recording, int k, double unit) {
  const double limit = velocity_limit_of(arm.limits(k)) / arm.limits(k).speed_scale;
  for (std::size_t i = 1; i < recording.size(); ++i) {
    const double step = recording.positions[i][k] - recording.positions[i - 1][k];
    if (std::abs(unit * step) > limit * (recording.times[i] - recording.times[i - 1])) return false;
  }
  return true;
}

/// Whether the values of coordinate k, of a joint without two limits, are probably degrees.
bool is_rather_in_degrees(const Arm& arm, const Trajectory& recording, int k, bool has_times) {
  double smallest = Limits::none, largest = 0;
  for (const Configuration& q : recording.positions) {
    smallest = std::min(smallest, std::abs(q[k]));
    largest = std::max(largest, std::abs(q[k]));
  }
  constexpr double degrees_of_one = 361;
  if (largest <= 2 * revolution || largest > degrees_of_one) return false;
  if (smallest > revolution) return true;
  return has_times && !keeps_velocity(arm, recording, k, 1) &&
         keeps_velocity(arm, recording, k, degree);
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

bool is_other_quantity(std::string_view word) {
  const ForeignUnit* const unit = foreign_unit(lower_case(word));
  if (unit != nullptr && unit->counts_in_names) return true;
  const std::optional<DerivedQuantity> quantity = derived_quantity(word);
  return quantity == DerivedQuantity::other || quantity == DerivedQuantity::property;
}

}  // namespace

std::string_view other_quantity_in(std::string_view text) {
  for (std::size_t begin = 0; begin < text.size();) {
    std::size_t end = begin;
    while (end < text.size() && is_letter(text[end])) ++end;
    const std::string_view word = text.substr(begin, end - begin);
    if (is_other_quantity(word)) return word;
    begin = end + 1;
  }
  return {};
}

std::optional<UnitEvidence> evidence_of_revolutions(const Arm& arm, const Trajectory& recording,
                                                    const JointMap& joint_map, bool has_times) {
  if (recording.size() == 0) return std::nullopt;
  std::optional<UnitEvidence> evidence;
  for (int k = 0; k < arm.dof(); ++k) {
    const Limits& limits = arm.limits(k);
    if (slides(arm, k) || has_unit(joint_map, k)) continue;
    if (has_two_limits(limits)) {
      if (!fits(recording, limits, k, degree, 0)) return std::nullopt;
    } else if (!evidence && is_rather_in_degrees(arm, recording, k, has_times)) {
      evidence = largest(recording, {}, k, 0);
    }
  }
  return evidence;
}

bool may_be_in_degrees(const Arm& arm, const Trajectory& recording, const JointMap& joint_map) {
  bool any = false;
  for (int k = 0; k < arm.dof(); ++k) {
    if (slides(arm, k) || has_unit(joint_map, k)) continue;
    if (!fits(recording, arm.limits(k), k, degree, Limits::none)) return false;
    any = true;
  }
  return any;
}

std::optional<UnitEvidence> evidence_of_degrees(const Arm& arm, const Trajectory& recording,
                                                const JointMap& joint_map) {
  if (recording.size() == 0) return std::nullopt;
  std::optional<UnitEvidence> evidence;
  for (int k = 0; k < arm.dof(); ++k) {
    const Limits& limits = arm.limits(k);
    if (slides(arm, k) || has_unit(joint_map, k)) continue;
    if (!has_two_limits(limits)) continue;
    if (!fits(recording, limits, k, degree, 0)) return std::nullopt;
    const UnitEvidence found = largest(recording, limits, k, 0);
    if (!evidence && excess(limits, found.value, 0) > revolution) evidence = found;
  }
  return evidence;
}

std::optional<UnitEvidence> evidence_of_millimetres(const Arm& arm, const Trajectory& recording,
                                                    const JointMap& joint_map) {
  if (recording.size() == 0) return std::nullopt;
  std::optional<UnitEvidence> evidence;
  for (int k = 0; k < arm.dof(); ++k) {
    if (!slides(arm, k) || has_unit(joint_map, k)) continue;
    constexpr double longest = 10;  // metres, without limits
    const Limits& limits = arm.limits(k);
    if (!fits(recording, limits, k, 1e-3, longest)) return std::nullopt;
    const UnitEvidence found = largest(recording, limits, k, longest);
    if (!evidence && excess(limits, found.value, longest) > slack) evidence = found;
  }
  return evidence;
}

std::optional<double> evidence_of_milliseconds(const Arm& arm, const Trajectory& recording) {
  constexpr double slow = 1.0 / 500, long_period = 1;
  if (recording.size() < 3) return std::nullopt;
  const double period = (recording.times.back() - recording.times.front()) /
                        static_cast<double>(recording.size() - 1);
  if (period < long_period) return std::nullopt;
  bool moves = false;
  for (std::size_t i = 1; i < recording.size(); ++i) {
    const double duration = recording.times[i] - recording.times[i - 1];
    for (int k = 0; k < arm.dof(); ++k) {
      const double step = std::abs(recording.positions[i][k] - recording.positions[i - 1][k]);
      if (step > slow * velocity_limit_of(arm.limits(k)) * duration) return std::nullopt;
      moves = moves || step > 0;
    }
  }
  return moves ? std::optional(period) : std::nullopt;
}

}  // namespace beeline::internal
