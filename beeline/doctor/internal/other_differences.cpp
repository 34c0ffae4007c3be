#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <beeline/doctor/internal/reconciliation.h>
#include <beeline/doctor/internal/verdict.h>

namespace beeline::internal {
namespace {

/// Limits are published with three or four digits.
constexpr double limit_rounding = 1e-3;

bool same_limit(double a, double b) {
  return a == b || std::abs(a - b) <= limit_rounding * std::max(1.0, std::abs(a));
}

/// B's limits in the coordinates of A.
Limits in_coordinates_of_a(Limits limits, double gain, double offset) {
  if (gain == 0) return limits;
  limits.lower = (limits.lower - offset) / gain;
  limits.upper = (limits.upper - offset) / gain;
  if (gain < 0) std::swap(limits.lower, limits.upper);
  limits.velocity /= std::abs(gain);
  limits.acceleration /= std::abs(gain);
  limits.jerk /= std::abs(gain);
  return limits;
}

struct NamedLimit {
  const char* name;
  double Limits::*value;
  bool position;
};
constexpr NamedLimit named_limits[] = {{"lower limit", &Limits::lower, true},
                                       {"upper limit", &Limits::upper, true},
                                       {"velocity limit", &Limits::velocity, false},
                                       {"acceleration limit", &Limits::acceleration, false},
                                       {"jerk limit", &Limits::jerk, false}};

std::string value_text(const Joint& joint, const NamedLimit& limit, double value) {
  if (!std::isfinite(value)) return "none";
  if (limit.position) return with_unit(joint, value);
  const char* seconds = limit.value == &Limits::velocity       ? "/s"
                        : limit.value == &Limits::acceleration ? "/s^2"
                                                               : "/s^3";
  return number(value) + " " + unit(joint) + seconds;
}

/// Returns how a wrong limit may come from the right one.
std::string limit_relation(double a, double b, bool equal_numbers) {
  constexpr double degrees = 180 / std::numbers::pi;
  if (equal_numbers) return "equal numbers, though zero or sign of the joint differ";
  if (!std::isfinite(a) || !std::isfinite(b)) return "";
  if (same_limit(b / degrees, a)) return "degrees in B";
  if (same_limit(a / degrees, b)) return "degrees in A";
  if (same_limit(b / 1000, a) && std::abs(a) > 0.01) return "millimetres in B";
  if (same_limit(a / 1000, b) && std::abs(b) > 0.01) return "millimetres in A";
  if (same_limit(a, -b)) return "the other sign";
  return "";
}

void add_limits(const Arm& a, const Arm& b, std::pair<std::size_t, std::size_t> pair, double gain,
                double offset, std::vector<ModelDifference>& found) {
  const auto [i, k] = pair;
  const Joint &joint = a.joints()[i], &other = b.joints()[k];
  const Limits in_a = joint.limits, in_b = in_coordinates_of_a(other.limits, gain, offset);
  const bool equal_numbers = (gain != 1 || offset != 0) &&
                             same_limit(in_a.lower, other.limits.lower) &&
                             same_limit(in_a.upper, other.limits.upper);
  for (const NamedLimit& limit : named_limits) {
    const double left = in_a.*limit.value, right = in_b.*limit.value;
    if (same_limit(left, right)) continue;
    // An unknown limit contradicts no known one. A file may omit the limits of velocity,
    // acceleration and jerk.
    if (!limit.position && (!std::isfinite(left) || !std::isfinite(right))) continue;
    const std::string relation = limit_relation(left, right, equal_numbers && limit.position);
    const std::optional<double> value_a = left, value_b = right;
    found.push_back({.kind = DifferenceKind::limit,
                     .joint = static_cast<int>(i),
                     .parameter = limit.name,
                     .a = std::isfinite(left) ? value_a : std::nullopt,
                     .b = std::isfinite(right) ? value_b : std::nullopt,
                     .what = std::string(limit.name) + " " + value_text(joint, limit, left) +
                             " in A, " + value_text(joint, limit, right) + " in B" +
                             (relation.empty() ? "" : " (" + relation + ")")});
  }
}

bool without_position_limits(const Arm& arm) {
  return std::none_of(arm.joints().begin(), arm.joints().end(), [](const Joint& joint) {
    return std::isfinite(joint.limits.lower) || std::isfinite(joint.limits.upper);
  });
}

/// Adds that the joints that both arms have are called by the same names in another order.
void add_names(const Arm& a, const Arm& b, const JointPairs& pairs,
               std::vector<ModelDifference>& found) {
  std::vector<std::string> names_a, names_b;
  for (const auto& [i, k] : pairs) {
    names_a.push_back(a.joints()[i].name);
    names_b.push_back(b.joints()[k].name);
  }
  const bool same_names = std::is_permutation(names_a.begin(), names_a.end(), names_b.begin());
  if (names_a == names_b || !same_names) return;
  const auto [left, right] = std::mismatch(names_a.begin(), names_a.end(), names_b.begin());
  const auto place = static_cast<std::size_t>(left - names_a.begin());
  found.push_back(
      {.kind = DifferenceKind::name,
       .joint = static_cast<int>(pairs[place].first),
       .parameter = "name",
       .what = "the names are in another order: " + *left + " in A, " + *right + " in B"});
}

std::string mimic_text(const std::optional<Mimic>& mimic) {
  if (!mimic) return "a coordinate of its own";
  return number(mimic->multiplier) + " x " + mimic->leader + " + " + number(mimic->offset);
}

/// Returns the index in A of B's joint of that name.
std::optional<std::size_t> index_in_a(const std::string& name, const Arm& b,
                                      const JointPairs& pairs) {
  for (const auto& [i, k] : pairs) {
    if (b.joints()[k].name == name) return i;
  }
  return std::nullopt;
}

/// Compares the value of a mimic joint of B, as a function of A's coordinates, with its value in A.
void add_mimic(const Arm& a, const Arm& b, const JointPairs& pairs,
               std::pair<std::size_t, std::size_t> pair, const ArmComparison& comparison,
               double tolerance, std::vector<ModelDifference>& found) {
  const Joint &joint = a.joints()[pair.first], &other = b.joints()[pair.second];
  if (!joint.mimic && !other.mimic) return;
  bool same = false;
  const auto leader =
      joint.mimic && other.mimic ? index_in_a(other.mimic->leader, b, pairs) : std::nullopt;
  if (leader) {
    const auto i = static_cast<Eigen::Index>(pair.first), l = static_cast<Eigen::Index>(*leader);
    const double gain = comparison.gain[i] == 0 ? 1 : comparison.gain[i];
    const double multiplier = other.mimic->multiplier * comparison.gain[l] / gain;
    const double offset = (other.mimic->multiplier * comparison.offset[l] + other.mimic->offset -
                           comparison.offset[i]) /
                          gain;
    same = a.joints()[*leader].name == joint.mimic->leader &&
           std::abs(multiplier - joint.mimic->multiplier) <= tolerance &&
           std::abs(offset - joint.mimic->offset) <= tolerance;
  }
  if (same) return;
  found.push_back({.kind = DifferenceKind::mimic,
                   .joint = static_cast<int>(pair.first),
                   .parameter = "mimic",
                   .what = "follows " + mimic_text(joint.mimic) + " in A, " +
                           mimic_text(other.mimic) + " in B"});
}

}  // namespace

std::vector<ModelDifference> other_differences(const Arm& a, const Arm& b, const JointPairs& pairs,
                                               const ArmComparison& comparison, double tolerance) {
  std::vector<ModelDifference> found;
  if (pairs.empty()) return found;
  const bool none_in_a = without_position_limits(a), none_in_b = without_position_limits(b);
  if (none_in_a != none_in_b) {
    found.push_back(
        {.kind = DifferenceKind::limit,
         .parameter = "position limits",
         .what = std::string("no joint has position limits in ") + (none_in_a ? "A" : "B")});
  }
  for (const auto& pair : pairs) {
    const auto i = static_cast<Eigen::Index>(pair.first);
    add_mimic(a, b, pairs, pair, comparison, tolerance, found);
    if (kind(a.joints()[pair.first]) != kind(b.joints()[pair.second])) continue;
    if (none_in_a == none_in_b) {
      add_limits(a, b, pair, comparison.gain[i], comparison.offset[i], found);
    }
  }
  add_names(a, b, pairs, found);
  return found;
}

}  // namespace beeline::internal
