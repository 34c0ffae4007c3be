#include <algorithm>
#include <span>

#include <beeline/certificate/internal/fault_list.h>
#include <beeline/certificate/internal/path_checks.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/kinematics/forward.h>
#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/planning/internal/attachments.h>
#include <beeline/planning/internal/program_checks.h>
#include <beeline/planning/internal/program_trajectory.h>
#include <beeline/planning/program.h>

namespace beeline {

using namespace internal;

namespace {

constexpr std::size_t max_candidates = 16;  // rests and blends at which a move may end

/// Proves the parts of a program one after the other. Each begins at the sample at which the one
/// before it ends.
class ProgramVerifier : ProgramChecks {
 public:
  ProgramVerifier(const Arm& arm, const Trajectory& trajectory, const Program& program,
                  const VerifyOptions& options, BudgetMeter& budget)
      : ProgramChecks(arm, trajectory, program, options, budget) {
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

  /// Returns the elements of a list one after the other.
  template <class T>
  static auto each_of(std::vector<T> all) {
    return [all = std::move(all), i = std::size_t(0)]() mutable {
      return i < all.size() ? std::optional<T>(all[i++]) : std::nullopt;
    };
  }

  /// Tries the candidates for the end of a move one after the other until one passes. If none does,
  /// what failed is the attempt that passed most moves, the first of them.
  template <class Next, class Check>
  bool check_candidates(std::size_t move, Next next, const Check& check) {
    const Checkpoint before = checkpoint();
    std::optional<Checkpoint> failed;
    for (std::size_t tried = 0; tried < max_candidates; ++tried) {
      const auto candidate = next();
      if (!candidate) break;
      return_to(before);
      if (check(*candidate)) return true;
      if (result_.ending != Ending::complete) return false;
      if (!failed || result_.arrivals.size() > failed->result.arrivals.size())
        failed = checkpoint();
    }
    if (!failed) return fail_to_reach(move);
    return_to(std::move(*failed));
    return false;
  }

  /// Returns the samples nearest to the waypoint of a move, one approach after the other.
  auto each_approach(std::size_t move) const {
    return [this, move, from = begin_]() mutable -> std::optional<std::size_t> {
      const std::optional<NearSamples> near = near_waypoint(move, from);
      if (!near) return std::nullopt;
      from = near->last + 1;
      return near->nearest;
    };
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
    if (blends_after(program_, parts_, part_)) return check_blended_joint_move(move);
    std::vector<std::size_t> rests = joint_rests(part_);
    if (rests.empty()) {
      const auto passed = rests_.passes(program_.moves[move], begin_);
      if (!passed) return fail_to_reach(move);
      rests.push_back(*passed);
    }
    return check_candidates(move, each_of(rests), [&](std::size_t end) {
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

  /// Checks a joint move that blends into the next one, and the path after it.
  bool check_blended_joint_move(std::size_t move) {
    const ProgramPart& next = parts_[part_ + 1];
    return check_candidates(move, each_approach(move), [&](std::size_t nearest) {
      PassedWaypoint passed{.move = move, .begin = nearest, .end = nearest};
      if (!next.joint) {
        const Line& line = std::get<Line>(next.route.path.segments.front());
        passed = part_beside_line(move, nearest, line, true);
      }
      if (!check_speed(move, begin_, passed.begin, program_.moves[move].speed) ||
          !check_blend(passed, passed.end)) {
        return false;
      }
      ++part_;
      return next.joint || check_path();
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

  struct SectionEnd {
    std::size_t first = 0;  ///< segment of the part
    std::size_t move = 0;   ///< its last one
    std::size_t sample = 0;
    bool is_last = false;  ///< of the program
    /// Whether the tool blends from or to a joint motion at its ends.
    bool from_blend = false, to_blend = false;
  };

  bool check_section(const ProgramPart& part, std::size_t first, std::size_t last, bool to_end) {
    Route route = section_of(part, first, last);
    // Lines that blends replace completely have no segment.
    const std::size_t move = last + 1 < part.moves.size() ? part.moves[last + 1] - 1 : part.last;
    const bool to_blend = move == part.last && blends_after(program_, parts_, part_);
    SectionEnd end{.first = first, .move = move, .is_last = to_end};
    end.from_blend = first == 0 && part_ > 0 && blends_after(program_, parts_, part_ - 1);
    if (end.from_blend) {
      Line& line = std::get<Line>(route.path.segments.front());
      line.from = nearest_on(line, tool_at(begin_), task_);
      route.path.spans.front() = span_of(line);
    }
    if (to_blend) return check_path_to_blend(part, route, end);
    const std::vector<std::size_t> rests = path_rests(route);
    if (rests.empty()) return fail_to_reach(move);
    // At the end of the program the path is checked to the last sample from any of them.
    const std::vector<std::size_t> tried(rests.begin(), to_end ? rests.begin() + 1 : rests.end());
    return check_candidates(move, each_of(tried), [&](std::size_t sample) {
      end.sample = sample;
      return check_section(part, route, end);
    });
  }

  /// Checks a section at whose end the tool blends into a joint motion.
  bool check_path_to_blend(const ProgramPart& part, const Route& route, SectionEnd end) {
    const Line& line = std::get<Line>(part.route.path.segments.back());
    end.to_blend = true;
    return check_candidates(end.move, each_approach(end.move), [&](std::size_t nearest) {
      const PassedWaypoint passed = part_beside_line(end.move, nearest, line, false);
      end.sample = passed.begin;
      Route shorter = route;
      Line& last = std::get<Line>(shorter.path.segments.back());
      last.to = nearest_on(last, tool_at(end.sample), task_);
      shorter.path.spans.back() = span_of(last);
      if (!check_section(part, shorter, end)) return false;
      result_.arrivals.pop_back();
      return check_blend(passed, nearest);
    });
  }

  /// Checks a path from the sample `begin_` to a stop.
  bool check_section(const ProgramPart& part, const Route& route, const SectionEnd& end) {
    const std::size_t first = end.first, move = end.move;
    VerifyOptions options = options_;
    options.moving = {end.from_blend || (options_.moving.start && begin_ == 0),
                      end.to_blend || (options_.moving.end && end.is_last)};
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
    return end.to_blend || (check_stop(move) && check_dwell(move));
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

  std::vector<ProgramPart> parts_ = {};
  std::size_t part_ = 0;                         // the next one
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
