#pragma once

#include <optional>
#include <string>
#include <vector>

#include <beeline/io/internal/program_frames.h>
#include <beeline/planning/program.h>

namespace beeline::internal {

/// A move as the controllers of several makers take it.
struct ControllerMove {
  MoveKind kind = MoveKind::line;
  Configuration q;                     ///< at the waypoint, of joint moves
  Pose target = Pose::Identity();      ///< of the other moves, in the frame of the program's poses
  Pose via = Pose::Identity();         ///< of arcs, in the same frame, with the orientation halfway
  double speed = 0, acceleration = 0;  ///< of the tool: m/s and m/s^2
  double joint_speed = 0;              ///< the largest of a joint move, rad/s
  double joint_acceleration = 0;       ///< the same, rad/s^2
  double joint_fraction = 0;           ///< the largest fraction of a velocity limit
  double blend_radius = 0;             ///< metres
  double dwell = 0;                    ///< seconds
};

/// The content of a program of moves.
struct MoveSource {
  Configuration start;  ///< where the first move begins
  std::vector<ControllerMove> moves;
  std::vector<std::string> comments;
  std::string name;  ///< of the program
  ProgramFrames frames;
};

/// The moves of a planned program, their poses in the frame at `world_T_frame`. If its motion
/// begins at the first waypoint, the first move stays there.
std::vector<ControllerMove> controller_moves(const Arm& arm, const Program& program,
                                             const ProgramMotion& motion,
                                             const Pose& world_T_frame);

/// Programs: movej, movel, movec; MoveAbsJ, MoveL, MoveC; PTP, LIN, CIRC, SPLINE. Throws Error for
/// a name that the language does not have.
std::string urscript_moves(const MoveSource& source);
std::string rapid_moves(const MoveSource& source);
std::string krl_moves(const MoveSource& source);

}  // namespace beeline::internal
