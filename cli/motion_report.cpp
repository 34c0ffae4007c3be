#include "motion_report.h"

#include <cmath>
#include <fmt/format.h>
#include <tuple>

#include <beeline/error.h>

#include "format.h"
#include "json_reason.h"

namespace beeline::command {
namespace {

std::string usage_line(const char* limit, const LimitFraction& use) {
  if (use.joint.empty()) return "";
  return fmt::format("{:<14}at most {} of the{} limit, joint {} at {} s{}\n", limit,
                     percent_at_most(use.fraction), use.assumed ? " assumed" : "", use.joint,
                     shown(use.time),
                     use.exact ? "" : ", by divided differences: it jumps at the samples");
}

Json json_usage(const LimitFraction& use) {
  if (use.joint.empty()) return nullptr;
  return {{"fraction", use.fraction},
          {"joint", use.joint},
          {"time", use.time},
          {"exact", use.exact},
          {"assumed", use.assumed}};
}

}  // namespace

std::string deviation_text(const PathDeviation& deviation, Interpolation interpolation,
                           const UnitArgument& unit, const std::optional<Recovery>& recovery) {
  std::string text = "deviation     position     orientation\n";
  const auto add = [&](const char* label, double position, double angle,
                       const std::string& remark) {
    text += fmt::format("  {:<10}  {:.2e} m   {:.2e} {}{}\n", label, position, angle, unit.name(),
                        remark);
  };
  const auto [sampled, measured, bound] =
      std::tie(deviation.sampled, deviation.measured, deviation.bound);
  add("at samples", sampled.position, unit.shown(sampled.orientation), "");
  add("measured", measured.position, unit.shown(measured.orientation), "   (between samples too)");
  const std::string when =
      recovery ? fmt::format("from {} s on", shown(recovery->time)) : "at all times";
  add("proved", rounded_up(bound.position, 3), rounded_up(unit.shown(bound.orientation), 3),
      fmt::format("   ({}, joints {} between samples)", when, name(interpolation)));
  return text;
}

Json deviation_members(const std::optional<PathDeviation>& deviation, const UnitArgument& unit) {
  const std::pair<const char*, Deviation PathDeviation::*> kinds[] = {
      {"bound", &PathDeviation::bound},
      {"measured", &PathDeviation::measured},
      {"sampled", &PathDeviation::sampled}};
  Json members = Json::object();
  for (const auto& [kind, value] : kinds) {
    const Json position = deviation ? Json((*deviation.*value).position) : nullptr;
    members.add(std::string("deviation_") + kind, position);
  }
  for (const auto& [kind, value] : kinds) {
    const Json angle = deviation ? Json(unit.shown((*deviation.*value).orientation)) : nullptr;
    members.add(std::string("orientation_") + kind, angle);
  }
  return members;
}

std::string condition_text(double inverse_condition) {
  return fmt::format("{:.3g}", inverse_condition);
}

std::string position_text(const LimitUsage& limits) {
  const LimitFraction& use = limits.position;
  if (use.joint.empty()) return "position      no joint has position limits\n";
  return fmt::format("position      at most {} of the half range, joint {} at {} s\n",
                     percent_at_most(use.fraction), use.joint, shown(use.time));
}

std::string limits_text(const LimitUsage& limits) {
  return usage_line("velocity", limits.velocity) + usage_line("acceleration", limits.acceleration) +
         usage_line("jerk", limits.jerk);
}

Json json_limits(const LimitUsage& limits) {
  return {{"position", json_usage(limits.position)},
          {"velocity", json_usage(limits.velocity)},
          {"acceleration", json_usage(limits.acceleration)},
          {"jerk", json_usage(limits.jerk)}};
}

Json json_blends(const std::vector<double>& radii) {
  Json blends = Json::list();
  for (const double radius : radii) blends.append(radius);
  return blends;
}

std::string start_jump_text(const Arm& arm, const StartJump& jump, const UnitArgument& unit) {
  if (jump.joint.empty()) return "";
  const int k = coordinate_named(arm, jump.joint);
  const bool slides = kind(arm.joint_of(k)) == JointKind::prismatic;
  return fmt::format("start         jumps from rest to {} {}/s, {} of the{} limit, joint {}\n",
                     shown(unit.shown(arm, k, jump.velocity)), slides ? "m" : unit.name(),
                     percent(jump.fraction), jump.assumed ? " assumed" : "", jump.joint);
}

Json json_start_jump(const Arm& arm, const StartJump& jump, const UnitArgument& unit) {
  if (jump.joint.empty()) return nullptr;
  return {{"velocity", unit.shown(arm, coordinate_named(arm, jump.joint), jump.velocity)},
          {"fraction", jump.fraction},
          {"joint", jump.joint},
          {"assumed", jump.assumed}};
}

Option limit_tolerance_option(double* target) {
  return Option("--limit-tolerance FRACTION",
                "Fraction by which velocities, accelerations and jerks may exceed their limits, "
                "for the rounding of other planners: 1e-4 for many.",
                target, {.range = {0, 0.1}});
}

std::string limit_tolerance_text(double limit_tolerance) {
  if (limit_tolerance == 0) return "";
  return fmt::format("tolerance     {} of the limits of velocity, acceleration and jerk\n",
                     percent(limit_tolerance));
}

std::string difference_text(const Arm& arm, const TrajectoryDifference& difference,
                            const UnitArgument& unit) {
  std::string text = "joint         largest       at s          rms\n";
  for (int k = 0; k < arm.dof(); ++k) {
    const JointDifference& joint = difference.joints[k];
    text += fmt::format("  {:<10}  {:<12}  {:<12}  {}\n", arm.joint_of(k).name,
                        shown(unit.shown(arm, k, joint.largest)), shown(joint.time),
                        shown(unit.shown(arm, k, joint.rms)));
  }
  return text +
         fmt::format("tool          {} m at {} s, {} {} at {} s\n",
                     shown(difference.largest_position), shown(difference.position_time),
                     shown(unit.shown(difference.largest_orientation)), unit.name(),
                     shown(difference.orientation_time)) +
         fmt::format("time          {} s compared; the second lasts {} s {}\n",
                     shown(difference.overlap), shown(std::abs(difference.longer)),
                     difference.longer < 0 ? "less" : "more");
}

Json difference_members(const Arm& arm, const TrajectoryDifference& difference,
                        const UnitArgument& unit) {
  Json joints = Json::list();
  for (int k = 0; k < arm.dof(); ++k) {
    const JointDifference& joint = difference.joints[k];
    joints.append({{"joint", arm.joint_of(k).name},
                   {"largest", unit.shown(arm, k, joint.largest)},
                   {"time", joint.time},
                   {"rms", unit.shown(arm, k, joint.rms)}});
  }
  return {{"joints", joints},
          {"position", difference.largest_position},
          {"position_time", difference.position_time},
          {"orientation", unit.shown(difference.largest_orientation)},
          {"orientation_time", difference.orientation_time},
          {"overlap", difference.overlap},
          {"longer", difference.longer}};
}

std::string branches_text(const Arm& arm, const std::vector<Branch>& branches,
                          const UnitArgument& unit) {
  std::string text = fmt::format("branches      {}\n", branches.size());
  if (branches.empty()) return text;
  text += fmt::format("   #  segments  margin  inv. cond.  start ({})\n", unit.name());
  for (std::size_t i = 0; i < branches.size(); ++i) {
    const Branch& branch = branches[i];
    text +=
        fmt::format("  {:>2}  {:>8}  {:>4.0f} %  {:>10}  {}\n", i + 1, shown(branch.path_parameter),
                    100 * branch.limit_margin, condition_text(branch.inverse_condition),
                    shown(unit.shown(arm, branch.start)));
    if (branch.reason) {
      text += fmt::format("      {}: {}\n", name(branch.status), sentence(branch.reason));
    }
  }
  return text;
}

Json json_branches(const Arm& arm, const std::vector<Branch>& branches, const UnitArgument& unit) {
  Json list = Json::list();
  for (const Branch& branch : branches) {
    Json json{{"start", unit.shown(arm, branch.start)},
              {"status", name(branch.status)},
              {"path_parameter", branch.path_parameter},
              {"limit_margin", branch.limit_margin},
              {"inverse_condition", branch.inverse_condition}};
    json.add(json_reason(branch.reason));
    list.append(json);
  }
  return list;
}

}  // namespace beeline::command
