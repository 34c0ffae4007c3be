#include <algorithm>
#include <cmath>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/internal/program_parts.h>
#include <beeline/planning/internal/program_trajectory.h>
#include <beeline/planning/program.h>
#include <beeline/trajectory/internal/end_velocity.h>
#include <beeline/trajectory/internal/interval_polynomial.h>
#include <beeline/trajectory/internal/tool_speed.h>

namespace beeline {

using namespace internal;

namespace {

constexpr double rest_distance = 1e-5;       // radians or metres from the arrival's configuration
constexpr double dwell_rounding = 2e-9;      // seconds
constexpr double speed_rounding = 1 + 1e-6;  // of a limit of the tool's speed

std::string sample_prefix(double time, std::size_t k) {
  return "at " + number(time) + " s, sample " + std::to_string(k + 1) + ": ";
}

/// Proves the parts of a program one after the other. Each begins at the sample at which the one
/// before it ends.
class ProgramVerifier {
 public:
  ProgramVerifier(const Arm& arm, const Trajectory& trajectory, const Program& program,
                  const VerifyOptions& options)
      : arm_(arm), trajectory_(trajectory), program_(program), options_(options) {
    task_ = options.task.value_or(default_task(arm));
    options_.task = task_;
    for (const Configuration& q : trajectory.positions) {
      tool_.push_back(forward_kinematics(arm, q));
    }
    result_.deviation.interval_bounds.resize(trajectory.size() - 1);
  }

  Verification run() {
    const Move& first = program_.moves.front();
    // A joint move may change the configuration at the same pose.
    const bool begins = first.kind != MoveKind::joint && offset(first, 0) <= 1;
    if (begins) result_.arrivals.push_back(0);
    const Pose begin = begins ? waypoint_of(arm_, first) : tool_.front();
    parts_ = program_parts(arm_, program_, begins ? 1 : 0, begin, Limits::none);
    bool passed = !begins || check_dwell(0);
    for (std::size_t p = 0; p < parts_.size() && passed; ++p) {
      const bool last = p + 1 == parts_.size();
      passed = parts_[p].joint ? check_joint_move(p, last) : check_path(p, last);
    }
    if (passed && parts_.empty()) check_rest(0);
    const auto joint = first_joint_fault(arm_, trajectory_, options_.moving, options_.budget);
    if (!options_.budget.part_of->complete()) {
      const Ending ending = options_.budget.part_of->ending();
      end(ending,
          ended_by(ending) + " before the whole trajectory was checked" + how_to_continue(ending));
    }
    if (joint && (result_.fault == Fault::none || joint->sample <= result_.sample)) {
      fail(joint->kind, joint->sample, joint->reason);
    }
    return result_;
  }

 private:
  bool fail(Fault fault, std::size_t k, const std::string& reason) {
    result_.fault = fault;
    result_.sample = k;
    result_.time = trajectory_.times[k];
    result_.reason = sample_prefix(result_.time, k) + reason;
    return false;
  }

  double offset(const Pose& goal, std::size_t k) const {
    const Deviation away = task_deviation(task_, goal, tool_[k]);
    return std::max(away.position / options_.tolerance,
                    away.orientation / options_.orientation_tolerance);
  }

  /// The distance of sample k from a waypoint, as a fraction of the tolerance.
  double offset(const Move& move, std::size_t k) const {
    if (!move.q) return offset(move.target, k);
    double largest = 0;
    for (int i = 0; i < arm_.dof(); ++i) {
      const bool slides = kind(arm_.joint_of(i)) == JointKind::prismatic;
      const double tolerance = slides ? options_.tolerance : options_.orientation_tolerance;
      largest = std::max(largest, std::abs(trajectory_.positions[k][i] - (*move.q)[i]) / tolerance);
    }
    return largest;
  }

