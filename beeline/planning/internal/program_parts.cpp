#include <algorithm>
#include <cmath>

#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/tool_plane.h>
#include <beeline/path/blend.h>
#include <beeline/path/internal/scaled_blends.h>
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
  if (continues_path(program, i)) check_blend_tolerance(blend_deviation(move));
}

/// Moves from one stop to the next, or from one sharp corner to the next.
struct ProgramSection {
  Route route;
  std::vector<std::size_t> moves;  ///< of each segment, 0 for the first move
  std::vector<Blend> blends;       ///< of each move, as far as they have one
};

/// `scales` has the scales of the moves from move i on.
ProgramSection blended_section(const Program& program, std::size_t i,
                               const std::vector<Pose>& poses, std::span<const double> scales) {
  std::vector<Deviation> within;
  for (std::size_t k = 0; k + 2 < poses.size(); ++k) {
    within.push_back(blend_deviation(program.moves[i + k]));
  }
  BlendedPath blended = scaled_blends(poses, within, scales.first(within.size()));
  Route route = route_of(blended);
  return {std::move(route), std::move(blended.lines), std::move(blended.blends)};
}

ProgramSection section_through(const Program& program, std::size_t i, std::vector<Pose> poses,
                               std::span<const double> scales) {
  const Move& move = program.moves[i];
  if (move.kind == MoveKind::line && poses.size() > 2) {
    return blended_section(program, i, poses, scales);
  }
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

/// Refuses repeated waypoints of a path that needs different ones. Lines may have length 0.
void check_distinct(const Program& program, std::size_t i, const std::vector<Pose>& poses) {
  const Move& move = program.moves[i];
  if (move.kind == MoveKind::line) return;
  for (std::size_t k = 1; k < poses.size(); ++k) {
    if (!repeats(poses[k], poses[k - 1])) continue;
    throw MoveError(program, i + k - 1, "the waypoint is the same as the one before it");
  }
  for (const Pose& end : poses) {
    if (!move.via || (end.translation() - *move.via).norm() > identical) continue;
    throw MoveError(program, i, "the via position is also the position of a waypoint");
  }
}

/// The waypoints from `from`, before move i, up to the next stop. Lines without length have no
/// blend at the beginning and at the end of a path: the tool stops.
std::vector<Pose> poses_to_stop(const Program& program, std::size_t i, const Pose& from) {
  const auto target = [&](std::size_t move) { return program.moves[move].target; };
  std::vector<Pose> poses{from, target(i)};
  const bool lines = program.moves[i].kind == MoveKind::line;
  if (lines && passed_as_one(poses[1], poses[0])) return poses;
  const auto stays_from = [&](std::size_t move) {
    for (std::size_t k = move; continues_path(program, k); ++k) {
      if (!passed_as_one(target(k + 1), target(move))) return false;
    }
    return true;
  };
  for (std::size_t last = i; continues_path(program, last) && !(lines && stays_from(last));) {
    poses.push_back(target(++last));
  }
  return poses;
}

/// The scales of the moves from move i to move `last`. Of a waypoint that lines pass as one the
/// first move has the smallest one from there on.
std::vector<double> scales_of(const Program& program, std::size_t i, std::size_t last,
                              std::span<const double> scales) {
  std::vector<double> own(last - i + 1, 1);
  if (!scales.empty()) std::copy_n(scales.begin(), own.size(), own.begin());
  for (std::size_t k = own.size() - 1; k-- > 0;) {
    const bool as_one = passed_as_one(program.moves[i + k + 1].target, program.moves[i + k].target);
    if (as_one) own[k] = std::min(own[k], own[k + 1]);
  }
  return own;
}

/// Appends the moves from move i up to the next stop, with the tool at `from`; returns the next.
/// `scales` has the scales of the moves from move i on; without any they are 1.
std::size_t add_section(const Program& program, std::size_t i, Pose& from, double tool_speed,
                        std::span<const double> scales, ProgramPart& part) {
  const std::vector<Pose> poses = poses_to_stop(program, i, from);
  const std::size_t last = i + poses.size() - 2;
  check_distinct(program, i, poses);
  const std::vector<double> own = scales_of(program, i, last, scales);
  ProgramSection section;
  try {
    section = section_through(program, i, poses, own);
  } catch (const Error& error) {
    throw MoveError(program, last, error.what());
  }
  Route& route = part.route;
  section.blends.resize(own.size());
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
  for (const Blend& blend : section.blends) part.blend_radii.push_back(blend.radius);
  part.blend_scales.insert(part.blend_scales.end(), own.begin(), own.end());
  from = program.moves[last].target;
  return last + 1;
}

/// A part of lines and other paths from move `first` on. `scales` has the scales of its moves.
ProgramPart path_part(const Program& program, std::size_t first, Pose& from, double tool_speed,
                      std::span<const double> scales) {
  ProgramPart part{.first = first, .last = first};
  std::size_t i = first;
  while (i < program.moves.size() && !is_joint_motion(program.moves[i].kind)) {
    const auto rest = scales.empty() ? scales : scales.subspan(i - first);
    i = add_section(program, i, from, tool_speed, rest, part);
  }
  part.last = i - 1;
  return part;
}

}  // namespace

std::size_t ProgramPart::first_segment(std::size_t move) const {
  const auto here = std::lower_bound(moves.begin(), moves.end(), move);
  return static_cast<std::size_t>(here - moves.begin());
}

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

void check_program(const Arm& arm, const Program& program, const std::optional<Task>& task) {
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

void check_begins(const Program& program) {
  const Move& first = program.moves.front();
  const std::string begins = "the motion begins at this waypoint, as no start is given; ";
  if (!is_joint_motion(first.kind) && first.kind != MoveKind::line) {
    throw MoveError(program, 0, begins + "its move must be a joint motion or a line");
  }
  if (first.speed || first.blend > 0) {
    throw MoveError(program, 0, begins + "remove its speed or blend");
  }
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
  for (std::size_t i = first; i < program.moves.size(); i = parts.back().last + 1) {
    if (is_joint_motion(program.moves[i].kind)) {
      parts.push_back({.first = i, .last = i, .joint = true});
      from = waypoint_of(arm, program.moves[i]);
    } else {
      parts.push_back(path_part(program, i, from, tool_speed, {}));
    }
  }
  return parts;
}

ProgramPart with_blend_scales(const Program& program, const ProgramPart& part, double tool_speed,
                              std::span<const double> scales) {
  Pose from = pose_at(part.route.path, 0);
  return path_part(program, part.first, from, tool_speed, scales);
}

}  // namespace beeline::internal
