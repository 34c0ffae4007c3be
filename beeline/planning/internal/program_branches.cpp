#include <beeline/planning/branch.h>
#include <beeline/planning/internal/motion_request.h>
#include <beeline/planning/internal/pose_configurations.h>
#include <beeline/planning/internal/program_branches.h>
#include <beeline/planning/internal/unblocked_motion.h>

namespace beeline::internal {

ProgramBranches::ProgramBranches(const Arm& arm, const Program& program,
                                 const PathMotionOptions& options, const CollisionModel* model)
    : arm_(arm), program_(program), budget_(options.budget), options_(options) {
  if (model != nullptr) scene_.emplace(*model, program);
  options_.budget = budget_.part();
  options_.task = options.task.value_or(default_task(arm));
  options_.suggest = false;
  succeed();
}

bool ProgramBranches::fail(std::size_t move, MotionStatus status, Reason reason,
                           const std::string& name) {
  motion_.status = status;
  motion_.reason = std::move(reason);
  motion_.reason.set(ReasonField::move, move + 1);
  motion_.reason.set(ReasonField::move_name, name.empty() ? move_name(program_, move) : name);
  motion_.failed = move;
  return false;
}

bool ProgramBranches::succeed() {
  motion_.status = MotionStatus::reached;
  motion_.reason = {};
  motion_.failed = program_.moves.size();
  return true;
}

bool ProgramBranches::fail_ended(std::size_t move) {
  return fail(move, status_of<MotionStatus>(budget_.ending()),
              ended_reason(ReasonCode::ended, budget_.ending()));
}

bool ProgramBranches::configuration_at(std::size_t move, const Pose& pose,
                                       const Configuration& from, std::optional<Configuration>& q) {
  const auto found = configurations_for(arm_, *options_.task, pose, from, budget_.part());
  if (!found.empty()) q = found.front();
  return q || solution_at(move, pose, from, q);
}

bool ProgramBranches::solution_at(std::size_t move, const Pose& pose, const Configuration& from,
                                  std::optional<Configuration>& q) {
  const InverseResult found = solution_for(arm_, *options_.task, pose, from, budget_.part());
  if (found) q = found.solutions.front();
  return found || fail(move, motion_status(found.status), found.reason);
}

bool ProgramBranches::follow(std::size_t p, const std::optional<Configuration>& q,
                             std::optional<PathMotion>& ahead) {
  const ProgramPart& part = parts_[p];
  ahead = move_along(arm_, q, part.route, options_);
  if (*ahead) return true;
  Reason& reason = ahead->reason;
  if (const ReasonValue* const segment = reason.find(ReasonField::segment)) {
    const std::size_t move = part.moves[std::get<std::size_t>(*segment) - 1];
    return fail(move, ahead->status, reason);
  }
  if (part.first > 0 && reason.has(ReasonField::beginning)) {  // the waypoint of the move before
    std::erase_if(reason.fields,
                  [](const auto& entry) { return entry.first == ReasonField::beginning; });
    return fail(part.first - 1, ahead->status, reason);
  }
  return fail(part.first, ahead->status, reason, part_name(program_, part));
}

bool ProgramBranches::follow_free(std::size_t p, const Configuration& q,
                                  std::optional<PathMotion>& ahead) {
  if (!follow(p, q, ahead)) return false;
  const Reason reason = scene_->blocked_ahead(parts_[p], *ahead, budget_.part());
  return !reason ||
         fail(parts_[p].first, status_of_blocked(reason), reason, part_name(program_, parts_[p]));
}

bool ProgramBranches::has_branch(std::size_t p, const Configuration& q) {
  BranchOptions planning = branch_options(arm_, options_, 1);
  planning.max_grid = 16;
  planning.reasons = BranchOptions::Reasons::none;
  planning.budget = budget_.part();
  return bool(plan_path(arm_, q, parts_[p].route.path, planning));
}

bool ProgramBranches::choose_branch(std::size_t p, const Configuration& from,
                                    std::optional<Configuration>& q,
                                    std::optional<PathMotion>& ahead) {
  const ToolPath& path = parts_[p].route.path;
  for (const Configuration& candidate :
       configurations_for(arm_, *options_.task, pose_at(path, 0), from, budget_.part())) {
    if (budget_.ended()) break;
    if (!has_branch(p, candidate) || !follow(p, candidate, ahead)) continue;
    q = candidate;
    return succeed();
  }
  if (!follow(p, std::nullopt, ahead)) return false;
  q = ahead->trajectory.positions.front();
  return succeed();
}

}  // namespace beeline::internal
