#include <algorithm>
#include <cmath>

#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/tool_plane.h>
#include <beeline/path/blend.h>
#include <beeline/planning/internal/attachments.h>
#include <beeline/planning/internal/program_parts.h>
#include <beeline/trajectory/internal/tool_speed.h>

namespace beeline::internal {
namespace {

constexpr double max_dwell = 1e6;  // seconds

void check_count(const Program& program) {
  if (program.moves.size() <= max_moves) return;
  throw Error("the program has " + std::to_string(program.moves.size()) + " moves; at most " +
              std::to_string(max_moves) + " are accepted: split it");
}

void check_numbers(const Move& move) {
  if (move.speed && !(*move.speed >= slowest_tool && std::isfinite(*move.speed))) {
    throw Error("speed must be at least " + number(slowest_tool) + " m/s, not " +
                number(*move.speed));
  }
  if (!(move.blend >= 0) || !std::isfinite(move.blend)) {
    throw Error("blend must be 0 m or more, not " + number(move.blend));
  }
  if (!(move.dwell >= 0 && move.dwell <= max_dwell)) {
    throw Error("dwell must be from 0 s to 1e+06 s, not " + number(move.dwell));
  }
}

void check_kind(const Arm& arm, const Program& program, std::size_t i) {
  const Move& move = program.moves[i];
  if (move.q && !is_joint_motion(move.kind)) {
    throw Error("only joint motions end at joint values");
  }
  if (move.q) {
    check_configuration(arm, *move.q);
    const auto outside = limit_violations(arm, *move.q);
    if (!outside.empty()) throw Error(sentence(outside.front()));
  }
  if (move.via.has_value() != (move.kind == MoveKind::arc)) {
    throw Error(move.via ? "only arcs have a via position" : "an arc needs a via position");
  }
  if (move.blend == 0) return;
  const auto can_blend = [](MoveKind kind) {
    return kind == MoveKind::line || kind == MoveKind::joint;
  };
  if (!can_blend(move.kind) || i + 1 == program.moves.size() ||
      !can_blend(program.moves[i + 1].kind)) {
    throw Error("a blend must be between lines or moves `joint`");
  }
  if (move.dwell > 0) throw Error("a dwell and a blend at one waypoint exclude each other");
}

/// Moves from one stop to the next, or from one sharp corner to the next.
struct ProgramSection {
  Route route;
  std::vector<std::size_t> moves;  ///< of each segment, 0 for the first move
  std::vector<double> blend_radii;
};

ProgramSection blended_section(const Program& program, std::size_t i,
                               const std::vector<Pose>& poses) {
  std::vector<Deviation> within;
  for (std::size_t k = 0; k + 2 < poses.size(); ++k) {
    within.push_back(blend_deviation(program.moves[i + k]));
  }
  BlendedPath blended = blended_lines(poses, within);
  ProgramSection section{route_of(blended), std::move(blended.lines), {}};
  for (const Blend& blend : blended.blends) section.blend_radii.push_back(blend.radius);
  return section;
}

ProgramSection section_through(const Program& program, std::size_t i, std::vector<Pose> poses) {
  const Move& move = program.moves[i];
  if (move.kind == MoveKind::line && poses.size() > 2) return blended_section(program, i, poses);
  if (move.kind == MoveKind::line) {
    return {route_of(lines_through(poses), PathKind::line), {0}, {}};
  }
  if (move.kind == MoveKind::arc) {
    poses.insert(poses.begin() + 1, poses.back());
    poses[1].translation() = *move.via;
  }
  const PathKind kind = path_kind_named(name(move.kind));
  ProgramSection section{route_of(path_through(poses, kind), kind), {}, {}};
  for (std::size_t k = 0; k < section.route.path.segments.size(); ++k) section.moves.push_back(k);
  return section;
}

constexpr double identical = 1e-12;  // metres

/// Refuses repeated waypoints of a path that needs different ones. Only a single line may have
/// length 0.
void check_distinct(const Program& program, std::size_t i, const std::vector<Pose>& poses) {
  const Move& move = program.moves[i];
  if (move.kind == MoveKind::line && poses.size() == 2) return;
  for (std::size_t k = 1; k < poses.size(); ++k) {
    if (!repeats(poses[k], poses[k - 1])) continue;
    throw MoveError(program, i + k - 1, "the waypoint is the same as the one before it");
  }
  for (const Pose& end : poses) {
    if (!move.via || (end.translation() - *move.via).norm() > identical) continue;
    throw MoveError(program, i, "the via position is also the position of a waypoint");
  }
}

/// Appends the moves from move i up to the next stop, with the tool at `from`; returns the next.
std::size_t add_section(const Program& program, std::size_t i, Pose& from, double tool_speed,
                        ProgramPart& part) {
  std::vector<Pose> poses{from, program.moves[i].target};
  std::size_t last = i;
  // A line without length has no blend: the tool stops.
  const auto stops = [&] {
    return program.moves[last].kind == MoveKind::line &&
           (repeats(poses[poses.size() - 2], poses.back()) ||
            repeats(poses.back(), program.moves[last + 1].target));
  };
  while (continues_path(program, last) && !stops()) {
    poses.push_back(program.moves[++last].target);
  }
  check_distinct(program, i, poses);
  ProgramSection section;
  try {
    section = section_through(program, i, poses);
  } catch (const Error& error) {
    throw MoveError(program, last, error.what());
  }
  Route& route = part.route;
  section.blend_radii.resize(last - i + 1, 0);
  for (std::size_t k = 0; k < section.moves.size(); ++k) {
    const std::size_t move = i + section.moves[k];
    const Segment& segment = section.route.path.segments[k];
    const bool blends = program.moves[move].kind == MoveKind::line &&
                        std::holds_alternative<SplineSegment>(segment);
    route.path.segments.push_back(segment);
    route.path.spans.push_back(section.route.path.spans[k]);
    route.path.names.push_back((blends ? "the blend after " : "") + move_name(program, move));
    route.stops.push_back(section.route.stops[k] || k + 1 == section.moves.size());
    route.speeds.push_back(program.moves[move].speed.value_or(tool_speed));
    part.moves.push_back(move);
  }
  part.blend_radii.insert(part.blend_radii.end(), section.blend_radii.begin(),
                          section.blend_radii.end());
  from = program.moves[last].target;
  return last + 1;
}

}  // namespace

std::size_t ProgramPart::last_segment(std::size_t move) const {
  const auto next = std::upper_bound(moves.begin(), moves.end(), move);
  return static_cast<std::size_t>(next - moves.begin()) - 1;
}

std::string part_name(const Program& program, const ProgramPart& part) {
  if (part.first == part.last) return move_name(program, part.first);
  return "moves " + std::to_string(part.first + 1) + " to " + std::to_string(part.last + 1);
}

void check_move(const Arm& arm, const Program& program, std::size_t i) {
  check_numbers(program.moves[i]);
  check_kind(arm, program, i);
}

/// Throws Error for a waypoint or a via position outside the plane.
void check_move_in_plane(const ToolPlane& plane, const Move& move) {
  if (!move.q) plane.check(move.target, "the waypoint");
  if (move.via && !plane.contains(*move.via)) throw plane.error("the via position");
}

void check_program(const Arm& arm, const Program& program, const std::optional<Task>& task,
                   double recover) {
  if (recover != 0) throw Error("recover is for paths; a program starts within the limits");
  if (program.moves.empty()) throw Error("a program needs moves");
  check_count(program);
  const std::optional<ToolPlane> plane = ToolPlane::required(arm, task);
  for (std::size_t i = 0; i < program.moves.size(); ++i) {
    try {
      check_move(arm, program, i);
      if (plane) check_move_in_plane(*plane, program.moves[i]);
    } catch (const Error& error) {
      throw MoveError(program, i, error.what());
    }
  }
  check_attachments(program);
}

bool continues_path(const Program& program, std::size_t i) {
  return is_passed(program, i) && !is_joint_motion(program.moves[i].kind) &&
         !is_joint_motion(program.moves[i + 1].kind);
}

bool blends_with_joint_move(const Program& program, std::size_t i) {
  return is_passed(program, i) && !continues_path(program, i);
}

Deviation blend_deviation(const Move& move) { return {move.blend, move.blend / metres_per_radian}; }

bool is_passed(const Program& program, std::size_t i) {
  const Move& move = program.moves[i];
  if (i + 1 == program.moves.size()) return false;
  const bool spline =
      move.kind == MoveKind::spline && program.moves[i + 1].kind == MoveKind::spline;
  return move.blend > 0 || (spline && move.dwell == 0);
}

Pose waypoint_of(const Arm& arm, const Move& move) {
  return move.q ? forward_kinematics(arm, *move.q) : move.target;
}

std::vector<ProgramPart> program_parts(const Arm& arm, const Program& program, std::size_t first,
                                       const Pose& begin, double tool_speed) {
  std::vector<ProgramPart> parts;
  Pose from = begin;
  for (std::size_t i = first; i < program.moves.size();) {
    ProgramPart part{.first = i, .last = i};
    if (is_joint_motion(program.moves[i].kind)) {
      part.joint = true;
      from = waypoint_of(arm, program.moves[i]);
      ++i;
    }
    while (!part.joint && i < program.moves.size() && !is_joint_motion(program.moves[i].kind)) {
      i = add_section(program, i, from, tool_speed, part);
    }
    part.last = i - 1;
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace beeline::internal
