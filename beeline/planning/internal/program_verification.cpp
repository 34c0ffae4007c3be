#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include <beeline/certificate/internal/fault_list.h>
#include <beeline/certificate/internal/path_checks.h>
#include <beeline/certificate/internal/set_fault.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/internal/attachments.h>
#include <beeline/planning/internal/program_parts.h>
#include <beeline/planning/internal/program_trajectory.h>
#include <beeline/planning/internal/waypoint_rests.h>
#include <beeline/planning/program.h>
#include <beeline/trajectory/internal/tool_speed.h>

namespace beeline {

using namespace internal;

namespace {

constexpr double dwell_rounding = 2e-9;      // seconds
constexpr double speed_rounding = 1 + 1e-6;  // of a limit of the tool's speed
constexpr std::size_t max_rests = 16;        // rests at which a move may end

/// Proves the parts of a program one after the other. Each begins at the sample at which the one
/// before it ends.
class ProgramVerifier {
 public:
  ProgramVerifier(const Arm& arm, const Trajectory& trajectory, const Program& program,
                  const VerifyOptions& options, BudgetMeter& budget)
      : arm_(arm),
        trajectory_(trajectory),
        program_(program),
        options_(options),
        budget_(budget),
        task_(options.task.value_or(default_task(arm))),
        rests_(arm, trajectory, task_, {options.tolerance, options.orientation_tolerance}) {
    options_.task = task_;
    options_.budget = budget.part();
    result_.deviation.bound = {};
    interval_bounds_.resize(trajectory.size() - 1);
  }

  Verification run() {
    const Move& first = program_.moves.front();
    // A joint motion may change the configuration at the same pose.
    const bool begins = !is_joint_motion(first.kind) && rests_.offset(first, 0) <= 1;
    if (begins) result_.arrivals.push_back(0);
    const Pose begin = begins ? waypoint_of(arm_, first) : tool_at(0);
    parts_ = program_parts(arm_, program_, begins ? 1 : 0, begin, Limits::none);
    bool passed = !begins || check_dwell(0);
    while (passed && part_ < parts_.size()) {
      passed = parts_[part_].joint ? check_joint_move() : check_path();
    }
    if (passed && parts_.empty()) passed = check_rest(0);
    if (passed) check_attachments(program_, trajectory_, rests_, result_.arrivals);
    // Last, so that the progress of candidates is copied without them.
    result_.deviation.interval_bounds = std::move(interval_bounds_);
    const auto joint = first_joint_fault(arm_, trajectory_, options_.moving, options_.budget,
                                         options_.limit_tolerance);
    if (!budget_.complete()) {
      end(budget_.ending(), ended_reason(ReasonCode::ended_before_check, budget_.ending()));
    }
    std::vector<FaultsOfKind> of_path;
    if (result_.fault != Fault::none) {
      add_fault(trajectory_, result_.fault, result_.sample, 0, result_.reason, of_path);
    }
    if (joint && (result_.fault == Fault::none || joint->sample <= result_.sample)) {
      fail(joint->kind, joint->sample, joint->reason);
    }
    list_faults(arm_, trajectory_, options_, of_path, budget_, result_);
    if (!result_) result_.deviation.bound = no_bound;
    return result_;
  }

 private:
  bool fail(Fault fault, std::size_t k, Reason reason) {
    set_fault(trajectory_, fault, k, std::move(reason), result_);
    return false;
  }

  /// Fails at a move.
  bool fail(Fault fault, std::size_t k, std::size_t move, Reason reason) {
    reason.set(ReasonField::move, move + 1);
    reason.set(ReasonField::segment_name, move_name(program_, move));
    return fail(fault, k, std::move(reason));
  }

  Pose tool_at(std::size_t k) const { return forward_kinematics(arm_, trajectory_.positions[k]); }

  /// Checks that the arm is at rest where move i ends.
  bool check_stop(std::size_t i) {
    if (rests_.rests_at(result_.arrivals.back())) return true;
    return fail(Fault::moving, result_.arrivals.back(), i, {ReasonCode::passes_without_rest});
  }

  bool fail_to_reach(std::size_t move) {
    const std::size_t last = trajectory_.size() - 1;
    const Deviation away =
        task_deviation(task_, waypoint_of(arm_, program_.moves[move]), tool_at(last));
    return fail(Fault::not_through, last,
                {ReasonCode::waypoint_not_reached,
                 {{ReasonField::move, move + 1},
                  {ReasonField::segment_name, "the waypoint of " + move_name(program_, move)},
                  {ReasonField::distance, away.position},
                  {ReasonField::angle, away.orientation}}});
  }

