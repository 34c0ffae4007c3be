#include <algorithm>
#include <cmath>

#include <beeline/certificate/internal/printed_bound.h>
#include <beeline/certificate/verify.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/internal/enum_names.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/deviation_reason.h>
#include <beeline/planning/branch.h>
#include <beeline/planning/internal/motion_request.h>
#include <beeline/planning/internal/printed_motion.h>
#include <beeline/planning/internal/program_parts.h>
#include <beeline/planning/internal/program_trajectory.h>
#include <beeline/planning/internal/self_motion_starts.h>
#include <beeline/planning/program.h>
#include <beeline/trajectory/internal/motion_start.h>
#include <beeline/trajectory/internal/tool_speed.h>

namespace beeline {

using namespace internal;

namespace {

constexpr internal::EnumNames<MoveKind> move_kinds("motion");

// Configurations for a pose from which the next moves are tried, the soonest reached first: all of
// them for an arm without redundant joints, and some on a coarse grid for one with.
constexpr std::size_t max_candidates = 64, max_redundant_candidates = 12;
constexpr int coarse_grid = 6;

constexpr std::size_t max_trajectory = 10'000'000;  // samples: some 3 GB for seven joints

/// Seconds of a joint move at the velocity limits.
double least_duration(const Arm& arm, const Configuration& from, const Configuration& to) {
  double duration = 0;
  for (int k = 0; k < arm.dof(); ++k) {
    duration = std::max(duration, std::abs(to[k] - from[k]) / velocity_limit_of(arm.limits(k)));
  }
  return duration;
}

/// Configurations with the tool at the pose, the one that is reached soonest first.
std::vector<Configuration> configurations_for(const Arm& arm, const Task& task, const Pose& pose,
                                              const Configuration& from, const Budget& budget) {
  const bool redundant = arm.dof() > task.size();
  InverseOptions options{
      .seed = from, .task = task, .all = true, .every_turn = !redundant, .budget = budget};
  std::vector<Configuration> found;
  if (redundant) {
    options.method = method_for_few_poses(arm, task);
    options.grid = coarse_grid;
    options.max_restarts = 4 * coarse_grid;
    found = inverse_kinematics(
                arm, pose,
                {.seed = from, .task = task, .redundancy = Redundancy::nearest, .budget = budget})
                .solutions;
  }
  const InverseResult all = inverse_kinematics(arm, pose, options);
  found.insert(found.end(), all.solutions.begin(), all.solutions.end());
  std::stable_sort(found.begin(), found.end(), [&](const auto& a, const auto& b) {
    return least_duration(arm, from, a) < least_duration(arm, from, b);
  });
  const std::size_t most = redundant ? max_redundant_candidates : max_candidates;
  if (found.size() > most) found.resize(most);
  return found;
}

/// "move 3 (line)", "moves 3 to 5".
std::string part_name(const Program& program, const ProgramPart& part) {
  if (part.first == part.last) return move_name(program, part.first);
  return "moves " + std::to_string(part.first + 1) + " to " + std::to_string(part.last + 1);
}

class ProgramPlanner {
 public:
  ProgramPlanner(const Arm& arm, const Program& program, const PathMotionOptions& options)
      : arm_(arm), program_(program), budget_(options.budget), options_(options) {
    options_.budget = budget_.part();
    options_.task = options.task.value_or(default_task(arm));
    options_.suggest = false;
    motion_.failed = program.moves.size();
    motion_.status = MotionStatus::reached;
  }

  ProgramMotion run(const std::optional<Configuration>& start) {
    if (!plan(start)) {
      ProgramMotion failure;
      failure.status = motion_.status;
      failure.reason = motion_.reason;
      failure.failed = motion_.failed;
      failure.limit_margin = failure.inverse_condition = 0;
      return failure;
    }
    return motion_;
  }

 private:
  /// A part that is a path, in the trajectory.
  struct Planned {
    std::size_t part = 0, begin = 0;      ///< its first sample
    std::vector<double> path_parameters;  ///< of its samples
  };

  /// Fails in a move. The reason contains the name of the move or, if given, the name of its part.
  bool fail(std::size_t move, MotionStatus status, Reason reason, const std::string& name = {}) {
    motion_.status = status;
    motion_.reason = std::move(reason);
    motion_.reason.set(ReasonField::move, move + 1);
    motion_.reason.set(ReasonField::move_name, name.empty() ? move_name(program_, move) : name);
    motion_.failed = move;
    return false;
  }

  bool fail_ended(std::size_t move) {
    return fail(move, status_of<MotionStatus>(budget_.ending()),
                ended_reason(ReasonCode::ended, budget_.ending()));
  }

