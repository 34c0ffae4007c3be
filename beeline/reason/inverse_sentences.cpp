#include <beeline/reason/reason_text.h>

namespace beeline::internal {
namespace {

using enum ReasonField;

/// The parts of an error that exceed the tolerance: "0.2 m", "0.1 rad (5.73 deg)", or both.
std::string miss(const ReasonText& reason) {
  if (!reason.has(angle)) return reason.number(distance, " m");
  if (!reason.has(distance)) return reason.angle(angle);
  return reason.deviation();
}

std::string outside(const ReasonText& reason) {
  if (!reason.has(value)) return "";
  const bool above = reason.is(is_upper);
  return "; in the nearest one " + reason.joint() + " would be at " + reason.joint_value(value) +
         ", " + reason.joint_value(excess) +
         (above ? " above its upper limit " : " below its lower limit ") +
         reason.joint_value(limit);
}

/// "every solution", with their number and the reason of the first.
std::string blocked(const ReasonText& reason, const std::string& solutions) {
  const std::string first = sentence(reason.required_detail());
  return solutions + " is blocked, " + reason.number(ReasonField::count) +
         " in all; the first: " + first;
}

std::string self_motion_sentence(const ReasonText& reason) {
  return "singular: arm " + reason.text(arm) +
         " can move with the tool at rest, so there are infinitely many solutions" +
         (reason.is(branches_complete)
              ? "; the solution nearest to the seed is given for each branch"
          : reason.is(nearest_to_seed)
              ? "; the solutions given have their free joints nearest to the seed"
              : "; the solutions given are some of them");
}

std::string velocity_sentence(const ReasonText& reason) {
  return (reason.code() == ReasonCode::singular_velocity
              ? "the arm is singular: no joint rates move its tool along "
              : "no joints of the arm move its tool along ") +
         reason.text(direction) + " (" + reason.text(frame) +
         " frame), a part of the velocity; damping gives rates of a velocity near it";
}

std::string infeasible(const ReasonText& reason) {
  switch (reason.code()) {
    case ReasonCode::tilted_off_axes:
      return "the pose is tilted by " + reason.angle(angle) +
             " against every orientation of the tool: all joint axes of arm " + reason.text(arm) +
             " have one direction, about which alone it rotates";
    case ReasonCode::off_plane:
      return "the pose is " + reason.number(distance) + " m off the plane that the tool of arm " +
             reason.text(arm) +
             " never leaves: all axes are normal to it, and no joint moves along them";
    case ReasonCode::fixed_orientation:
      return "the orientation differs by " + reason.angle(angle) +
             " from the tool's, which no joint of arm " + reason.text(arm) + " rotates";
    case ReasonCode::off_slides:
      return "the position is " + reason.number(distance) +
             " m from the nearest that the prismatic joints of arm " + reason.text(arm) +
             " reach, limits ignored";
    default:
      return "";
  }
}

/// What an arm with fewer joints than a pose has conditions can do instead.
std::string fewer_conditions(const ReasonText& reason) {
  if (!reason.has(conditions)) return "";
  constexpr std::size_t of_direction = 5;
  return "; " + reason.number(joints) + " joints meet the " + reason.number(conditions) +
         " conditions of a pose only by chance: ask for fewer, by the task " +
         (reason.count(joints) == of_direction ? "direction, approach:xy or position" : "position");
}

std::string unreachable(const ReasonText& reason) {
  if (reason.code() == ReasonCode::position_unreachable) {
    if (!reason.has(distance)) return "the position is out of reach of arm " + reason.text(arm);
    return "the position is out of reach by " + reason.number(distance) + " m: the tool of arm " +
           reason.text(arm) +
           (reason.is(refined) ? " comes no nearer than " : " was found to come as near as ") +
           point_text(reason.point(nearest));
  }
  return "the tool of arm " + reason.text(arm) +
         (reason.is(has_position) ? " can come to the position, but not with that orientation"
                                  : " cannot take that orientation") +
         (reason.has(angle) ? ": the nearest that was found is off by " + reason.angle(angle)
                            : "") +
         fewer_conditions(reason);
}

}  // namespace

std::string inverse_sentence(const ReasonText& reason) {
  switch (reason.code()) {
    case ReasonCode::all_solutions_outside_limits:
      return "every solution is outside the joint limits" + outside(reason);
    case ReasonCode::solutions_outside_limits:
      return "no solution within the joint limits was found" + outside(reason);
    case ReasonCode::all_solutions_blocked:
      return blocked(reason, "every solution");
    case ReasonCode::solutions_blocked:
      return blocked(reason, "every solution that was found") + "; others may exist";
    case ReasonCode::no_solution_found:
      return "no solution was found" +
             (reason.has(starts) ? " from " + reason.number(starts) + " starts" : "") +
             "; the nearest misses by " + miss(reason) + "; a solution may still exist" +
             fewer_conditions(reason);
    case ReasonCode::no_closed_form_solution:
      return "no solution was found by the closed form, though a numerical search finds one; the "
             "nearest misses by " +
             miss(reason) + "; a solution may still exist";
    case ReasonCode::position_unreachable:
    case ReasonCode::orientation_unreachable:
      return unreachable(reason);
    case ReasonCode::self_motion:
      return self_motion_sentence(reason);
    case ReasonCode::singular_velocity:
    case ReasonCode::too_few_joints:
      return velocity_sentence(reason);
    case ReasonCode::poses_unsolved:
      return reason.number(count) + " of " + reason.number(of) +
             " poses without a solution: their rows are nan";
    case ReasonCode::ended_before_solution:
      return reason.ended() + " before a solution was found; the nearest misses by " +
             miss(reason) + reason.how_to_continue();
    case ReasonCode::ended_before_all_solutions:
      return reason.ended() + " after " + reason.number(count) + " solution(s); others may exist" +
             reason.how_to_continue();
    case ReasonCode::ended_before_best_solution:
      return reason.ended() +
             " before the best solution was known; the one given is the best so far" +
             reason.how_to_continue();
    default:
      return infeasible(reason);
  }
}

}  // namespace beeline::internal
