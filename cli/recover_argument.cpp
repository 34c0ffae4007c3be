#include "recover_argument.h"

#include <fmt/format.h>

#include <beeline/io/text/numbers.h>
#include <beeline/io/text/pose_list.h>
#include <beeline/kinematics/forward.h>

#include "format.h"

namespace beeline::command {
namespace {

const std::string slight = "slight";

double shown_excess(const Arm& arm, const Recovery& recovery, const UnitArgument& unit) {
  return unit.shown(arm, coordinate_named(arm, recovery.joint), recovery.excess);
}

}  // namespace

Option RecoverArgument::option(const std::string& of, const OptionRules& rules) {
  OptionRules accepted = rules;
  accepted.choices = {slight};
  accepted.other_values = true;
  return Option("--recover AMOUNT",
                of + " AMOUNT is an excess over a position limit, from 0 to " +
                    fmt::format("{}", max_recover) +
                    " rad or m, with --degrees in degrees instead of rad, or slight: 1e-4 of the "
                    "smallest range of a joint. It counts as so many rad and as so many m.",
                &text, std::move(accepted));
}

double RecoverArgument::read(const Arm& arm, const UnitArgument& unit) const {
  if (text.empty()) return 0;
  if (text == slight) return slight_excess(arm);
  const double amount = parse_number(text, "--recover");
  bool turns = false;
  for (int k = 0; k < arm.dof(); ++k) turns |= kind(arm.joint_of(k)) != JointKind::prismatic;
  return turns ? to_radians(amount, unit.angle_unit()) : amount;
}

Pose tool_after_recovery(const Arm& arm, const Configuration& start) {
  return forward_kinematics(arm, nearest_within_limits(arm, start));
}

std::string recovery_text(const Arm& arm, const std::optional<Recovery>& recovery,
                          const UnitArgument& unit) {
  if (!recovery) return "";
  const int k = coordinate_named(arm, recovery->joint);
  const bool slides = kind(arm.joint_of(k)) == JointKind::prismatic;
  return fmt::format(
      "recovery      starts outside the limits by {} {}, joint {}; within them from {} s on\n",
      shown(shown_excess(arm, *recovery, unit)), slides ? "m" : unit.name(), recovery->joint,
      shown(recovery->time));
}

Json json_recovery(const Arm& arm, const std::optional<Recovery>& recovery,
                   const UnitArgument& unit) {
  if (!recovery) return nullptr;
  return {{"excess", shown_excess(arm, *recovery, unit)},
          {"joint", recovery->joint},
          {"sample", recovery->sample + 1},
          {"time", recovery->time}};
}

}  // namespace beeline::command
