#include "program_argument.h"

#include <cmath>

#include <beeline/error.h>
#include <beeline/io/program.h>
#include <beeline/kinematics/forward.h>

#include "command/streams.h"

namespace beeline::command {
namespace {

/// Gives the poses that are not relative in the world, and warns of numbers in other units.
void set_in_world(const Arm& arm, const ProgramContext& context, ProgramRows& program) {
  const WrittenPose world_T_work = context.work.read(arm, context.unit);
  double max_angle = 0, distance = 0;
  std::optional<PoseForm> form;  // of all rows
  for (ProgramRow& row : program.rows) {
    if (!row.pose) continue;
    form = row.pose->form;
    if (std::abs(row.pose->max_angle) > std::abs(max_angle)) max_angle = row.pose->max_angle;
    try {
      const bool relative = !row.relative.empty();
      const WrittenPose pose = relative ? *row.pose : in_world(arm, world_T_work, *row.pose);
      if (!relative || pose.planar) check_pose_form(arm, pose, context.task);
      row.pose = pose;
      if (distance == 0) {
        distance = relative ? offset_in_millimetres(arm, pose.pose)
                            : distance_in_millimetres(arm, pose.pose);
      }
    } catch (const Error& error) {
      throw FileError(program.path, row.line, error.what());
    }
  }
  warn_of_angle("--through " + program.path, max_angle, form, context.unit);
  warn_of_distance("--through " + program.path, distance, context.unit);
  for (const ProgramRow& row : program.rows) {
    constexpr double fastest = 10;  // m/s
    if (row.speed.value_or(0) <= fastest) continue;
    return warn("--through " + program.path + ": a speed of " + number(*row.speed) +
                " m/s is probably in millimetres per second; speeds are in m/s");
  }
}

/// Gives rows from `first` on this blend where they are lines before a line, without a dwell and a
/// blend of their own.
void blend_lines(double blend, std::size_t first, std::vector<ProgramRow>& rows) {
  const auto line = [](const ProgramRow& row) {
    return row.motion.empty() || row.motion == name(MoveKind::line);
  };
  for (std::size_t i = first; i + 1 < rows.size(); ++i) {
    const bool lines = line(rows[i]) && line(rows[i + 1]);
    if (lines && !rows[i].blend && rows[i].dwell.value_or(0) == 0) rows[i].blend = blend;
  }
}

}  // namespace

const char* const program_help =
    "A program is a file whose rows also have some of these columns, so that a whole pick is "
    "one certified trajectory. motion: joint (a straight line in joint space), line (also "
    "for an empty item), around (a joint motion around the obstacles of --scene), screw, arc "
    "after a row via with a position on it, spline "
    "(consecutive rows are one curve, which stops only where it turns back). relative: "
    "previous, a pose in the tool frame of the waypoint before, or of --from in the first "
    "row (a retreat); next, in the tool frame of the next waypoint that is not relative (an "
    "approach). "
    "q: the joint values of a joint motion, in quotes, or a named state of --srdf. speed: "
    "largest speed of the tool, m/s. blend: metres within which the tool passes the waypoint "
    "without a stop, between rows line, as --blend, and rows joint. A blend is "
    "made smaller, or a stop, if it is not proved or, with a joint row, takes longer; the report "
    "says so. "
    "dwell: seconds at rest. A "
    "joint motion to a pose ends on the branch that the rows up to the next one need. "
    "For each move it prints its duration, the tool's speed and the proved deviation. Rows "
    "with the motion attach or detach move nothing: the obstacle of --scene in the column "
    "part is carried by the tool from the waypoint before the one to the waypoint before the "
    "other, and may touch the links and obstacles of the column touch, in quotes.\n\n";

Program program_from(const std::string& text, const std::string& file, const Arm& arm,
                     const ProgramContext& context, const PathArgument& path,
                     const std::optional<Pose>& start) {
  if (path.kind != name(PathKind::line)) {
    throw Error("--path: " + file + " is a program, whose column motion gives the paths");
  }
  ProgramRows rows = program_rows_from_csv(text, file, context.unit.pose_format());
  set_in_world(arm, context, rows);
  if (path.blend) blend_lines(*path.blend, start ? 0 : 1, rows.rows);
  const auto configuration = [&](const std::string& q) {
    return context.arm_argument.configuration(arm, q, "q", context.unit);
  };
  return program_of(arm, rows, configuration, start);
}

void check_scene_of(const Program& program, const std::string& file, bool has_scene) {
  if (has_scene || program.attachments.empty()) return;
  throw FileError(file, program.attachments.front().line,
                  "attach needs the scene that has the part: --scene FILE");
}

void check_scene_to_plan(const Program& program, const std::string& file, bool has_scene) {
  check_scene_of(program, file, has_scene);
  for (const Move& move : program.moves) {
    if (has_scene || move.kind != MoveKind::around) continue;
    throw FileError(file, move.line, "around needs the obstacles, --scene FILE, or --self");
  }
}

std::vector<Pose> waypoints_of(const Arm& arm, const Program& program) {
  std::vector<Pose> poses;
  for (const Move& move : program.moves) {
    poses.push_back(move.q ? forward_kinematics(arm, *move.q) : move.target);
  }
  return poses;
}

}  // namespace beeline::command