  /// Whether the joints are at rest at sample k, to the tolerance of first_joint_fault() for the
  /// ends, which it checks itself.
  bool rests_at(std::size_t k) const {
    if (k == 0 || k + 1 == trajectory_.size()) return true;
    const auto slow = [&](const Configuration& change, double h) {
      for (int i = 0; i < arm_.dof(); ++i) {
        const double largest = rest_velocity(trajectory_, motion_limits(arm_.limits(i)), h);
        if (!(std::abs(change[i]) <= largest)) return false;
      }
      return true;
    };
    if (!trajectory_.velocities.empty()) return slow(trajectory_.velocities[k], 0);
    const auto slow_after = [&](std::size_t first) {
      const double h = trajectory_.times[first + 1] - trajectory_.times[first];
      return slow((trajectory_.positions[first + 1] - trajectory_.positions[first]) / h, h);
    };
    return slow_after(k - 1) && slow_after(k);
  }

  /// Whether the joints rest from sample k to the next, at the waypoint of a move that ends at
  /// sample `at`.
  bool rests_after(std::size_t k, const Move& move, std::size_t at) const {
    if (offset(move, k) > 1 || offset(move, k + 1) > 1) return false;
    const double h = trajectory_.times[k + 1] - trajectory_.times[k];
    for (int i = 0; i < arm_.dof(); ++i) {
      const Polynomial p = interval_polynomial(trajectory_, k, i);
      const Extremes q = enclosure(p), v = enclosure(time_derivative(p, 1, h));
      const double goal = trajectory_.positions[at][i];
      const double largest = rest_velocity(trajectory_, motion_limits(arm_.limits(i)), h);
      const bool near = q.smallest >= goal - rest_distance && q.largest <= goal + rest_distance;
      if (!near || !(v.smallest >= -largest && v.largest <= largest)) return false;
    }
    return true;
  }

  /// Consecutive samples within tolerance of a waypoint.
  struct Visit {
    std::size_t nearest = 0, end = 0;                   ///< `end`: after the last
    std::optional<std::size_t> resting = std::nullopt;  ///< the nearest at rest
  };

  /// The first visit from sample k on.
  std::optional<Visit> next_visit(const Move& move, std::size_t k) const {
    const std::size_t size = trajectory_.size();
    while (k < size && !(offset(move, k) <= 1)) ++k;
    if (k == size) return {};
    Visit visit{.nearest = k};
    double nearest = offset(move, k), resting = 2;
    for (double here = nearest; k < size && here <= 1; here = ++k < size ? offset(move, k) : 2) {
      if (here < nearest) visit.nearest = k, nearest = here;
      if (here < resting && rests_at(k)) visit.resting = k, resting = here;
    }
    visit.end = k;
    return visit;
  }

  /// The sample from `first` on at which the arm is at the waypoint of a move: that at rest of the
  /// first visit that has one; if there is none, the nearest of the first visit. `leaves`: the arm
  /// leaves the waypoint before.
  std::optional<std::size_t> arrival(const Move& move, std::size_t first, bool leaves) const {
    std::optional<std::size_t> passed;
    while (leaves && first < trajectory_.size() && offset(move, first) <= 1) ++first;
    for (auto visit = next_visit(move, first); visit; visit = next_visit(move, visit->end)) {
      if (visit->resting) return visit->resting;
      if (!passed) passed = visit->nearest;
    }
    return passed;
  }

  /// The next move that stops away from the waypoint of a joint move; moves.size() if all stand
  /// still there, none if a path or a joint move returns to it before.
  std::optional<std::size_t> next_elsewhere(std::size_t move) const {
    const Pose here = waypoint_of(arm_, program_.moves[move]);
    for (std::size_t i = move + 1; i < program_.moves.size(); ++i) {
      if (is_passed(program_, i)) continue;
      const Deviation away = task_deviation(task_, waypoint_of(arm_, program_.moves[i]), here);
      if (!within(away, {options_.tolerance, options_.orientation_tolerance})) return i;
      if (program_.moves[i].kind != MoveKind::line || is_passed(program_, i - 1)) return {};
    }
    return program_.moves.size();
  }