  bool plan(const std::optional<Configuration>& start) {
    if (start) check_start(arm_, *start);
    const Move& first = program_.moves.front();
    if (!start && first.kind != MoveKind::joint && first.kind != MoveKind::line) {
      throw MoveError(
          program_, 0,
          "the motion begins at this waypoint, as no start is given; its move must be a joint "
          "move or a line");
    }
    if (!start && (first.speed || first.blend > 0)) {
      throw MoveError(program_, 0,
                      "the motion begins at this waypoint, as no start is given; remove its speed "
                      "or blend");
    }
    const Pose begin = start ? forward_kinematics(arm_, *start) : waypoint_of(arm_, first);
    parts_ = program_parts(arm_, program_, start ? 0 : 1, begin, options_.tool_speed);
    std::optional<Configuration> q = start ? start : first.q;
    const bool open = !q && !parts_.empty() && !parts_.front().joint;
    if (!q && !open && !configuration_at(0, begin, middle_configuration(arm_), q)) return false;
    std::optional<PathMotion> ahead;
    if (open && !follow(0, std::nullopt, ahead)) return false;
    if (open) q = ahead->trajectory.positions.front();
    trajectory_.begin(arm_, *q, options_.interpolation, options_.rate);
    if (!start) {
      motion_.moves.push_back({});
      if (!pause(0)) return false;
    }
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      budget_.report(static_cast<double>(p) / static_cast<double>(parts_.size()));
      if (budget_.ended()) return fail_ended(parts_[p].first);
      if (parts_[p].joint ? !add_joint_move(p, ahead) : !add_path(p, ahead)) return false;
    }
    return finish();
  }

  /// Sets q to the configuration with the tool at the pose that is reached soonest.
  bool configuration_at(std::size_t move, const Pose& pose, const Configuration& from,
                        std::optional<Configuration>& q) {
    const auto found = configurations_for(arm_, *options_.task, pose, from, budget_.part());
    if (!found.empty()) q = found.front();
    if (q) return true;
    InverseResult none = inverse_kinematics(
        arm_, pose, {.seed = from, .task = options_.task, .budget = budget_.part()});
    beeline::explain(none, budget_.part());
    if (none) q = none.solutions.front();
    return none || fail(move, motion_status(none.status), none.reason);
  }

