#include <optional>
#include <utility>

#include <beeline/planning/internal/planned_motion.h>
#include <beeline/planning/internal/unblocked_motion.h>

namespace beeline::internal {

MotionStatus status_of_blocked(const Reason& reason) {
  if (reason.code == ReasonCode::clearance_not_decided) return MotionStatus::not_decided;
  const ReasonValue* ending = reason.find(ReasonField::ending);
  return ending == nullptr ? MotionStatus::collides
                           : status_of<MotionStatus>(std::get<Ending>(*ending));
}

namespace {

/// Replaces a motion that blocked_by has a reason against by the reason.
void refuse_blocked(const BlockedBy& blocked_by, BudgetMeter& budget, PathMotion& motion) {
  Reason reason = blocked_by(motion.trajectory, budget.part());
  if (!reason) return;
  PathMotion refused;
  refused.status = status_of_blocked(reason);
  refused.reason = std::move(reason);
  refused.path_parameter = motion.path_parameter;
  motion = std::move(refused);
}

BlockedBranch blocked_branch(const Configuration& start, const PathMotion& motion) {
  return {start, motion.status, motion.reason, motion.path_parameter};
}

/// Plans, times and proves the motion of a branch, or returns why there is none.
PathMotion motion_of(const MotionRequest& request, const Branch& branch,
                     const BlockedBy& blocked_by, BudgetMeter& budget) {
  if (!branch) {
    PathMotion motion;
    motion.status = branch.status;
    motion.reason = branch.reason;
    motion.path_parameter = branch.path_parameter;
    return motion;
  }
  MotionRequest from_start = request;
  from_start.start = branch.start;
  from_start.branch.budget = budget.part();
  PathMotion motion = planned_motion_in_time(from_start, budget);
  if (motion) refuse_blocked(blocked_by, budget, motion);
  return motion;
}

}  // namespace

PathMotion unblocked_motion(const MotionRequest& request, const BlockedBy& blocked_by,
                            PathMotion best, BudgetMeter& budget) {
  constexpr double same = 1e-6;  // radians or metres
  const Configuration first = best.trajectory.positions.front();
  refuse_blocked(blocked_by, budget, best);
  if (best || request.start || !budget.complete()) return best;
  const bool redundant = request.arm.dof() > request.task().size();
  BranchOptions options = request.branch;
  options.budget = budget.part();
  std::optional<PathMotion> found;
  best.blocked.push_back(blocked_branch(first, best));
  for (const Branch& branch : branch_map(request.arm, request.route.path, options)) {
    if (budget.ended() || (found && redundant)) break;
    if ((branch.start - first).lpNorm<Eigen::Infinity>() < same) continue;
    PathMotion motion = motion_of(request, branch, blocked_by, budget);
    if (!motion) {
      best.blocked.push_back(blocked_branch(branch.start, motion));
    } else if (!found) {
      found = std::move(motion);
    }
  }
  if (!found) return best;
  found->blocked = std::move(best.blocked);
  return *found;
}

}  // namespace beeline::internal