  /// arrival() of a joint move. One to a pose may begin at this pose, or pass it at rest, and end
  /// there in another configuration: it ends at the last visit before the next waypoint.
  std::optional<std::size_t> joint_arrival(std::size_t i) const {
    const Move& move = program_.moves[i];
    std::optional<std::size_t> found = arrival(move, begin_, false);
    const auto next = move.q || !found ? std::nullopt : next_elsewhere(i);
    if (!next) return found;
    std::size_t until = trajectory_.size();
    if (*next < program_.moves.size()) {
      const auto reached = arrival(program_.moves[*next], *found, false);
      if (!reached || !rests_at(*reached)) return found;
      until = *reached;
    }
    for (auto visit = next_visit(move, *found); visit; visit = next_visit(move, visit->end)) {
      if (visit->nearest >= until) break;
      if (visit->resting && *visit->resting < until && visit->nearest > *found)
        found = visit->resting;
    }
    return found;
  }

  /// Checks that the arm is at rest where move i ends.
  bool check_stop(std::size_t i) {
    const std::size_t at = result_.arrivals.back();
    if (rests_at(at)) return true;
    return fail(Fault::moving, at,
                "the arm passes the waypoint of " + move_name(program_, i) +
                    ", where it has to be at rest");
  }

  bool fail_to_reach(std::size_t move) {
    const std::size_t last = trajectory_.size() - 1;
    const Deviation away =
        task_deviation(task_, waypoint_of(arm_, program_.moves[move]), tool_[last]);
    return fail(Fault::not_through, last,
                "the waypoint of " + move_name(program_, move) +
                    " is not reached; at the end the tool is " + deviation_text(away) + " from it");
  }

  /// Checks the dwell of the move that ends at the last arrival, and sets `begin_` to its end.
  bool check_dwell(std::size_t move) {
    const std::size_t at = result_.arrivals.back();
    begin_ = at;
    const Move& goal = program_.moves[move];
    const double dwell = goal.dwell;
    if (dwell == 0) return true;
    std::size_t from = at;
    while (from > 0 && rests_after(from - 1, goal, at)) --from;
    // Not beyond the dwell: the arm may rest longer, and moves slowly at first.
    const auto rested = [&] { return trajectory_.times[begin_] - trajectory_.times[from]; };
    while (rested() < dwell - dwell_rounding && begin_ + 1 < trajectory_.size() &&
           rests_after(begin_, goal, at)) {
      ++begin_;
    }
    if (rested() >= dwell - dwell_rounding) return true;
    return fail(Fault::dwell, at,
                "the arm is at rest for " + number(rested()) + " s at the waypoint of " +
                    move_name(program_, move) + ", not for " + number(dwell) + " s");
  }

  bool check_speed(std::size_t move, std::size_t from, std::size_t to) {
    return check_speed(move, from, to, program_.moves[move].speed);
  }

  bool check_speed(std::size_t move, std::size_t from, std::size_t to,
                   const std::optional<double>& limit) {
    if (!limit || from >= to) return true;
    const double speed = tool_speed_bound(arm_, samples_between(trajectory_, from, to));
    if (speed <= *limit * speed_rounding) return true;
    return fail(Fault::tool_speed, from,
                "on " + move_name(program_, move) + " the tool's speed is up to " + number(speed) +
                    " m/s, above " + number(*limit) + " m/s");
  }

  /// The sample before those from `from` to `at` that are within tolerance of the pose.
  std::size_t before_near(const Pose& pose, std::size_t from, std::size_t at) const {
    while (at > from && offset(pose, at - 1) <= 1) --at;
    return at > from ? at - 1 : at;
  }

  /// The sample after those from `at` to `to` that are within tolerance of the pose.
  std::size_t after_near(const Pose& pose, std::size_t at, std::size_t to) const {
    while (at < to && offset(pose, at + 1) <= 1) ++at;
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
    if (!check_speed(i, from, before) || !check_speed(i, before, after, larger)) return {};
    return after;
  }

  /// Checks that the joints rest at the waypoint of the last move from `begin_` to the end.
  bool check_rest(std::size_t move) {
    const std::size_t at = result_.arrivals.back();
    for (std::size_t k = begin_; k + 1 < trajectory_.size(); ++k) {
      if (rests_after(k, program_.moves[move], at)) continue;
      return fail(Fault::not_through, k, "the arm leaves the last waypoint");
    }
    return true;
  }

