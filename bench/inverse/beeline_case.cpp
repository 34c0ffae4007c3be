#include "beeline_case.h"

namespace beeline::bench {
namespace {

constexpr int max_solutions = 64;

InverseOptions options_of(const BenchArm& arm, CaseKind kind) {
  InverseOptions options;
  options.all = kind == CaseKind::all_solutions;
  options.ignore_limits = kind == CaseKind::all_solutions || kind == CaseKind::numerical_free;
  const bool numerical = kind == CaseKind::numerical_within_limits ||
                         kind == CaseKind::numerical_free || kind == CaseKind::tracking;
  if (numerical) options.method = InverseMethod::numerical;
  if (arm.last) options.lock = arm.arm.dof() - 1;
  return options;
}

}  // namespace

BeelineCase::BeelineCase(const BenchArm& arm, CaseKind kind)
    : arm_(arm.arm),
      options_(options_of(arm, kind)),
      last_(arm.last),
      solutions_(arm_.dof(), options_.all ? max_solutions : 1) {}

int BeelineCase::solve(const Pose& world_T_tool, const Configuration& seed) {
  if (!last_) return inverse_kinematics(arm_, world_T_tool, seed, solutions_, options_);
  seed_ = seed;
  seed_[seed_.size() - 1] = *last_;
  return inverse_kinematics(arm_, world_T_tool, seed_, solutions_, options_);
}

}  // namespace beeline::bench
