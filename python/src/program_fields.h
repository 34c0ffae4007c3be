#pragma once

#include <beeline/planning/program.h>

#include "planning_fields.h"

namespace beeline::python {

template <>
inline std::vector<MoveKind> choices() {
  return {MoveKind::joint, MoveKind::line, MoveKind::screw, MoveKind::arc, MoveKind::spline};
}

template <>
struct Fields<Move> {
  static constexpr const char* name = "Move";
  static constexpr const char* doc =
      "A move from the waypoint before it to its own, where the tool is at rest unless the move "
      "blends into the next one or both are part of one spline.";
  static constexpr std::size_t required = 1;
  static constexpr auto all() {
    return std::tuple(
        field("kind", &Move::kind, "`joint`: a straight line in joint space; else of the tool."),
        field("target", &Move::target, "The waypoint, world_T_tool, (4, 4)."),
        field("q", &Move::q,
              "The waypoint of a joint move as a configuration, which replaces `target`."),
        field("via", &Move::via, "A position on the arc, m, (3,)."),
        field("speed", &Move::speed,
              "Limit of the tool origin's speed, m/s; None: that of the options."),
        field("blend", &Move::blend,
              "Max deviation of the blend with the next move, m, and 5 rad for each metre; 0: "
              "none. Both moves must be lines."),
        field("dwell", &Move::dwell, "Time at rest at the waypoint, s."),
        field("place", &Move::place, "Where the move is written, for messages: pick.csv:5."));
  }
};

template <>
struct Fields<Program> {
  static constexpr const char* name = "Program";
  static constexpr const char* doc = "The moves of an arm in order, such as those of a whole pick.";
  static constexpr std::size_t required = 1;
  static constexpr auto all() { return std::tuple(field("moves", &Program::moves, "In order.")); }
};

template <>
struct Fields<PlannedMove> {
  static constexpr const char* name = "PlannedMove";
  static constexpr const char* doc = "The part of a trajectory that is one move.";
  static constexpr auto all() {
    return std::tuple(
        field("begin", &PlannedMove::begin, "Its first sample."),
        field("end", &PlannedMove::end,
              "The sample at its waypoint or, if it blends into the next move, at the blend's end "
              "or the first after it. A dwell follows."),
        field("bound", &PlannedMove::bound, "Proved deviation from its path; 0 for a joint move."),
        field("tool_speed", &PlannedMove::tool_speed,
              "A bound on the speed of the tool's origin, m/s."),
        field("blend_radius", &PlannedMove::blend_radius,
              "The part of both lines that the blend replaces, m."));
  }
};

template <>
struct Fields<ProgramMotion> {
  static constexpr const char* name = "ProgramMotion";
  static constexpr const char* doc =
      "A trajectory of a program, with its proof. Only status, reason and failed are set unless "
      "reached.";
  static constexpr const char* truth = "True if reached.";
  static constexpr auto all() {
    return std::tuple(
        field("status", &ProgramMotion::status, "`reached`, or why not."),
        field("reason", &ProgramMotion::reason,
              "One sentence that names the move; empty when reached."),
        field("failed", &ProgramMotion::failed,
              "The move at which it ends; the number of moves if it is none."),
        field("trajectory", &ProgramMotion::trajectory, "From rest to rest."),
        field("moves", &ProgramMotion::moves, "One for each of the program."),
        field("deviation", &ProgramMotion::deviation, "Of all moves but joint moves, proved."),
        field("limits", &ProgramMotion::limits, "Of the trajectory."),
        field("limit_margin", &ProgramMotion::limit_margin,
              "Smallest distance of a joint to a position limit, as a fraction of half its range."),
        field("inverse_condition", &ProgramMotion::inverse_condition,
              "Smallest inverse condition number of the task's Jacobian, from 0 to 1."));
  }
};

}  // namespace beeline::python
