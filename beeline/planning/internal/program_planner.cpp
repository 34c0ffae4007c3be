#include <algorithm>
#include <cmath>
#include <utility>

#include <beeline/internal/budget_meter.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/branch.h>
#include <beeline/planning/internal/current_scene.h>
#include <beeline/planning/internal/independent_rows.h>
#include <beeline/planning/internal/line_blends.h>
#include <beeline/planning/internal/motion_along.h>
#include <beeline/planning/internal/motion_request.h>
#include <beeline/planning/internal/pose_configurations.h>
#include <beeline/planning/internal/program_completion.h>
#include <beeline/planning/internal/program_parts.h>
#include <beeline/planning/internal/program_planner.h>
#include <beeline/planning/internal/program_trajectory.h>
#include <beeline/planning/internal/unblocked_motion.h>
#include <beeline/trajectory/internal/recovery.h>

namespace beeline::internal {
namespace {

class ProgramPlanner {
 public:
  ProgramPlanner(const Arm& arm, const Program& program, const PathMotionOptions& options,
                 const CollisionModel* model)
      : arm_(arm), program_(program), budget_(options.budget), options_(options), model_(model) {
    if (model != nullptr) scene_.emplace(*model, program);
    options_.budget = budget_.part();
    options_.task = options.task.value_or(default_task(arm));
    options_.suggest = false;
    recover_clearance_ = std::exchange(options_.recover_clearance, 0);
    succeed();
  }

  ProgramMotion run(const std::optional<Configuration>& start) {
    if (plan(start)) return motion_;
    ProgramMotion failure;
    failure.status = motion_.status;
    failure.reason = motion_.reason;
    failure.failed = motion_.failed;
    failure.limit_margin = failure.inverse_condition = 0;
    return failure;
  }

 private:
  /// Fails in a move. The reason contains the name of the move or, if given, the name of its part.
  bool fail(std::size_t move, MotionStatus status, Reason reason, const std::string& name = {}) {
    motion_.status = status;
    motion_.reason = std::move(reason);
    motion_.reason.set(ReasonField::move, move + 1);
    motion_.reason.set(ReasonField::move_name, name.empty() ? move_name(program_, move) : name);
    motion_.failed = move;
    return false;
  }

  /// Forgets why the branches before this one are not possible.
  bool succeed() {
    motion_.status = MotionStatus::reached;
    motion_.reason = {};
    motion_.failed = program_.moves.size();
    return true;
  }

  bool fail_ended(std::size_t move) {
    const Ending ending = budget_.complete() ? motion_.search_ending : budget_.ending();
    return fail(move, status_of<MotionStatus>(ending), ended_reason(ReasonCode::ended, ending));
  }

  /// Fails in a joint motion without times.
  bool fail_untimed(std::size_t move, const Reason& reason) {
    return budget_.complete() ? fail(move, MotionStatus::outside_limits, reason) : fail_ended(move);
  }

  bool plan(const std::optional<Configuration>& start) {
    if (start) starts_outside(arm_, *start, options_.recover);
    const Move& first = program_.moves.front();
    if (!start) check_begins(program_);
    const Pose begin = start ? forward_kinematics(arm_, nearest_within_limits(arm_, *start))
                             : waypoint_of(arm_, first);
    parts_ = program_parts(arm_, program_, start ? 0 : 1, begin, options_.tool_speed);
    std::optional<Configuration> q = start ? start : first.q;
    std::optional<PathMotion> ahead;
    while (!q && !begin_at(begin, q, ahead)) {
      if (!make_blends_smaller()) return false;
    }
    trajectory_.begin(arm_, *q, options_.interpolation, options_.rate);
    arrive(0);
    const Reason reason = trajectory_.recover(arm_, timing_options(options_), budget_);
    if (reason) return fail_untimed(0, reason);
    if (!start) {
      motion_.moves.push_back({});
      if (!pause(0)) return false;
    }
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      budget_.report(static_cast<double>(p) / static_cast<double>(parts_.size()));
      if (budget_.ended()) return fail_ended(parts_[p].first);
      if (!add_part(p, ahead)) return false;
    }
    return finish();
  }

