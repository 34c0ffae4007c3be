#pragma once

#include <string>

#include <beeline/planning/program.h>

#include "arm_argument.h"
#include "path_argument.h"
#include "pose_argument.h"

namespace beeline::command {

/// What --help says of program files, a paragraph.
extern const char* const program_help;

/// What the waypoints of a program file depend on besides its text.
struct ProgramContext {
  const ArmArgument& arm_argument;
  const TaskArgument& task;
  const WorkArgument& work;
  const UnitArgument& unit;
};

/// The program of a file, its poses given in the frame of --work. Two lines without a blend or a
/// dwell between them get the blend of `path`, but not at the first row if that is the start, as it
/// is unless the tool's pose at the start, world_T_tool, is given.
/// Throws FileError for what the file says, and Error for a --path.
Program program_from(const std::string& text, const std::string& file, const Arm& arm,
                     const ProgramContext& context, const PathArgument& path,
                     const std::optional<Pose>& start);

/// Calls what computes with the program; a MoveError and an AttachmentError become a FileError at
/// the row.
template <class Compute>
auto at_rows(const Program& program, const std::string& file, const Compute& compute) {
  try {
    return compute();
  } catch (const MoveError& error) {
    throw FileError(file, program.moves[error.move()].line, error.fault());
  } catch (const AttachmentError& error) {
    throw FileError(file, program.attachments[error.attachment()].line, error.fault());
  }
}

/// Throws FileError for a program of the file that attaches parts, unless there is a scene.
void check_scene_of(const Program& program, const std::string& file, bool has_scene);

/// Throws FileError as check_scene_of() does and, as its motion is to be planned, for a move around
/// obstacles.
void check_scene_to_plan(const Program& program, const std::string& file, bool has_scene);

/// The waypoints, for a picture.
std::vector<Pose> waypoints_of(const Arm& arm, const Program& program);

}  // namespace beeline::command
