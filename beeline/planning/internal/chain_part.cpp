#include <algorithm>

#include <beeline/certificate/internal/path_checks.h>
#include <beeline/kinematics/forward.h>
#include <beeline/path/internal/nearest_on_line.h>
#include <beeline/planning/internal/chain_part.h>
#include <beeline/planning/internal/program_parts.h>
#include <beeline/planning/internal/waypoint_passages.h>

namespace beeline::internal {
namespace {

constexpr double margin = 0.95;  // of the deviation, for the interpolation between samples

/// The line of a segment that the tool follows; none if it is another one or has no length.
std::optional<Line> line_of(const Segment& segment, const Task& task) {
  const Line* const line = std::get_if<Line>(&segment);
  return line != nullptr && !stands_still(segment, task) ? std::optional(*line) : std::nullopt;
}

/// Sets the joint path along lines; returns whether there is one.
bool add_lines(const PlannedProgram& planned, BudgetMeter& budget, ChainPart& part) {
  std::optional<PlannedLines> lines = planned_lines(planned, part.moves, budget);
  if (!lines) return false;
  // A check of the motion knows the lines beside the largest blends between them.
  const ProgramPart largest = with_blend_scales(planned.program, planned.parts[lines->part],
                                                planned.options.tool_speed, {});
  const std::vector<Segment>& segments = largest.route.path.segments;
  part.begin = line_of(segments[largest.first_segment(part.moves.first)], *planned.options.task);
  part.end = line_of(segments[largest.last_segment(part.moves.last)], *planned.options.task);
  const std::vector<double>& ends = lines->limited.tool_speeds.ends;
  part.begin_length = ends.front();
  part.end_length = ends.back() - (ends.size() > 1 ? ends[ends.size() - 2] : 0);
  part.limited = std::move(lines->limited);
  return true;
}

/// Whether a blend leaves or meets a line within its deviation from the waypoint, at the end of the
/// line that it may replace.
bool keeps_line(const PlannedProgram& planned, const Move& move, const Line& line, bool at_end,
                const Configuration& q) {
  const Task& task = *planned.options.task;
  const Pose tool = forward_kinematics(planned.arm, q);
  const double fraction = nearest_fraction(line, tool, task);
  const Deviation most = blend_deviation(move);
  return (at_end ? 1 - fraction : fraction) <= margin * blended_fraction &&
         within(task_deviation(task, waypoint_of(planned.arm, move), tool),
                {margin * most.position, margin * most.orientation});
}

/// Whether a blend is within its deviation from the waypoint and within the joint limits, and the
/// lines beside it are followed up to there.
bool fits(const PlannedProgram& planned, const ChainPart& before, const ChainPart& after,
          double radius) {
  constexpr int samples = 16;  // half of them in the middle half of the blend
  const Arm& arm = planned.arm;
  const Move& move = planned.program.moves[before.moves.last];
  const Pose waypoint = waypoint_of(arm, move);
  const JointPath blend = blend_between(before.limited.path, after.limited.path, radius);
  double nearest = Limits::none;
  for (int i = 1; i < samples; ++i) {
    const Configuration q = path_point(blend, 0, static_cast<double>(i) / samples).q;
    if (!limit_violations(arm, q).empty()) return false;
    if (4 * i < samples || 4 * i > 3 * samples) continue;
    nearest = std::min(nearest, blend_distance(arm, *planned.options.task, move, waypoint, q,
                                               forward_kinematics(arm, q)));
  }
  return nearest <= margin &&
         (!before.end || keeps_line(planned, move, *before.end, true, blend.q[0])) &&
         (!after.begin || keeps_line(planned, move, *after.begin, false, blend.q[1]));
}

}  // namespace

std::optional<ChainPart> chain_part(const PlannedProgram& planned, const MoveRange& moves,
                                    BudgetMeter& budget) {
  const Move& first = planned.program.moves[moves.first];
  ChainPart part{.moves = moves, .joint = is_joint_motion(first.kind)};
  const PlannedMove& move = planned.moves[moves.first];
  if (move.begin == planned.moves[moves.last].end) return std::nullopt;
  if (!part.joint) return add_lines(planned, budget, part) ? std::optional(part) : std::nullopt;
  constexpr double still = 1e-9;  // radians or metres
  const auto& positions = planned.trajectory.positions;
  if ((positions[move.end] - positions[move.begin]).norm() <= still) return std::nullopt;
  part.limited = {straight_path(positions[move.begin], positions[move.end]),
                  first.speed.value_or(planned.options.tool_speed)};
  return part;
}

double largest_radius(const PlannedProgram& planned, const ChainPart& before,
                      const ChainPart& after) {
  constexpr int bisections = 20;
  if (!before.joint && (!before.end || !after.joint)) return 0;
  if (!after.joint && !after.begin) return 0;
  const JointPath &in = before.limited.path, &out = after.limited.path;
  const Configuration& at = in.q.back();
  if (turns_back({at - in.dq.back(), at, at + out.dq.front(), 0})) return 0;
  double high = std::min(before.end ? blended_fraction * before.end_length : 0.5 * in.s.back(),
                         after.begin ? blended_fraction * after.begin_length : 0.5 * out.s.back());
  if (high < least_blend) return 0;
  if (fits(planned, before, after, high)) return high;
  double low = 0;
  for (int i = 0; i < bisections; ++i) {
    const double middle = 0.5 * (low + high);
    (fits(planned, before, after, middle) ? low : high) = middle;
  }
  return low < least_blend ? 0 : low;
}

void add_grid_points(JointPath& path) {
  JointPath denser;
  for (std::size_t k = 0; k + 1 < path.size(); ++k) {
    add_point(denser, path.s[k], path_point(path, k, 0));
    add_point(denser, 0.5 * (path.s[k] + path.s[k + 1]), path_point(path, k, 0.5));
  }
  add_point(denser, path.s.back(), path_point(path, path.size() - 2, 1));
  path = std::move(denser);
}

}  // namespace beeline::internal
