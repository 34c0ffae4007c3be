#include <algorithm>
#include <cmath>

#include <beeline/certificate/internal/set_fault.h>
#include <beeline/kinematics/internal/deviation_reason.h>
#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/planning/internal/program_checks.h>
#include <beeline/planning/internal/program_trajectory.h>
#include <beeline/planning/internal/waypoint_distance.h>
#include <beeline/trajectory/internal/tool_speed.h>

namespace beeline::internal {
namespace {

constexpr double dwell_rounding = 2e-9;      // seconds
constexpr double speed_rounding = 1 + 1e-6;  // of a limit of the tool's speed
// Of the deviation. The rest is for the motion between samples, whose bound is within the whole.
constexpr double near_fraction = 0.9;

/// The larger of two limits of the tool's speed; none if one of them is not limited.
std::optional<double> larger_of(const std::optional<double>& a, const std::optional<double>& b) {
  return a && b ? std::optional(std::max(*a, *b)) : std::nullopt;
}

}  // namespace

ProgramChecks::ProgramChecks(const Arm& arm, const Trajectory& trajectory, const Program& program,
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
}

bool ProgramChecks::fail(Fault fault, std::size_t k, Reason reason) {
  set_fault(trajectory_, fault, k, std::move(reason), result_);
  return false;
}

bool ProgramChecks::fail(Fault fault, std::size_t k, std::size_t move, Reason reason) {
  reason.set(ReasonField::move, move + 1);
  reason.set(ReasonField::segment_name, move_name(program_, move));
  return fail(fault, k, std::move(reason));
}

bool ProgramChecks::check_stop(std::size_t i) {
  if (rests_.rests_at(result_.arrivals.back())) return true;
  return fail(Fault::moving, result_.arrivals.back(), i, {ReasonCode::passes_without_rest});
}

bool ProgramChecks::fail_to_reach(std::size_t move) {
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

bool ProgramChecks::check_dwell(std::size_t move) {
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

bool ProgramChecks::check_speed(std::size_t move, std::size_t from, std::size_t to,
                                const std::optional<double>& limit) {
  if (!limit || from >= to) return true;
  const double speed = tool_speed_bound(arm_, samples_between(trajectory_, from, to));
  if (speed <= *limit * speed_rounding) return true;
  return fail(
      Fault::tool_speed, from, move,
      {ReasonCode::tool_too_fast, {{ReasonField::speed, speed}, {ReasonField::limit, *limit}}});
}

std::size_t ProgramChecks::before_near(const Pose& pose, std::size_t from, std::size_t at) const {
  while (at > from && rests_.offset(pose, at - 1) <= 1) --at;
  return at > from ? at - 1 : at;
}

std::size_t ProgramChecks::after_near(const Pose& pose, std::size_t at, std::size_t to) const {
  while (at < to && rests_.offset(pose, at + 1) <= 1) ++at;
  return at < to ? at + 1 : at;
}

std::optional<std::size_t> ProgramChecks::check_passing(std::size_t i, const Segment& segment,
                                                        std::size_t from, std::size_t reached,
                                                        std::size_t end) {
  const Pose passed = pose_at(segment, 1);
  const std::size_t before = before_near(passed, from, reached);
  const std::size_t after = after_near(passed, reached, end);
  const auto &limit = program_.moves[i].speed, &next = program_.moves[i + 1].speed;
  if (!check_speed(i, from, before, limit) ||
      !check_speed(i, before, after, larger_of(limit, next))) {
    return {};
  }
  return after;
}

bool ProgramChecks::check_rest(std::size_t move) {
  const std::size_t at = result_.arrivals.back();
  for (std::size_t k = begin_; k + 1 < trajectory_.size(); ++k) {
    if (rests_.rests_after(k, program_.moves[move], at)) continue;
    return fail(Fault::not_through, k, {ReasonCode::leaves_last_waypoint});
  }
  return true;
}

std::optional<NearSamples> ProgramChecks::near_waypoint(std::size_t i, std::size_t from) const {
  const Move& move = program_.moves[i];
  const WaypointDistance distance(arm_, move, task_, blend_tolerance(move));
  const std::size_t end = trajectory_.size();
  double least = Limits::none;
  const auto is_near = [&](std::size_t k) {
    least = distance(trajectory_.positions[k]);
    return least <= near_fraction;
  };
  while (from < end && !is_near(from)) ++from;
  if (from == end) return std::nullopt;
  NearSamples found{from, from};
  for (std::size_t k = from + 1; k < end; ++k) {
    const double before = least;
    if (!is_near(k)) break;
    found.last = k;
    if (least < before) found.nearest = k;
    least = std::min(least, before);
  }
  return found;
}

PassedWaypoint ProgramChecks::part_beside_line(std::size_t i, std::size_t nearest, const Line& line,
                                               bool begins) {
  const Deviation most = blend_tolerance(program_.moves[i]);
  const auto stays_beside = [&](std::size_t k) {
    const Pose tool = tool_at(k);
    const double fraction = nearest_fraction(line, tool, task_);
    return (begins ? fraction <= 0.5 : fraction >= 0.5) &&
           within(internal::deviation_from(line, tool, task_), most);
  };
  std::size_t first = nearest, last = nearest;
  if (begins) {
    while (last + 1 < trajectory_.size() && stays_beside(last + 1)) ++last;
  } else {
    while (first > begin_ && stays_beside(first - 1)) --first;
  }
  std::vector<double> fractions{0};
  for (std::size_t k = first; k <= last; ++k) {
    fractions.push_back(std::max(fractions.back(), nearest_fraction(line, tool_at(k), task_)));
  }
  fractions.erase(fractions.begin());
  const std::vector<Deviation> bounds =
      path_deviation(arm_, samples_between(trajectory_, first, last), fractions,
                     ToolPath{{line}, {span_of(line)}}, task_, budget_.part())
          .interval_bounds;
  const auto follows = [&](std::size_t k) {
    return within(bounds[k - first], {options_.tolerance, options_.orientation_tolerance});
  };
  PassedWaypoint part{.move = i, .begin = first, .end = last};
  if (begins) {
    while (part.end > part.begin && follows(part.end - 1)) --part.end;
  } else {
    while (part.begin < part.end && follows(part.begin)) ++part.begin;
  }
  for (std::size_t k = part.begin; k < part.end; ++k) grow(part.bound, bounds[k - first]);
  return part;
}

bool ProgramChecks::check_blend(const PassedWaypoint& passed, std::size_t end) {
  const auto [i, first, last, bound] = passed;
  const auto &limit = program_.moves[i].speed, &next = program_.moves[i + 1].speed;
  if (!check_speed(i, first, last, larger_of(limit, next))) return false;
  if (!budget_.complete()) {
    result_.ending = budget_.ending();
    result_.reason = ended_reason(ReasonCode::ended_before_check, budget_.ending());
    return false;
  }
  if (!within(bound, blend_tolerance(program_.moves[i]))) {
    return fail(Fault::deviation, first, i, deviation_reason(ReasonCode::blend_not_proved, bound));
  }
  result_.passed.push_back(passed);
  result_.arrivals.push_back(end);
  begin_ = end;
  return true;
}

}  // namespace beeline::internal
