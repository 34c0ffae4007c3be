#include "beeline_case.h"

namespace beeline::bench {
namespace {

/// The arm without its last joint, which stands still.
Arm moving_part(const BenchArm& measured) {
  if (!measured.last) return measured.arm;
  std::vector<Joint> joints = measured.arm.joints();
  const Pose tool = joint_transform(joints.back(), *measured.last) * measured.arm.tool();
  joints.pop_back();
  return {measured.arm.name(), joints, tool, measured.arm.base()};
}

InverseOptions options_of(CaseKind kind) {
  InverseOptions options;
  options.all = kind == CaseKind::all_solutions;
  options.ignore_limits = kind == CaseKind::all_solutions || kind == CaseKind::numerical_free;
  return options;
}

}  // namespace

BeelineCase::BeelineCase(const BenchArm& arm, CaseKind kind)
    : arm_(moving_part(arm)), last_(arm.last), options_(options_of(kind)) {}

int BeelineCase::solve(const Pose& world_T_tool, const Configuration& seed) {
  options_.seed = seed.head(arm_.dof());
  result_ = inverse_kinematics(arm_, world_T_tool, options_);
  return static_cast<int>(result_.solutions.size());
}

Configuration BeelineCase::solution(int i) const {
  const Configuration& q = result_.solutions[static_cast<std::size_t>(i)];
  if (!last_) return q;
  Configuration whole(q.size() + 1);
  whole << q, *last_;
  return whole;
}

}  // namespace beeline::bench
