#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/doctor/internal/findings.h>
#include <beeline/doctor/internal/reconciliation.h>

namespace beeline::internal {
namespace {

constexpr double three_turns = 18.86;        // rad; joints that turn further have no limits
constexpr double farthest_slide = 20;        // metres
constexpr double fastest_joint = 60;         // rad/s, ten revolutions a second
constexpr double largest_in_degrees = 3600;  // a larger number stands for no limit

bool in_range(double value, double least, double most) {
  return std::isfinite(value) && std::abs(value) > least && std::abs(value) <= most;
}

/// 100, 1000 and so on stand for an unknown limit.
bool power_of_ten(double value) {
  const double exponent = std::log10(std::abs(value));
  return std::abs(exponent - std::round(exponent)) < 1e-9;
}

using Joints = std::vector<std::size_t>;

template <class Suspicious>
Joints joints_that(const Arm& arm, Suspicious suspicious) {
  Joints joints;
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    if (suspicious(arm.joints()[i])) joints.push_back(i);
  }
  return joints;
}

int only(const Joints& joints) { return joints.size() == 1 ? static_cast<int>(joints[0]) : -1; }

bool slides(const Joint& joint) { return kind(joint) == JointKind::prismatic; }

std::string range_text(const Limits& limits) {
  return number(limits.lower) + " to " + number(limits.upper);
}

void find_range(const Arm& arm, AngleUnit unit, std::vector<Finding>& found) {
  const Joints fixed = joints_that(arm, [](const Joint& joint) {
    return !joint.mimic && joint.limits.lower == joint.limits.upper;
  });
  if (!fixed.empty()) {
    const double value = arm.joints()[fixed.front()].limits.lower;
    found.push_back(
        {.kind = FindingKind::no_range,
         .joint = only(fixed),
         .place = joints_text(arm, fixed),
         .what = "lower and upper limit are both " + number(value) + ": no motion is within limits",
         .remedy = "write both limits (URDF takes a missing one as 0); use the type continuous "
                   "for unlimited rotation"});
  }
  const Joints turning = joints_that(arm, [](const Joint& joint) { return !slides(joint); });
  constexpr double twice = 0.12;  // rad: 360 degrees converted to radians twice are 0.11
  const bool all = std::all_of(turning.begin(), turning.end(), [&](std::size_t i) {
    const Limits& limits = arm.joints()[i].limits;
    return limits.upper - limits.lower < twice && limits.upper > limits.lower;
  });
  if (all && turning.size() >= 3) {
    found.push_back(
        {.kind = FindingKind::angle_unit,
         .place = "all joints",
         .what = std::string("no joint turns by more than 7 deg: ") +
                 (unit == AngleUnit::degrees ? "limits in radians, where the table says degrees?"
                                             : "limits converted to radians twice?"),
         .remedy = unit == AngleUnit::degrees ? "write the limits in degrees"
                                              : "write the limits in radians"});
  }
}

}  // namespace

void find_limits(const Arm& arm, AngleUnit unit, std::vector<Finding>& found) {
  const auto add = [&](const Joints& joints, FindingKind kind, const std::string& what,
                       const std::string& remedy) {
    if (joints.empty()) return;
    found.push_back({.kind = kind,
                     .joint = only(joints),
                     .place = joints_text(arm, joints),
                     .what = what,
                     .remedy = remedy});
  };
  const bool in_radians = unit == AngleUnit::radians;
  const Joints degrees = joints_that(arm, [&](const Joint& joint) {
    return in_radians && !slides(joint) &&
           (in_range(joint.limits.lower, three_turns, largest_in_degrees) ||
            in_range(joint.limits.upper, three_turns, largest_in_degrees));
  });
  if (!degrees.empty()) {
    const Limits& limits = arm.joints()[degrees.front()].limits;
    constexpr double radians = std::numbers::pi / 180;
    add(degrees, FindingKind::angle_unit, "limits " + range_text(limits) + " rad: degrees?",
        "in radians: " + number(limits.lower * radians) + " to " + number(limits.upper * radians));
  }
  const Joints millimetres = joints_that(arm, [](const Joint& joint) {
    return slides(joint) && (in_range(joint.limits.lower, farthest_slide, 1e6) ||
                             in_range(joint.limits.upper, farthest_slide, 1e6));
  });
  if (!millimetres.empty()) {
    const Limits& limits = arm.joints()[millimetres.front()].limits;
    add(millimetres, FindingKind::length_unit, "limits " + range_text(limits) + " m: millimetres?",
        "in metres: " + number(limits.lower / 1000) + " to " + number(limits.upper / 1000));
  }
  const Joints fast = joints_that(arm, [&](const Joint& joint) {
    const double velocity = joint.limits.velocity;
    return in_radians && !slides(joint) && in_range(velocity, fastest_joint, largest_in_degrees) &&
           !power_of_ten(velocity);
  });
  if (!fast.empty()) {
    const double velocity = arm.joints()[fast.front()].limits.velocity;
    add(fast, FindingKind::angle_unit,
        "velocity limit " + number(velocity) + " rad/s: degrees per second?",
        "in rad/s: " + number(velocity * std::numbers::pi / 180));
  }
  const Joints unknown = joints_that(arm, [](const Joint& joint) {
    return !joint.mimic && !std::isfinite(joint.limits.velocity);
  });
  if (unknown.size() < arm.joints().size()) {
    add(unknown, FindingKind::unknown_velocity,
        "no velocity limit, which other joints have; " + number(assumed_velocity_limit) +
            " is assumed",
        "write the maker's limit");
  }
  find_range(arm, unit, found);
}

}  // namespace beeline::internal