  /// Appends the motion of a part. Where a path is refused before anything is appended, tries again
  /// with smaller blends between its lines.
  bool add_part(std::size_t p, std::optional<PathMotion>& ahead) {
    const std::size_t end = trajectory_.last();
    while (parts_[p].joint ? !add_joint_motion(p, ahead) : !add_path(p, ahead)) {
      if (trajectory_.last() != end || !make_blends_smaller()) return false;
      ahead.reset();
    }
    return true;
  }

  /// Makes the blends smaller that may be why the last path is refused; false if there are none.
  bool make_blends_smaller() {
    return !budget_.ended() && line_blends_.make_smaller(program_, options_.tool_speed, parts_) &&
           succeed();
  }

  /// Sets q to a configuration at which the motion begins, with the tool at the pose of the first
  /// move, and plans the path after it.
  bool begin_at(const Pose& pose, std::optional<Configuration>& q,
                std::optional<PathMotion>& ahead) {
    const Configuration middle = middle_configuration(arm_);
    const bool path = !parts_.empty() && !parts_.front().joint;
    if (program_.moves.front().kind == MoveKind::around) {
      return begin_free(configurations_in_scene(pose, middle), path, q, ahead) ||
             (!motion_.reason && solution_at(0, pose, middle, q));
    }
    if (!path) return configuration_at(0, pose, middle, q);
    if (!follow(0, std::nullopt, ahead)) return false;
    q = ahead->trajectory.positions.front();
    return true;
  }

  std::vector<Configuration> configurations_in_scene(const Pose& pose, const Configuration& from) {
    return configurations_for(arm_, *options_.task, pose, from, budget_.part(), scene_->blocked());
  }

  /// Sets q to the first of some configurations that is free and from which the path after it is.
  bool begin_free(std::vector<Configuration> candidates, bool path, std::optional<Configuration>& q,
                  std::optional<PathMotion>& ahead) {
    const Reason blocked = scene_->erase_blocked(candidates);
    if (blocked) fail(0, status_of_blocked(blocked), blocked);
    for (const Configuration& candidate : candidates) {
      if (path && !follow_free(0, candidate, ahead)) continue;
      q = candidate;
      return succeed();
    }
    return false;
  }

  /// Sets q to the configuration with the tool at the pose that is reached soonest.
  bool configuration_at(std::size_t move, const Pose& pose, const Configuration& from,
                        std::optional<Configuration>& q) {
    const auto found = configurations_for(arm_, *options_.task, pose, from, budget_.part());
    if (!found.empty()) q = found.front();
    return q || solution_at(move, pose, from, q);
  }

  /// Sets q to the solution of a search with all means, or fails with the reason why there is none.
  bool solution_at(std::size_t move, const Pose& pose, const Configuration& from,
                   std::optional<Configuration>& q) {
    const InverseResult found = solution_for(arm_, *options_.task, pose, from, budget_.part());
    if (found) q = found.solutions.front();
    return found || fail(move, motion_status(found.status), found.reason);
  }

  /// Plans the path of a part.
  bool follow(std::size_t p, const std::optional<Configuration>& q,
              std::optional<PathMotion>& ahead) {
    const ProgramPart& part = parts_[p];
    ahead = motion_along(arm_, q, part.route, options_);
    if (*ahead) {
      line_blends_.accept();
      return true;
    }
    line_blends_.refuse(p, refused_blends(arm_, part, *ahead,
                                          {options_.tolerance, options_.orientation_tolerance}));
    ProgramRefusal why = path_refusal(program_, part, *ahead);
    return fail(why.move, why.status, std::move(why.reason), why.name);
  }

  /// Plans the path of a part, which must keep the clearance.
  bool follow_free(std::size_t p, const Configuration& q, std::optional<PathMotion>& ahead) {
    if (!follow(p, q, ahead)) return false;
    const Reason reason = scene_->blocked_ahead(parts_[p], *ahead, budget_.part());
    return !reason ||
           fail(parts_[p].first, status_of_blocked(reason), reason, part_name(program_, parts_[p]));
  }

  /// Whether a branch of the path of part p begins at a configuration.
  bool has_branch(std::size_t p, const Configuration& q) {
    BranchOptions planning = branch_options(arm_, options_, 1);
    planning.max_grid = 16;
    planning.reasons = BranchOptions::Reasons::none;
    planning.budget = budget_.part();
    return bool(plan_path(arm_, q, parts_[p].route.path, planning));
  }

