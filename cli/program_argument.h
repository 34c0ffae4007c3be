#pragma once

#include <string>

#include <beeline/planning/program.h>

#include "arm_argument.h"
#include "path_argument.h"
#include "pose_argument.h"

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
beeline::Program program_from(const std::string& text, const std::string& file,
                              const beeline::Arm& arm, const ProgramContext& context,
                              const PathArgument& path, const std::optional<beeline::Pose>& start);

/// Throws the Error, as a FileError if it is about a move.
[[noreturn]] void throw_at_row(const beeline::Program& program, const std::string& file,
                               const beeline::Error& error);

/// Calls what computes with the program; an Error about a move becomes a FileError at its row.
template <class Compute>
auto at_rows(const beeline::Program& program, const std::string& file, const Compute& compute) {
  try {
    return compute();
  } catch (const beeline::FileError&) {
    throw;
  } catch (const beeline::Error& error) {
    throw_at_row(program, file, error);
  }
}

/// The waypoints, for a picture.
std::vector<beeline::Pose> waypoints_of(const beeline::Arm& arm, const beeline::Program& program);