  /// Checks the dwell of the move that ends at the last arrival, and sets `begin_` to its end. Time
  /// at rest that belongs to a dwell before does not count.
  bool check_dwell(std::size_t move) {
    const std::size_t at = result_.arrivals.back();
    begin_ = at;
    const Move& goal = program_.moves[move];
    const double dwell = goal.dwell;
    if (dwell == 0) return true;
    std::size_t from = at;
    while (from > 0 && rests_.rests_after(from - 1, goal, at)) --from;
    const double start = std::max(trajectory_.times[from], dwelled_until_);
    // Not beyond the dwell: the arm may rest longer, and moves slowly at first.
    const auto rested = [&] { return std::max(0.0, trajectory_.times[begin_] - start); };
    while (rested() < dwell - dwell_rounding && begin_ + 1 < trajectory_.size() &&
           rests_.rests_after(begin_, goal, at)) {
      ++begin_;
    }
    dwelled_until_ = start + dwell;
    if (rested() >= dwell - dwell_rounding) return true;
    return fail(Fault::dwell, at, move,
                {ReasonCode::dwell_too_short,
                 {{ReasonField::duration, rested()},
                  {ReasonField::dwell, dwell},
                  {ReasonField::beyond_dwells, start > trajectory_.times[from]}}});
  }

  bool check_speed(std::size_t move, std::size_t from, std::size_t to,
                   const std::optional<double>& limit) {
    if (!limit || from >= to) return true;
    const double speed = tool_speed_bound(arm_, samples_between(trajectory_, from, to));
    if (speed <= *limit * speed_rounding) return true;
    return fail(
        Fault::tool_speed, from, move,
        {ReasonCode::tool_too_fast, {{ReasonField::speed, speed}, {ReasonField::limit, *limit}}});
  }

  /// Returns the sample before the samples from `from` to `at` that are within tolerance of the
  /// pose.
  std::size_t before_near(const Pose& pose, std::size_t from, std::size_t at) const {
    while (at > from && rests_.offset(pose, at - 1) <= 1) --at;
    return at > from ? at - 1 : at;
  }

  /// Returns the sample after the samples from `at` to `to` that are within tolerance of the pose.
  std::size_t after_near(const Pose& pose, std::size_t at, std::size_t to) const {
    while (at < to && rests_.offset(pose, at + 1) <= 1) ++at;
    return at < to ? at + 1 : at;
  }

  /// Checks the speed of move i from sample `from` to `reached`, at the end of a segment which the
  /// tool passes to the next move; returns the sample from which that move's own limit holds. Which
  /// sample is the first of that move is only known to the tolerance.
  std::optional<std::size_t> check_passing(std::size_t i, const Segment& segment, std::size_t from,
                                           std::size_t reached, std::size_t end) {
    const Pose passed = pose_at(segment, 1);
    const std::size_t before = before_near(passed, from, reached);
    const std::size_t after = after_near(passed, reached, end);
    const auto &limit = program_.moves[i].speed, &next = program_.moves[i + 1].speed;
    const std::optional<double> larger =
        limit && next ? std::optional(std::max(*limit, *next)) : std::nullopt;
    if (!check_speed(i, from, before, limit) || !check_speed(i, before, after, larger)) return {};
    return after;
  }

  /// Checks that the joints rest at the waypoint of the last move from `begin_` to the end.
  bool check_rest(std::size_t move) {
    const std::size_t at = result_.arrivals.back();
    for (std::size_t k = begin_; k + 1 < trajectory_.size(); ++k) {
      if (rests_.rests_after(k, program_.moves[move], at)) continue;
      return fail(Fault::not_through, k, {ReasonCode::leaves_last_waypoint});
    }
    return true;
  }

  /// The state from which a further candidate for the end of a move is verified.
  struct Checkpoint {
    Verification result;
    std::size_t part = 0, begin = 0;
    double dwelled_until = 0;
  };

  Checkpoint checkpoint() const { return {result_, part_, begin_, dwelled_until_}; }