  bool check_joint_move(std::size_t p, bool last) {
    const std::size_t move = parts_[p].first;
    const auto end = joint_arrival(move);
    if (!end) return fail_to_reach(move);
    result_.arrivals.push_back(*end);
    return check_speed(move, begin_, *end) && check_stop(move) && check_dwell(move) &&
           (!last || check_rest(move));
  }

  bool check_path(std::size_t p, bool last_part) {
    const ProgramPart& part = parts_[p];
    std::size_t begin = 0;
    for (std::size_t i = 0; i < part.route.stops.size(); ++i) {
      if (!part.route.stops[i]) continue;
      const bool last = last_part && i + 1 == part.route.stops.size();
      if (!check_stretch(part, begin, i, last)) return false;
      begin = i + 1;
    }
    return true;
  }

  /// The segments of a part from one stop to the next.
  static Route stretch_of(const ProgramPart& part, std::size_t first, std::size_t last) {
    const auto slice = [&](const auto& all) {
      const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
      return std::decay_t<decltype(all)>(begin,
                                         begin + static_cast<std::ptrdiff_t>(last - first) + 1);
    };
    const ToolPath& path = part.route.path;
    return {{slice(path.segments), slice(path.spans), slice(path.names)}, slice(part.route.stops)};
  }

  bool check_stretch(const ProgramPart& part, std::size_t first, std::size_t last, bool to_end) {
    const Route route = stretch_of(part, first, last);
    const Pose goal = pose_at(route.path.segments.back(), 1);
    // Lines of which blends leave nothing have no segment.
    const std::size_t move = last + 1 < part.moves.size() ? part.moves[last + 1] - 1 : part.last;
    const bool moves =
        std::any_of(route.path.segments.begin(), route.path.segments.end(),
                    [&](const Segment& segment) { return !stands_still(segment, task_); });
    const bool closed = within(task_deviation(task_, goal, pose_at(route.path, 0)),
                               {options_.tolerance, options_.orientation_tolerance});
    const bool loops = closed && moves && route.path.segments.size() > 1;
    const auto end = arrival({.target = goal}, begin_, loops);
    if (!end) return fail_to_reach(move);
    VerifyOptions options = options_;
    options.moving = {options_.moving.start && begin_ == 0, options_.moving.end && to_end};
    const std::size_t until = to_end ? trajectory_.size() - 1 : *end;
    const Verification found =
        verify(arm_, samples_between(trajectory_, begin_, until), route, options);
    if (!add(found)) return false;
    std::size_t from = begin_;
    for (std::size_t i = result_.arrivals.size(); i <= move; ++i) {
      const std::size_t segment = part.last_segment(i);  // before `first` if the line has none left
      const std::size_t reached = begin_ + (segment < first ? 0 : found.arrivals[segment - first]);
      result_.arrivals.push_back(reached);
      if (i == move || segment < first) {
        if (!check_speed(i, from, reached)) return false;
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
    if (found) return true;
    if (found.fault == Fault::none) return end(found.ending, found.reason);
    const std::size_t prefix = sample_prefix(found.time, found.sample).size();
    return fail(found.fault, begin_ + found.sample, found.reason.substr(prefix));
  }

  bool end(Ending ending, const std::string& reason) {
    result_.ending = ending;
    if (result_.fault == Fault::none) result_.reason = reason;
    return false;
  }

  const Arm& arm_;
  const Trajectory& trajectory_;
  const Program& program_;
  VerifyOptions options_;
  Task task_;
  std::vector<Pose> tool_ = {};  // at the samples
  std::vector<ProgramPart> parts_ = {};
  std::size_t begin_ = 0;  // the sample at which the next part begins
  Verification result_ = {};
};

}  // namespace

Verification verify(const Arm& arm, const Trajectory& given, const Program& program,
                    const VerifyOptions& options) {
  check_program(arm, program);
  const Trajectory trajectory = matched_to(arm, given);
  if (trajectory.size() == 0) throw Error("the trajectory has no samples");
  BudgetMeter budget(options.budget);
  VerifyOptions shared = options;
  shared.budget = budget.part();
  return ProgramVerifier(arm, trajectory, program, shared).run();
}

}  // namespace beeline