  /// Finds the configuration reached first of those from which the path of part p is possible.
  bool choose_branch(std::size_t p, const Configuration& from, std::optional<Configuration>& q,
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

  bool path_follows(std::size_t p) const { return p + 1 < parts_.size() && !parts_[p + 1].joint; }

  bool add_joint_motion(std::size_t p, std::optional<PathMotion>& ahead) {
    ahead.reset();
    const std::size_t i = parts_[p].first;
    PlannedMove planned{.begin = trajectory_.last()};
    const bool around = program_.moves[i].kind == MoveKind::around;
    if (!(around ? move_around_to(p, planned, ahead) : move_straight_to(p, ahead))) return false;
    trajectory_.stop();
    planned.end = trajectory_.last();
    motion_.moves.push_back(std::move(planned));
    return pause(i);
  }

  /// Appends the straight joint motion of part p, and plans the path after it.
  bool move_straight_to(std::size_t p, std::optional<PathMotion>& ahead) {
    const std::size_t i = parts_[p].first;
    const Move& move = program_.moves[i];
    const Configuration from = trajectory_.positions().back();
    std::optional<Configuration> to = move.q;
    if (!to && !(path_follows(p) ? choose_branch(p + 1, from, to, ahead)
                                 : configuration_at(i, move.target, from, to))) {
      return false;
    }
    RetimeOptions timing = timing_options(options_);
    timing.tool_speed = move.speed.value_or(options_.tool_speed);
    timing.budget = budget_.part();
    const Reason reason = trajectory_.joint_move(arm_, *to, timing);
    return !reason || fail_untimed(i, reason);
  }

  /// Configurations at which the move around obstacles of part p may end, the soonest reached
  /// first. Fails if a path follows and all solutions of an arm that is not redundant are blocked.
  std::vector<Configuration> goals_around(std::size_t p) {
    const std::size_t i = parts_[p].first;
    const Move& move = program_.moves[i];
    if (move.q) return {*move.q};
    const Configuration from = trajectory_.positions().back();
    std::vector<Configuration> goals = configurations_in_scene(move.target, from);
    std::optional<Configuration> q;
    if (goals.empty() && solution_at(i, move.target, from, q)) goals.push_back(*q);
    if (!path_follows(p)) return goals;
    std::vector<Configuration> free = goals;
    const Reason blocked = scene_->erase_blocked(free);
    std::optional<PathMotion> ahead;
    std::erase_if(goals, [&](const auto& goal) { return !has_branch(p + 1, goal); });
    if (goals.empty() && follow(p + 1, std::nullopt, ahead)) {
      goals.push_back(ahead->trajectory.positions.front());
    }
    const bool all_blocked = blocked && free.empty() && !is_redundant(arm_, *options_.task);
    if (!all_blocked || goals.empty()) return goals;
    fail(i, status_of_blocked(blocked), blocked);
    return {};
  }

  /// Takes the next goals of a move around obstacles out of `goals`: all, or a few from which the
  /// path after it is possible and free, with the motions along this path.
  std::vector<Configuration> next_goals(std::size_t p, std::vector<Configuration>& goals,
                                        std::vector<PathMotion>& paths) {
    paths.clear();
    constexpr std::size_t few = 4;
    std::vector<Configuration> next;
    if (!path_follows(p)) return std::exchange(goals, {});
    std::optional<PathMotion> ahead;
    std::size_t examined = 0;
    while (examined < goals.size() && next.size() < few && !budget_.ended()) {
      const Configuration& goal = goals[examined++];
      if (!follow_free(p + 1, goal, ahead)) continue;
      next.push_back(goal);
      paths.push_back(std::move(*ahead));
    }
    goals.erase(goals.begin(), goals.begin() + static_cast<std::ptrdiff_t>(examined));
    return next;
  }

  /// Appends the motion of part p around obstacles, and plans the path after it.
  bool move_around_to(std::size_t p, PlannedMove& planned, std::optional<PathMotion>& ahead) {
    const std::size_t i = parts_[p].first;
    std::vector<Configuration> left = goals_around(p);
    std::vector<PathMotion> paths;
    FreeMotionOptions options = free_motion_options(options_);
    options.tool_speed = program_.moves[i].speed.value_or(options_.tool_speed);
    if (i == 0) options.recover_clearance = recover_clearance_;
    std::optional<FreeMotion> failed;  // the search for the soonest goals
    while (!left.empty() && !budget_.ended()) {
      const std::vector<Configuration> goals = next_goals(p, left, paths);
      if (goals.empty()) continue;
      const Configuration& from = trajectory_.positions().back();
      FreeMotion motion = move_around(scene_->model(), from, goals, options);
      if (!motion) {
        if (!failed) failed = std::move(motion);
        continue;
      }
      if (path_follows(p)) ahead = std::move(paths[motion.path.goal]);
      trajectory_.append(motion.trajectory);
      planned.waypoints = std::move(motion.path.waypoints);
      return succeed();
    }
    if (budget_.ended()) return fail_ended(i);
    return failed ? fail(i, failed->status, failed->reason) : false;
  }

  /// Attaches and detaches parts after this number of moves.
  void arrive(std::size_t moves) {
    if (scene_) scene_->arrive(moves, trajectory_.positions().back());
  }

  /// Adds the dwell of move i.
  bool pause(std::size_t i) {
    arrive(i + 1);
    const Reason reason = trajectory_.dwell(program_.moves[i].dwell);
    return !reason || fail(i, MotionStatus::too_many_samples, reason);
  }

  bool add_path(std::size_t p, std::optional<PathMotion>& ahead) {
    const ProgramPart& part = parts_[p];
    if (!ahead && !follow(p, trajectory_.positions().back(), ahead)) return false;
    motion_.limit_margin = std::min(motion_.limit_margin, ahead->limit_margin);
    motion_.inverse_condition = std::min(motion_.inverse_condition, ahead->inverse_condition);
    const std::size_t begin = trajectory_.last();
    std::vector<double> path_parameters{ahead->path_parameters.front()};
    std::size_t k = 0;
    for (std::size_t i = part.first; i <= part.last; ++i) {
      PlannedMove planned{.begin = trajectory_.last(),
                          .blend_radius = part.blend_radii[i - part.first]};
      if (program_.moves[i].blend > 0) {
        const bool full = part.blend_scales[i - part.first] == 1;
        planned.blend = full ? BlendOutcome::full : BlendOutcome::smaller;
        if (part.route.stops[part.last_segment(i)]) planned.blend = BlendOutcome::stop;
      }
      for (const std::size_t end = ahead->arrivals[part.last_segment(i)]; k < end;) {
        trajectory_.append(ahead->trajectory, ++k);
        // A rest before it is at the same path parameter.
        path_parameters.resize(trajectory_.last() - begin, path_parameters.back());
        path_parameters.push_back(ahead->path_parameters[k]);
      }
      if (part.route.stops[part.last_segment(i)]) trajectory_.stop();
      planned.end = trajectory_.last();
      motion_.moves.push_back(planned);
      if (!pause(i)) return false;
      path_parameters.resize(trajectory_.last() - begin + 1, path_parameters.back());
    }
    planned_.push_back({p, begin, std::move(path_parameters)});
    ahead.reset();
    return true;
  }

  /// Completes the trajectory and its proof. A motion whose blends the budget ended keeps its
  /// stops, unless it is cancelled.
  bool finish() {
    motion_.trajectory = trajectory_.finished();
    const Completion completion =
        complete_program({arm_, program_, options_, parts_, model_}, planned_, budget_, motion_);
    const auto& why = completion.refusal;
    const bool ended = !completion.proved && !why;
    if (ended || budget_.ending() == Ending::cancelled)
      return fail_ended(program_.moves.size() - 1);
    return completion.proved || fail(why->move, why->status, why->reason, why->name);
  }

  const Arm& arm_;
  const Program& program_;
  BudgetMeter budget_;
  PathMotionOptions options_;
  const CollisionModel* model_;
  double recover_clearance_ = 0;  ///< of a first move around obstacles
  ProgramMotion motion_;
  std::vector<ProgramPart> parts_;
  LineBlends line_blends_;
  ProgramTrajectory trajectory_;
  std::optional<CurrentScene> scene_ = std::nullopt;
  std::vector<PlannedPart> planned_;
};

}  // namespace

ProgramMotion planned_program(const Arm& arm, const std::optional<Configuration>& start,
                              const Program& program, const PathMotionOptions& options,
                              const CollisionModel* model) {
  return ProgramPlanner(arm, program, options, model).run(start);
}

}  // namespace beeline::internal
