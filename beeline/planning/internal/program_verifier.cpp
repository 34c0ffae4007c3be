#include <beeline/certificate/internal/fault_list.h>
#include <beeline/certificate/internal/set_fault.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/internal/attachments.h>
#include <beeline/planning/internal/program_verifier.h>

namespace beeline::internal {
namespace {

constexpr double dwell_rounding = 2e-9;  // seconds

}  // namespace

ProgramVerifier::ProgramVerifier(const Arm& arm, const Trajectory& trajectory,
                                 const Program& program, const VerifyOptions& options,
                                 BudgetMeter& budget)
    : arm_(arm),
      trajectory_(trajectory),
      program_(program),
      options_(options),
      budget_(budget),
      task_(options.task.value_or(default_task(arm))),
      rests_(arm, trajectory, task_, {options.tolerance, options.orientation_tolerance}),
      passages_(arm, trajectory, task_, rests_.tool(), budget) {
  options_.task = task_;
  options_.budget = budget.part();
  now_.result.deviation.bound = {};
  interval_bounds_.resize(trajectory.size() - 1);
  speed_bounds_.resize(trajectory.size() - 1, Limits::none);
}

Verification ProgramVerifier::run() {
  const Move& first = program_.moves.front();
  Verification& result = now_.result;
  // A joint motion may change the configuration at the same pose.
  result.recovery = accepted_recovery(arm_, trajectory_, options_.recover);
  now_.begin = begin_of_path(result.recovery);
  const bool begins = !is_joint_motion(first.kind) && rests_.offset(first, now_.begin) <= 1;
  if (begins) result.arrivals.push_back(now_.begin);
  const Pose begin = begins ? waypoint_of(arm_, first) : tool_at(now_.begin);
  parts_ = program_parts(arm_, program_, begins ? 1 : 0, begin, Limits::none);
  bool passed = !begins || check_dwell(0);
  while (passed && now_.part < parts_.size()) {
    passed = parts_[now_.part].joint ? check_joint_moves() : check_path();
  }
  if (passed && parts_.empty()) passed = check_rest(0);
  if (passed) check_attachments(program_, trajectory_, rests_, result.arrivals);
  // Last, so that the progress of candidates is copied without them.
  result.deviation.interval_bounds = std::move(interval_bounds_);
  const auto joint = first_joint_fault(arm_, trajectory_, options_.moving, options_.budget,
                                       options_.limit_tolerance, options_.recover);
  if (!budget_.complete()) {
    end(budget_.ending(), ended_reason(ReasonCode::ended_before_check, budget_.ending()));
  }
  std::vector<FaultsOfKind> of_path;
  if (result.fault != Fault::none) {
    add_fault(trajectory_, result.fault, result.sample, 0, result.reason, of_path);
  }
  if (joint && (result.fault == Fault::none || joint->sample <= result.sample)) {
    fail(joint->kind, joint->sample, joint->reason);
  }
  list_faults(arm_, trajectory_, options_, of_path, budget_, result);
  if (!result) result.deviation.bound = no_bound;
  return result;
}

bool ProgramVerifier::fail(Fault fault, std::size_t k, Reason reason) {
  set_fault(trajectory_, fault, k, std::move(reason), now_.result);
  return false;
}

/// Fails at a move.
bool ProgramVerifier::fail(Fault fault, std::size_t k, std::size_t move, Reason reason) {
  reason.set(ReasonField::move, move + 1);
  reason.set(ReasonField::segment_name, move_name(program_, move));
  return fail(fault, k, std::move(reason));
}

bool ProgramVerifier::fail_to_reach(std::size_t move) {
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

bool ProgramVerifier::end(Ending ending, const Reason& reason) {
  now_.result.ending = ending;
  if (now_.result.fault == Fault::none) now_.result.reason = reason;
  return false;
}

/// Checks that the arm is at rest where move i ends.
bool ProgramVerifier::check_stop(std::size_t i) {
  const std::size_t at = now_.result.arrivals.back();
  if (rests_.rests_at(at)) return true;
  return fail(Fault::moving, at, i, {ReasonCode::passes_without_rest});
}

/// Checks the dwell of the move that ends at the last arrival, and sets the beginning of the next
/// to its end. Time at rest that belongs to a dwell before does not count.
bool ProgramVerifier::check_dwell(std::size_t move) {
  const std::size_t at = now_.result.arrivals.back();
  std::size_t& begin = now_.begin;
  begin = at;
  now_.speed_from.reset();
  const Move& goal = program_.moves[move];
  const double dwell = goal.dwell;
  if (dwell == 0) return true;
  std::size_t from = at;
  while (from > 0 && rests_.rests_after(from - 1, goal, at)) --from;
  const double start = std::max(trajectory_.times[from], now_.dwelled_until);
  // Not beyond the dwell: the arm may rest longer, and moves slowly at first.
  const auto rested = [&] { return std::max(0.0, trajectory_.times[begin] - start); };
  while (rested() < dwell - dwell_rounding && begin + 1 < trajectory_.size() &&
         rests_.rests_after(begin, goal, at)) {
    ++begin;
  }
  now_.dwelled_until = start + dwell;
  if (rested() >= dwell - dwell_rounding) return true;
  return fail(Fault::dwell, at, move,
              {ReasonCode::dwell_too_short,
               {{ReasonField::duration, rested()},
                {ReasonField::dwell, dwell},
                {ReasonField::beyond_dwells, start > trajectory_.times[from]}}});
}

/// Checks that the joints rest at the waypoint of the last move to the end.
bool ProgramVerifier::check_rest(std::size_t move) {
  const std::size_t at = now_.result.arrivals.back();
  for (std::size_t k = now_.begin; k + 1 < trajectory_.size(); ++k) {
    if (rests_.rests_after(k, program_.moves[move], at)) continue;
    return fail(Fault::not_through, k, {ReasonCode::leaves_last_waypoint});
  }
  return true;
}

void ProgramVerifier::return_to(Progress saved) {
  now_ = std::move(saved);
  for (std::size_t i = now_.begin; i < bounds_end_; ++i) interval_bounds_[i] = {};
  bounds_end_ = now_.begin;
}

}  // namespace beeline::internal
