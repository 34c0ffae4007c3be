#include <algorithm>

#include <beeline/io/program.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/kinematics/forward.h>
#include <beeline/planning/internal/attachments.h>
#include <beeline/planning/internal/program_parts.h>

namespace beeline {
namespace {

using Configure = std::function<Configuration(const std::string&)>;

/// Calls what computes from row i; an Error gets its place in the file.
template <class Compute>
auto at_row(const ProgramRows& program, std::size_t i, const Compute& compute) {
  try {
    return compute();
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    throw FileError(program.path, program.rows[i].line, error.what());
  }
}

bool passes(const ProgramRow& row) { return row.motion == "via"; }

/// Whether the tool stops or turns at a waypoint of the row.
bool has_waypoint(const ProgramRow& row) { return !passes(row) && !row.is_of_part(); }

/// The frame of a relative row, world_T_waypoint, among the poses of the rows.
const Pose& frame_of(const std::vector<ProgramRow>& rows, std::size_t i,
                     const std::vector<Pose>& poses, const std::optional<Pose>& start) {
  if (rows[i].relative == "next") {
    for (std::size_t k = i + 1; k < rows.size(); ++k) {
      if (has_waypoint(rows[k]) && rows[k].relative.empty()) return poses[k];
    }
    throw Error("relative is next, but no row after this one has a pose that is not relative");
  }
  for (std::size_t k = i; k-- > 0;) {
    if (has_waypoint(rows[k])) return poses[k];
  }
  if (start) return *start;
  throw Error(
      "relative is previous, but there is no waypoint before this one, and no start is given");
}

/// "pick.csv:5".
std::string place_of(const ProgramRows& program, std::size_t i) {
  const std::size_t folder = program.path.find_last_of('/');
  const std::string file = program.path.substr(folder == std::string::npos ? 0 : folder + 1);
  return file + ":" + std::to_string(program.rows[i].line);
}

Move move_of(const ProgramRows& program, std::size_t i, const std::vector<Pose>& poses,
             const std::optional<Configuration>& q) {
  const ProgramRow& row = program.rows[i];
  Move move{.kind = row.motion.empty() ? MoveKind::line : move_kind_named(row.motion),
            .target = poses[i],
            .q = q,
            .via = std::nullopt,
            .speed = row.speed,
            .blend = row.blend.value_or(0),
            .dwell = row.dwell.value_or(0),
            .place = place_of(program, i),
            .line = row.line};
  const bool via = i > 0 && passes(program.rows[i - 1]);
  if (via) move.via = poses[i - 1].translation();
  if (!via && move.kind == MoveKind::arc) {
    throw Error("an arc needs a row before it with the motion via, a position that it passes");
  }
  return move;
}

/// Attaches or detaches the part of a row after the moves of a program. Throws Error for a part
/// that is attached already, or that is not attached.
void add_part(const ProgramRows& rows, std::size_t i, Program& program) {
  const ProgramRow& row = rows.rows[i];
  const auto attached =
      std::find_if(program.attachments.begin(), program.attachments.end(),
                   [&](const Attachment& one) { return one.part == row.part && !one.until; });
  const bool is_attached = attached != program.attachments.end();
  if (row.motion == "detach") {
    if (!is_attached) throw Error(internal::in_quotes(row.part) + " is not attached here");
    if (attached->after == program.moves.size()) {
      throw Error(internal::in_quotes(row.part) + " is detached before a move carries it");
    }
    attached->until = program.moves.size();
    attached->detach_place = place_of(rows, i);
    return;
  }
  if (is_attached) {
    throw Error(internal::in_quotes(row.part) + " is attached already, by row " + attached->place);
  }
  program.attachments.push_back({.part = row.part,
                                 .after = program.moves.size(),
                                 .touch = row.touch,
                                 .place = place_of(rows, i),
                                 .line = row.line});
}

}  // namespace

Program program_of(const Arm& arm, const ProgramRows& rows, const Configure& configuration,
                   const std::optional<Pose>& start) {
  const std::size_t count = rows.rows.size();
  std::vector<std::optional<Configuration>> q(count);
  std::vector<Pose> poses(count);
  for (std::size_t i = 0; i < count; ++i) {
    const ProgramRow& row = rows.rows[i];
    if (!row.q.empty()) {
      q[i] = at_row(rows, i, [&] {
        Configuration read = configuration(row.q);
        check_configuration(arm, read);
        return read;
      });
    }
    if (q[i]) {
      poses[i] = forward_kinematics(arm, *q[i]);
    } else if (row.pose) {
      poses[i] = row.pose->pose;
    }
  }
  Program program;
  for (std::size_t i = 0; i < count; ++i) {
    if (rows.rows[i].relative.empty()) continue;
    poses[i] = at_row(rows, i, [&] { return frame_of(rows.rows, i, poses, start); }) * poses[i];
  }
  std::vector<std::size_t> row_of;  // of each move
  for (std::size_t i = 0; i < count; ++i) {
    if (passes(rows.rows[i])) {
      const bool arc = i + 1 < count && rows.rows[i + 1].motion == name(MoveKind::arc);
      if (!arc)
        throw FileError(rows.path, rows.rows[i].line, "a via row must be followed by an arc");
      continue;
    }
    if (rows.rows[i].is_of_part()) {
      at_row(rows, i, [&] { add_part(rows, i, program); });
      continue;
    }
    program.moves.push_back(at_row(rows, i, [&] { return move_of(rows, i, poses, q[i]); }));
    row_of.push_back(i);
  }
  for (std::size_t i = 0; i < program.moves.size(); ++i) {
    at_row(rows, row_of[i], [&] { internal::check_move(arm, program, i); });
  }
  if (program.moves.empty()) throw FileError(rows.path, 0, "has no moves");
  try {
    internal::check_attachments(program);
  } catch (const AttachmentError& error) {
    throw FileError(rows.path, program.attachments[error.attachment()].line, error.fault());
  }
  return program;
}

}  // namespace beeline