  /// Plans the path of a part.
  bool follow(std::size_t p, const std::optional<Configuration>& q,
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

  /// Finds the configuration reached first of those from which the path of part p is possible.
  bool choose_branch(std::size_t p, const Configuration& from, std::optional<Configuration>& q,
                     std::optional<PathMotion>& ahead) {
    const ToolPath& path = parts_[p].route.path;
    BranchOptions planning = branch_options(arm_, options_, 1);
    planning.max_grid = 16;
    planning.reasons = BranchOptions::Reasons::none;
    planning.budget = budget_.part();
    for (const Configuration& candidate :
         configurations_for(arm_, *options_.task, pose_at(path, 0), from, budget_.part())) {
      if (budget_.ended()) break;
      if (!plan_path(arm_, candidate, path, planning) || !follow(p, candidate, ahead)) continue;
      q = candidate;
      motion_.status = MotionStatus::reached;
      return true;
    }
    if (!follow(p, std::nullopt, ahead)) return false;
    motion_.status = MotionStatus::reached;
    q = ahead->trajectory.positions.front();
    return true;
  }

  bool add_joint_move(std::size_t p, std::optional<PathMotion>& ahead) {
    const std::size_t i = parts_[p].first;
    const Move& move = program_.moves[i];
    const Configuration from = trajectory_.positions().back();
    std::optional<Configuration> to = move.q;
    ahead.reset();
    const bool path_follows = p + 1 < parts_.size() && !parts_[p + 1].joint;
    if (!to && !(path_follows ? choose_branch(p + 1, from, to, ahead)
                              : configuration_at(i, move.target, from, to))) {
      return false;
    }
    RetimeOptions timing = timing_options(options_);
    timing.tool_speed = move.speed.value_or(options_.tool_speed);
    timing.budget = budget_.part();
    PlannedMove planned{.begin = trajectory_.last()};
    if (const Reason reason = trajectory_.joint_move(arm_, *to, timing)) {
      if (!budget_.complete()) return fail_ended(i);
      return fail(i, MotionStatus::outside_limits, reason);
    }
    trajectory_.stop();
    planned.end = trajectory_.last();
    motion_.moves.push_back(planned);
    return pause(i);
  }

  /// Adds the dwell of move i.
  bool pause(std::size_t i) {
    const double dwell = program_.moves[i].dwell;
    const double needed = static_cast<double>(trajectory_.last()) + dwell * options_.rate;
    if (needed > static_cast<double>(max_trajectory)) {
      return fail(i, MotionStatus::too_many_samples,
                  {ReasonCode::program_too_long, {{ReasonField::max_samples, max_trajectory}}});
    }
    trajectory_.dwell(dwell);
    return true;
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

  /// Completes the trajectory and proves it as a whole by verify(), as a check of its file does:
  /// the moves one by one, and that each continues the one before.
  bool finish() {
    motion_.trajectory = trajectory_.finished();
    const Trajectory& trajectory = motion_.trajectory;
    VerifyOptions options = proof_options(options_);
    options.budget = budget_.part();
    Verification found = verify(arm_, trajectory, program_, options);
    if (!budget_.complete()) return fail_ended(program_.moves.size() - 1);
    if (!found) return explain(found);
    motion_.deviation = std::move(found.deviation);
    for (PlannedMove& move : motion_.moves) {
      for (std::size_t k = move.begin; k < move.end; ++k) {
        grow(move.bound, motion_.deviation.interval_bounds[k]);
      }
      move.tool_speed = tool_speed_bound(arm_, samples_between(trajectory, move.begin, move.end));
    }
    motion_.limits = limit_usage(arm_, trajectory, budget_.part());
    return budget_.complete() || fail_ended(program_.moves.size() - 1);
  }

  /// Fails with the reason why the trajectory is not proved: the tool is off the path of a part, a
  /// joint is beyond its limits, or what verify() found.
  bool explain(const Verification& found) {
    for (const Planned& planned : planned_) {
      if (!check_deviation(planned)) return false;
    }
    const Trajectory& trajectory = motion_.trajectory;
    const auto fault = first_joint_fault(arm_, trajectory, {}, budget_.part());
    if (!budget_.complete()) return fail_ended(program_.moves.size() - 1);
    const std::size_t move = move_at(fault ? fault->sample : found.sample);
    if (!fault) return fail(move, MotionStatus::not_proved, found.reason);
    Reason reason = fault->reason;
    reason.set(ReasonField::time, trajectory.times[fault->sample]);
    return fail(move, MotionStatus::outside_limits, std::move(reason));
  }

  /// The move during or before which sample k is.
  std::size_t move_at(std::size_t k) const {
    std::size_t move = 0;
    while (move + 1 < motion_.moves.size() && motion_.moves[move].end <= k) ++move;
    return move;
  }

  /// Whether the tool is proved to stay on the path of a part.
  bool check_deviation(const Planned& planned) {
    const ProgramPart& part = parts_[planned.part];
    const std::size_t end = planned.begin + planned.path_parameters.size() - 1;
    const Deviation bound =
        path_deviation(arm_, samples_between(motion_.trajectory, planned.begin, end),
                       planned.path_parameters, part.route.path, *options_.task, budget_.part())
            .bound;
    if (!budget_.complete()) return fail_ended(part.first);
    if (within(bound, {options_.tolerance, options_.orientation_tolerance})) return true;
    return fail(part.first, MotionStatus::not_proved,
                deviation_reason(ReasonCode::path_not_proved, bound), part_name(program_, part));
  }

  const Arm& arm_;
  const Program& program_;
  BudgetMeter budget_;
  PathMotionOptions options_;
  ProgramMotion motion_;
  std::vector<ProgramPart> parts_;
  ProgramTrajectory trajectory_;
  std::vector<Planned> planned_;
};

}  // namespace

std::string name(MoveKind value) { return move_kinds.of(value); }

MoveKind move_kind_named(std::string_view name) { return move_kinds.named(name); }

std::string move_name(const Program& program, std::size_t i) {
  const Move& move = program.moves.at(i);
  return "move " + std::to_string(i + 1) + " (" + name(move.kind) +
         (move.place.empty() ? "" : ", " + move.place) + ")";
}

std::ostream& operator<<(std::ostream& out, const ProgramMotion& motion) {
  print_motion(out, motion);
  if (!motion) return out;
  out << ", " << motion.moves.size() << (motion.moves.size() == 1 ? " move, " : " moves, ");
  return print_assumed(print_bound(out, motion.deviation.bound), motion.limits);
}

MoveError::MoveError(const Program& program, std::size_t move, const std::string& fault)
    : Error(move_name(program, move) + ": " + fault), move_(move), fault_(fault) {}

ProgramMotion move_program(const Arm& arm, const std::optional<Configuration>& start,
                           const Program& program, const PathMotionOptions& options) {
  check_program(arm, program, options.task);
  if (options.duration) throw Error("duration is for paths; the moves of a program have speeds");
  if (options.blocked_by) throw Error("blocked_by is for paths; a program has one motion");
  return ProgramPlanner(arm, program, options).run(start);
}

}  // namespace beeline
