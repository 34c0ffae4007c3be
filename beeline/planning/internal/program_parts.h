#pragma once

#include <span>
#include <vector>

#include <beeline/planning/program.h>

namespace beeline::internal {

/// A joint motion, or all moves from one joint motion to the next.
struct ProgramPart {
  std::size_t first = 0, last = 0;  ///< moves of the program
  bool joint = false;
  Route route = {};                      ///< unless it is a joint motion
  std::vector<std::size_t> moves = {};   ///< of each segment of the route
  std::vector<double> blend_radii = {};  ///< of each move from `first` on
  /// Likewise the scales of the blends between two lines, from 0, a stop, to 1.
  std::vector<double> blend_scales = {};

  /// Returns the first segment of a move, or of a later move if a blend replaces all of its line.
  std::size_t first_segment(std::size_t move) const;

  /// Returns the last segment of a move, or of an earlier move if a blend replaces all of its line.
  std::size_t last_segment(std::size_t move) const;
};

/// Most of a line, from its end, that a blend with a joint move may replace. Of a line with two of
/// them a sixteenth at least is followed.
constexpr double blended_fraction = 15.0 / 32;

/// "move 3 (line)", "moves 3 to 5".
std::string part_name(const Program& program, const ProgramPart& part);

/// Throws Error, without move_name(), if move_program() refuses moves[i] itself.
void check_move(const Arm& arm, const Program& program, std::size_t i);

/// Does the same, with move_name(), for all moves, for a program without moves, and for a waypoint
/// outside the plane of a planar arm if no task is given.
void check_program(const Arm& arm, const Program& program, const std::optional<Task>& task);

/// Throws MoveError if a motion without a start cannot begin at the waypoint of the first move.
void check_begins(const Program& program);

/// Whether the tool passes the waypoint of move i without a stop, if there is a motion that does.
bool is_passed(const Program& program, std::size_t i);

/// Whether it does so on a path of the tool: both moves are lines, or both are parts of a spline.
bool continues_path(const Program& program, std::size_t i);

/// Whether it does so in a blend with a joint move: one of both moves is one.
bool blends_with_joint_move(const Program& program, std::size_t i);

/// The max deviation of the blend of a move.
Deviation blend_deviation(const Move& move);

/// The waypoint of a move as a pose.
Pose waypoint_of(const Arm& arm, const Move& move);

/// Divides the program from move `first` on, with the tool at `begin`, into parts. Moves without a
/// speed get `tool_speed`.
std::vector<ProgramPart> program_parts(const Arm& arm, const Program& program, std::size_t first,
                                       const Pose& begin, double tool_speed);

/// The same path with smaller blends between its lines: their scales, one for each of its moves.
ProgramPart with_blend_scales(const Program& program, const ProgramPart& part, double tool_speed,
                              std::span<const double> scales);

}  // namespace beeline::internal
