#include "line_report.h"

#include <algorithm>
#include <fmt/format.h>

#include <beeline/error.h>

#include "format.h"
#include "json_reason.h"
#include "recover_argument.h"

namespace beeline::command {
namespace {

/// Whether the motion has a path of the tool, of which the margins are measured.
bool has_path(const LineReport& report) {
  const std::vector<Move>& moves = report.program.moves;
  return moves.empty() || std::any_of(moves.begin(), moves.end(),
                                      [](const Move& move) { return !is_joint_motion(move.kind); });
}

std::string margins_text(const LineReport& report) {
  if (!has_path(report)) return "";
  return fmt::format(
      "margins       {} of a joint's half range to its limits, inverse condition number {} (1 is "
      "best, 0 singular)\n",
      percent(report.limit_margin), condition_text(report.inverse_condition));
}

std::string motion_text(const Arm& arm, const LineReport& report, const UnitArgument& unit) {
  std::string text = fmt::format("samples       {} in {} s\n", report.trajectory.size(),
                                 shown(report.trajectory.times.back()));
  if (report.planned) {
    return text + recovery_text(arm, report.recovery, unit) +
           deviation_text(report.deviation, report.trajectory.interpolation(), unit,
                          report.recovery) +
           limits_text(report.limits) + margins_text(report);
  }
  return text +
         fmt::format("control       {}, overshoot {} of a line\n", counted(report.steps, "step"),
                     percent(report.overshoot)) +
         deviation_text(report.deviation, report.trajectory.interpolation(), unit) +
         limits_text(report.limits) + start_jump_text(arm, report.start_jump, unit);
}

/// The seconds from the end of move i to the next one, or to the end.
double pause_after(const LineReport& report, std::size_t i) {
  const auto& t = report.trajectory.times;
  const bool last = i + 1 == report.moves.size();
  return (last ? t.back() : t[report.moves[i + 1].begin]) - t[report.moves[i].end];
}

double duration_of(const LineReport& report, std::size_t i) {
  const auto& t = report.trajectory.times;
  return t[report.moves[i].end] - t[report.moves[i].begin];
}

/// Returns the outcome of the blend of a move with the next one, with its radius.
std::string blend_text(const PlannedMove& planned) {
  if (planned.blend == BlendOutcome::none) return "";
  if (planned.blend == BlendOutcome::stop) return "   stops in place of its blend";
  const bool joint = planned.joint_blend_radius > 0;
  if (!joint && planned.blend_radius == 0) return "";  // straight on, or in the next blend
  return fmt::format("   {}blend of {}{}", planned.blend == BlendOutcome::smaller ? "smaller " : "",
                     shown(joint ? planned.joint_blend_radius : planned.blend_radius),
                     joint ? " in joint space" : " m");
}

/// Returns the reason for which the search for blends with joint moves ended before its end.
Reason search_reason(const LineReport& report) {
  return {ReasonCode::ended, {{ReasonField::ending, report.search_ending}}};
}

/// Says that the budget ended the search for blends with joint moves.
std::string search_text(const LineReport& report) {
  if (report.search_ending == Ending::complete) return "";
  return fmt::format("blends        {}; the arm stops where no blend was proved by then\n",
                     sentence(search_reason(report)));
}

/// A line for each move.
std::string moves_text(const LineReport& report, const UnitArgument& unit) {
  std::string text =
      fmt::format("moves   motion    seconds     at rest     tool speed      proved deviation\n");
  for (std::size_t i = 0; i < report.moves.size(); ++i) {
    const Move& move = report.program.moves[i];
    const PlannedMove& planned = report.moves[i];
    std::string bound = "joints move in proportion";
    if (move.kind == MoveKind::around) bound = "around obstacles";
    if (!is_joint_motion(move.kind)) {
      bound = fmt::format("{:.2e} m   {:.2e} {}", rounded_up(planned.bound.position, 3),
                          rounded_up(unit.shown(planned.bound.orientation), 3), unit.name());
    }
    text += fmt::format(
        "  {:>4}  {:<8}  {:<10}  {:<10}  {:<14}  {}   {}{}\n", i + 1, name(move.kind),
        shown(duration_of(report, i)), shown(pause_after(report, i)),
        fmt::format("{:.4g} m/s", planned.tool_speed), bound, move.place, blend_text(planned));
  }
  return text;
}

Json json_moves(const LineReport& report, const UnitArgument& unit) {
  Json moves = Json::list();
  for (std::size_t i = 0; i < report.moves.size(); ++i) {
    const PlannedMove& planned = report.moves[i];
    Json move{{"motion", name(report.program.moves[i].kind)},
              {"place", report.program.moves[i].place},
              {"begin", planned.begin + 1},
              {"end", planned.end + 1},
              {"duration", duration_of(report, i)},
              {"dwell", pause_after(report, i)},
              {"tool_speed", planned.tool_speed},
              {"deviation_bound", planned.bound.position},
              {"orientation_bound", unit.shown(planned.bound.orientation)}};
    if (planned.blend != BlendOutcome::none) {
      move.add("blend", name(planned.blend));
      move.add("blend_radius", planned.blend_radius);
      move.add("joint_blend_radius", planned.joint_blend_radius);
    }
    moves.append(move);
  }
  return moves;
}

/// The values as --from takes them, so that they read back exactly.
std::string exact_values(const Configuration& q) {
  std::string text;
  for (const double value : q) text += (text.empty() ? "" : ",") + fmt::format("{}", value);
  return text;
}

/// A line for each branch that is not given.
std::string blocked_text(const Arm& arm, const std::vector<BlockedBranch>& blocked,
                         const UnitArgument& unit) {
  std::string text;
  for (const BlockedBranch& branch : blocked) {
    text += fmt::format("blocked       --from={}: {}\n",
                        exact_values(unit.shown(arm, branch.start)), sentence(branch.reason));
  }
  return text;
}

Json json_blocked(const Arm& arm, const std::vector<BlockedBranch>& blocked,
                  const UnitArgument& unit) {
  Json list = Json::list();
  for (const BlockedBranch& branch : blocked) {
    Json one{{"start", unit.shown(arm, branch.start)},
             {"status", name(branch.status)},
             {"path_parameter", branch.path_parameter}};
    one.add(json_reason(branch.reason));
    list.append(one);
  }
  return list;
}

}  // namespace

std::string reason_text(const LineReport& report) {
  const bool refused = report.clearance && !report.clearance->proof;
  std::string text = refused ? report.clearance->reason_text() : sentence(report.reason);
  if (!report.options.empty()) text += " (" + listed(report.options) + ")";
  if (report.positions == PositionFrame::work) text += "; positions are in the frame of --work";
  if (report.positions == PositionFrame::world) text += "; positions are in the world";
  return text;
}

std::string report_text(const Arm& arm, const LineReport& report, const UnitArgument& unit,
                        const ResultFiles& files) {
  const std::string noun = report.program.moves.empty() ? "waypoint" : "move";
  std::string text =
      fmt::format("{}: {}, method {}\n", name(report.status),
                  counted(static_cast<std::int64_t>(report.waypoints), noun), report.method);
  for (const NearbyPath& nearby : report.nearby) {
    text += fmt::format("would work    {}", nearby.description);
    if (nearby.start) text += ": --from=" + exact_values(unit.shown(arm, *nearby.start));
    text += '\n';
  }
  if (report.status == MotionStatus::reached) {
    text += motion_text(arm, report, unit) +
            (report.moves.empty() ? "" : moves_text(report, unit)) + search_text(report);
  }
  if (report.clearance) text += report.clearance->text();
  text += blocked_text(arm, report.blocked, unit);
  if (report.status == MotionStatus::reached) text += files.text();
  if (report.branches) text += branches_text(arm, *report.branches, unit);
  return text;
}

Json report_document(const Arm& arm, const LineReport& report, const UnitArgument& unit,
                     const ResultFiles& files) {
  const bool reached = report.status == MotionStatus::reached;
  Json document{
      {"status", name(report.status)}, {"method", report.method}, {"waypoints", report.waypoints}};
  document.add(deviation_members(reached ? std::optional(report.deviation) : std::nullopt, unit));
  document.add("samples", report.trajectory.size());
  document.add("duration", reached ? Json(report.trajectory.times.back()) : nullptr);
  document.add("reason", reason_text(report));
  document.add(reason_members(report.reason));
  if (!report.options.empty()) document.add("options", report.options);
  if (report.clearance) {
    document.add("clearance", report.clearance->document());
    document.add("blocked", json_blocked(arm, report.blocked, unit));
  }
  if (!reached && report.planned) document.add("path_parameter", report.path_parameter);
  if (!report.moves.empty()) document.add("moves", json_moves(report, unit));
  if (reached && !report.moves.empty()) document.add("search_ending", name(report.search_ending));
  if (!reached && report.failed < report.program.moves.size()) {
    document.add("failed_move", report.failed + 1);
    document.add("failed_place", report.program.moves[report.failed].place);
  }
  if (reached) document.add("limits", json_limits(report.limits));
  if (reached && report.planned) {
    document.add("recovery", json_recovery(arm, report.recovery, unit));
    const bool measured = has_path(report);
    document.add("limit_margin", measured ? Json(report.limit_margin) : Json());
    document.add("inverse_condition", measured ? Json(report.inverse_condition) : Json());
  }
  if (reached && !report.planned) {
    document.add("start_jump", json_start_jump(arm, report.start_jump, unit));
  }
  if (!report.planned) {
    document.add("steps", report.steps);
    document.add("overshoot", report.overshoot);
  }
  Json nearby = Json::list();
  for (const NearbyPath& path : report.nearby) {
    Json one{{"description", path.description},
             {"translation", Eigen::VectorXd(path.translation)},
             {"rotation", Eigen::VectorXd(path.rotation * unit.shown(1.0))}};
    if (path.start) one.add("start", unit.shown(arm, *path.start));
    nearby.append(one);
  }
  if (!report.nearby.empty()) document.add("nearby", nearby);
  if (report.branches) document.add("branches", json_branches(arm, *report.branches, unit));
  if (reached) files.add_to(document);
  return document;
}

}  // namespace beeline::command