  void return_to(Checkpoint saved) {
    result_ = std::move(saved.result);
    part_ = saved.part;
    begin_ = saved.begin;
    dwelled_until_ = saved.dwelled_until;
    for (std::size_t i = begin_; i < bounds_end_; ++i) interval_bounds_[i] = {};
    bounds_end_ = begin_;
  }

  /// Tries the rests at which a move may end one after the other until one passes. If none does,
  /// what failed is the attempt that passed most moves, the first of them.
  template <class Check>
  bool check_candidates(std::span<const std::size_t> rests, const Check& check) {
    const Checkpoint before = checkpoint();
    std::optional<Checkpoint> failed;
    for (const std::size_t end : rests.first(std::min(rests.size(), max_rests))) {
      return_to(before);
      if (check(end)) return true;
      if (result_.ending != Ending::complete) return false;
      if (!failed || result_.arrivals.size() > failed->result.arrivals.size())
        failed = checkpoint();
    }
    return_to(*failed);
    return false;
  }

  /// The rests at which the joint move of part p may end. Before a joint move to another pose, the
  /// last one before that pose comes first, as a joint move may change the configuration at a pose.
  std::vector<std::size_t> joint_rests(std::size_t p) const {
    std::vector<std::size_t> rests = rests_.rests(program_.moves[parts_[p].first], begin_);
    std::sort(rests.begin(), rests.end());
    if (p + 1 == parts_.size() || !parts_[p + 1].joint || rests.empty()) return rests;
    std::vector<std::size_t> next =
        rests_.rests(program_.moves[parts_[p + 1].first], rests.front());
    if (next.empty()) return rests;
    const auto later =
        std::lower_bound(rests.begin(), rests.end(), *std::min_element(next.begin(), next.end()));
    std::reverse(rests.begin(), later);
    return rests;
  }

  /// Checks a joint move, and the path after it: one to a pose may end there at several rests, in
  /// different configurations.
  bool check_joint_move() {
    const std::size_t move = parts_[part_].first;
    std::vector<std::size_t> rests = joint_rests(part_);
    if (rests.empty()) {
      const auto passed = rests_.passes(program_.moves[move], begin_);
      if (!passed) return fail_to_reach(move);
      rests.push_back(*passed);
    }
    return check_candidates(rests, [&](std::size_t end) {
      result_.arrivals.push_back(end);
      if (!check_speed(move, begin_, end, program_.moves[move].speed) || !check_stop(move) ||
          !check_dwell(move)) {
        return false;
      }
      ++part_;
      if (part_ == parts_.size()) return check_rest(move);
      return parts_[part_].joint || check_path();
    });
  }

  bool check_path() {
    const ProgramPart& part = parts_[part_];
    const bool last_part = part_ + 1 == parts_.size();
    std::size_t begin = 0;
    for (std::size_t i = 0; i < part.route.stops.size(); ++i) {
      if (!part.route.stops[i]) continue;
      const bool last = last_part && i + 1 == part.route.stops.size();
      if (!check_section(part, begin, i, last)) return false;
      begin = i + 1;
    }
    ++part_;
    return true;
  }

  /// The segments of a part from one stop to the next.
  static Route section_of(const ProgramPart& part, std::size_t first, std::size_t last) {
    const auto slice = [&](const auto& all) {
      const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
      return std::decay_t<decltype(all)>(begin,
                                         begin + static_cast<std::ptrdiff_t>(last - first) + 1);
    };
    const ToolPath& path = part.route.path;
    return {{slice(path.segments), slice(path.spans), slice(path.names)}, slice(part.route.stops)};
  }

  /// The rests at which a path may end, or where the tool passes its end without one; those that
  /// leave no time for its motion last.
  std::vector<std::size_t> path_rests(const Route& route) const {
    const Pose goal = pose_at(route.path.segments.back(), 1);
    const bool moves =
        std::any_of(route.path.segments.begin(), route.path.segments.end(),
                    [&](const Segment& segment) { return !stands_still(segment, task_); });
    std::vector<std::size_t> rests = rests_.rests({.target = goal}, begin_);
    if (moves && !rests.empty() && rests.front() == begin_) {
      std::rotate(rests.begin(), rests.begin() + 1, rests.end());
    }
    if (!rests.empty()) return rests;
    std::size_t first = begin_;
    const bool closed = within(task_deviation(task_, goal, pose_at(route.path, 0)),
                               {options_.tolerance, options_.orientation_tolerance});
    while (closed && moves && first < trajectory_.size() && rests_.offset(goal, first) <= 1) {
      ++first;
    }
    if (const auto passed = rests_.passes({.target = goal}, first)) rests.push_back(*passed);
    return rests;
  }

