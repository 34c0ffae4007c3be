#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include <beeline/certificate/internal/clearance_recovery.h>
#include <beeline/planning/internal/independent_rows.h>
#include <beeline/planning/internal/planned_motion.h>
#include <beeline/planning/internal/unblocked_motion.h>

namespace beeline::internal {

MotionStatus status_of_blocked(const Reason& reason) {
  if (reason.code == ReasonCode::clearance_not_decided) return MotionStatus::not_decided;
  const ReasonValue* ending = reason.find(ReasonField::ending);
  return ending == nullptr ? MotionStatus::collides
                           : status_of<MotionStatus>(std::get<Ending>(*ending));
}

Reason blocked_reason(const BlockedMotions& blocked_by, ClearanceOptions options,
                      BudgetMeter& budget, const Trajectory& motion) {
  options.budget = budget.part();
  return blocked_by.reason(motion, options);
}

void refuse(MotionStatus status, Reason reason, PathMotion& motion) {
  PathMotion refused;
  refused.status = status;
  refused.reason = std::move(reason);
  refused.path_parameter = motion.path_parameter;
  motion = std::move(refused);
}

namespace {

/// Replaces a motion that is blocked by the reason.
void refuse_blocked(const MotionRequest& request, const BlockedMotions& blocked_by,
                    BudgetMeter& budget, PathMotion& motion) {
  if (!motion) return;
  Reason reason = blocked_reason(blocked_by, request.clearance, budget, motion.trajectory);
  if (!reason) return;
  const MotionStatus status = status_of_blocked(reason);
  refuse(status, std::move(reason), motion);
}

BlockedBranch blocked_branch(const Configuration& start, const PathMotion& motion) {
  return {start, motion.status, motion.reason, motion.path_parameter};
}

/// Plans, times and proves a motion, or returns why there is none that is not blocked.
PathMotion planned_unblocked(MotionRequest request, const BlockedMotions& blocked_by,
                             BudgetMeter& budget) {
  request.branch.budget = budget.part();
  PathMotion motion = planned_motion_in_time(request, budget);
  refuse_blocked(request, blocked_by, budget, motion);
  return motion;
}

/// The same for the motion of a branch.
PathMotion motion_of(const MotionRequest& request, const Branch& branch,
                     const BlockedMotions& blocked_by, BudgetMeter& budget) {
  if (!branch) {
    PathMotion motion;
    motion.status = branch.status;
    motion.reason = branch.reason;
    motion.path_parameter = branch.path_parameter;
    return motion;
  }
  MotionRequest from_start = request;
  from_start.start = branch.start;
  return planned_unblocked(std::move(from_start), blocked_by, budget);
}

/// The distance beyond the clearance that a plan keeps positive. From a start that is closer than
/// the clearance, by `missing`, it is spare(q) + missing max(0, 1 - |q - start| / far) in the
/// largest norm: the plan may begin there, and the proof decides whether the motion leads out.
std::function<double(const ConfigurationRef&)> spare_beside(
    const std::optional<Configuration>& start, const BlockedMotions& blocked_by) {
  constexpr double far = 0.5;  // radians or metres of a joint
  const auto& spare = blocked_by.spare_clearance;
  const double missing = start ? -spare(*start) : 0;
  if (!(missing > 0)) return spare;
  return [spare, start = *start, missing](const ConfigurationRef& q) {
    const double away = (q - start).lpNorm<Eigen::Infinity>() / far;
    return spare(q) + missing * std::max(0.0, 1 - away);
  };
}

/// Plans, times and proves a motion with a self-motion that keeps clear.
PathMotion motion_aside(const MotionRequest& request, const BlockedMotions& blocked_by,
                        BudgetMeter& budget) {
  MotionRequest aside = request;
  aside.branch.spare_clearance = spare_beside(request.start, blocked_by);
  return planned_unblocked(std::move(aside), blocked_by, budget);
}

/// Whether a motion may begin at a start: at no distance less than the options accept.
bool may_begin(const MotionRequest& request, const BlockedMotions& blocked_by) {
  if (!request.start) return true;
  const double missing = -blocked_by.spare_clearance(*request.start);
  return missing <= 0 || may_recover_clearance(missing, request.clearance.recover_clearance);
}

}  // namespace

PathMotion unblocked_motion(const MotionRequest& request, const BlockedMotions& blocked_by,
                            PathMotion best, BudgetMeter& budget) {
  constexpr double same = 1e-6;  // radians or metres
  const Configuration first = best.trajectory.positions.front();
  refuse_blocked(request, blocked_by, budget, best);
  if (best || !budget.complete()) return best;
  const bool redundant = is_redundant(request.arm, request.task());
  if (redundant && blocked_by.spare_clearance && may_begin(request, blocked_by)) {
    PathMotion aside = motion_aside(request, blocked_by, budget);
    if (aside) {
      aside.blocked = {blocked_branch(first, best)};
      return aside;
    }
  }
  if (request.start || !budget.complete()) return best;
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