  bool check_section(const ProgramPart& part, std::size_t first, std::size_t last, bool to_end) {
    const Route route = section_of(part, first, last);
    // Lines that blends replace completely have no segment.
    const std::size_t move = last + 1 < part.moves.size() ? part.moves[last + 1] - 1 : part.last;
    const std::vector<std::size_t> rests = path_rests(route);
    if (rests.empty()) return fail_to_reach(move);
    // At the end of the program the path is checked to the last sample from any of them.
    return check_candidates(std::span(rests).first(to_end ? 1 : rests.size()),
                            [&](std::size_t end) {
                              return check_section(part, route, {first, move, end, to_end});
                            });
  }

  struct SectionEnd {
    std::size_t first = 0;  ///< segment of the part
    std::size_t move = 0;   ///< its last one
    std::size_t sample = 0;
    bool is_last = false;  ///< of the program
  };

  /// Checks a path from the sample `begin_` to a stop.
  bool check_section(const ProgramPart& part, const Route& route, const SectionEnd& end) {
    const std::size_t first = end.first, move = end.move;
    VerifyOptions options = options_;
    options.moving = {options_.moving.start && begin_ == 0, options_.moving.end && end.is_last};
    const std::size_t until = end.is_last ? trajectory_.size() - 1 : end.sample;
    const Verification found =
        verify(arm_, samples_between(trajectory_, begin_, until), route, options);
    if (!add(found)) return false;
    std::size_t from = begin_;
    for (std::size_t i = result_.arrivals.size(); i <= move; ++i) {
      const std::size_t segment = part.last_segment(i);  // before `first` if the line has none left
      const std::size_t reached = begin_ + (segment < first ? 0 : found.arrivals[segment - first]);
      result_.arrivals.push_back(reached);
      if (i == move || segment < first) {
        if (!check_speed(i, from, reached, program_.moves[i].speed)) return false;
        continue;
      }
      const std::size_t last_sample = begin_ + found.arrivals.back();
      const auto after =
          check_passing(i, route.path.segments[segment - first], from, reached, last_sample);
      if (!after) return false;
      from = *after;
    }
    return check_stop(move) && check_dwell(move);
  }

  /// Adds what was found from sample `begin_` on; returns whether it passed.
  bool add(const Verification& found) {
    PathDeviation& whole = result_.deviation;
    grow(whole.sampled, found.deviation.sampled);
    grow(whole.measured, found.deviation.measured);
    grow(whole.bound, found.deviation.bound);
    const std::vector<Deviation>& bounds = found.deviation.interval_bounds;
    std::copy(bounds.begin(), bounds.end(),
              interval_bounds_.begin() + static_cast<std::ptrdiff_t>(begin_));
    bounds_end_ = std::max(bounds_end_, begin_ + bounds.size());
    if (found) return true;
    if (found.fault == Fault::none) return end(found.ending, found.reason);
    return fail(found.fault, begin_ + found.sample, found.reason);
  }

  bool end(Ending ending, const Reason& reason) {
    result_.ending = ending;
    if (result_.fault == Fault::none) result_.reason = reason;
    return false;
  }

  const Arm& arm_;
  const Trajectory& trajectory_;
  const Program& program_;
  VerifyOptions options_;
  BudgetMeter& budget_;
  Task task_;
  WaypointRests rests_;
  std::vector<ProgramPart> parts_ = {};
  std::size_t part_ = 0;   // the next one
  std::size_t begin_ = 0;  // the sample at which it begins
  double dwelled_until_ = -std::numeric_limits<double>::infinity();  // end of the last dwell, s
  Verification result_ = {};
  std::vector<Deviation> interval_bounds_ = {};  // 0 on joint moves
  std::size_t bounds_end_ = 0;                   // of those that the last attempt wrote
};

}  // namespace

Verification verify(const Arm& arm, const Trajectory& given, const Program& program,
                    const VerifyOptions& options) {
  check_program(arm, program, options.task, options.recover);
  const Trajectory trajectory = matched_to(arm, given);
  if (trajectory.size() == 0) throw Error("the trajectory has no samples");
  BudgetMeter budget(options.budget);
  return ProgramVerifier(arm, trajectory, program, options, budget).run();
}

}  // namespace beeline
