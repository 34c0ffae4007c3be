#include <algorithm>
#include <cmath>

#include <beeline/io/internal/controller_moves.h>
#include <beeline/io/internal/controller_program.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>

namespace beeline::internal {
namespace {

constexpr int times_of_move = 200;  // at which its largest rates are taken
// A move that is already at its waypoint gets these.
constexpr double least_speed = 0.01, least_acceleration = 0.1;  // m or rad, per s and s^2

/// The largest rates of a move of the planned motion.
void set_rates(const Arm& arm, const Trajectory& trajectory, const PlannedMove& planned,
               ControllerMove& move) {
  const double begin = trajectory.times[planned.begin];
  const double dt = (trajectory.times[planned.end] - begin) / times_of_move;
  Vector3 before = Vector3::Zero(), velocity_before = Vector3::Zero();
  for (int k = 0; k <= times_of_move && dt > 0; ++k) {
    const TrajectoryState state = sample(trajectory, begin + k * dt, Side::before);
    for (int i = 0; i < arm.dof(); ++i) {
      const double speed = std::abs(state.velocity[i]);
      move.joint_speed = std::max(move.joint_speed, speed);
      move.joint_acceleration = std::max(move.joint_acceleration, std::abs(state.acceleration[i]));
      move.joint_fraction = std::max(move.joint_fraction, speed / velocity_limit_of(arm.limits(i)));
    }
    const Vector3 at = forward_kinematics(arm, state.position).translation();
    const Vector3 velocity = (at - before) / dt;
    if (k > 1) {
      move.acceleration = std::max(move.acceleration, (velocity - velocity_before).norm() / dt);
    }
    before = at;
    velocity_before = velocity;
  }
  move.acceleration = std::max(move.acceleration, least_acceleration);
  move.joint_speed = std::max(move.joint_speed, least_speed);
  move.joint_acceleration = std::max(move.joint_acceleration, least_acceleration);
}

/// In thousandths, rounded up: what the planned motion needs is not cut.
std::string in_thousandths(double value) { return fixed_point(std::ceil(value * 1e3) / 1e3, 3); }

/// A speed that a program states is not exceeded.
std::string metres_per_second(double speed) {
  return fixed_point(std::floor(speed * 1e9) / 1e9, 9);
}

/// A robtarget without configuration data and external axes.
std::string robtarget(const Pose& pose) {
  return "[" + rapid_pose(pose) + ",[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]]";
}

/// A pose in the frame of the program's poses, as a pose in the base.
std::string pose_in_base(const ProgramFrames& frames, const Pose& pose) {
  const std::string text = urscript_pose(pose);
  return frames.root_T_work ? "pose_trans(work, " + text + ")" : text;
}

/// speeddata: the tool's speed in mm/s; the others as in the predefined ones.
std::string speeddata(double speed) {
  return "[" + fixed_point(std::floor(speed * 1e9) / 1e6, 6) + ",500,5000,1000]";
}

/// zonedata with the proportions of the predefined ones, or fine.
std::string zonedata(double radius) {
  if (radius == 0) return "fine";
  const double r = 1e3 * radius;
  return "[FALSE," +
         listed_numbers(Configuration{{r, 1.5 * r, 1.5 * r, 0.15 * r, 1.5 * r, 0.15 * r}}, 6) + "]";
}

/// The moves from move i on that are one spline, and the lowest of their speeds.
struct SplineRun {
  std::size_t count = 0;
  double speed = 0;
};

SplineRun spline_run(const std::vector<ControllerMove>& moves, std::size_t i) {
  SplineRun run{1, moves[i].speed};
  for (; i + run.count < moves.size() && moves[i + run.count].kind == MoveKind::spline &&
         moves[i + run.count - 1].dwell == 0;
       ++run.count) {
    run.speed = std::min(run.speed, moves[i + run.count].speed);
  }
  return run;
}

std::string krl_spline(const std::vector<ControllerMove>& moves, std::size_t i,
                       const SplineRun& run) {
  std::string text = "SPLINE WITH $VEL.CP=" + metres_per_second(run.speed) + "\n";
  for (std::size_t k = 0; k < run.count; ++k) {
    text += "  SPL " + krl_pose(moves[i + k].target) + "\n";
  }
  return text + "ENDSPLINE\n";
}

/// Rounded up to microseconds, so that a dwell is not shorter.
std::string seconds(double dwell) { return fixed_point(std::ceil(dwell * 1e6 - 1e-3) / 1e6, 6); }

/// The largest speed of the tool's origin on a straight joint motion, relative to the largest joint
/// speed, m/rad.
double tool_speed_ratio(const Arm& arm, const Configuration& from, const Configuration& to) {
  const Configuration change = to - from;
  double ratio = 0;
  for (int k = 0; k <= times_of_move && !change.isZero(0); ++k) {
    const Configuration q = from + double(k) / times_of_move * change;
    ratio = std::max(ratio, (jacobian(arm, q).topRows<3>() * change).norm());
  }
  return change.isZero(0) ? 0 : ratio / change.cwiseAbs().maxCoeff();
}

/// Slows a joint move down so that the tool does not exceed the speed of the planned move.
void limit_tool_speed(double ratio, double tool_speed, ControllerMove& move) {
  // Programs round up: to thousandths and per cent.
  const auto rounded_down = [](double value, double unit) {
    return std::max(std::floor(value / unit) - 1e-3, 1.0) * unit;
  };
  const double slower = ratio * move.joint_speed / tool_speed;
  if (!(slower > 1)) return;
  move.joint_speed = rounded_down(move.joint_speed / slower, 1e-3);
  move.joint_fraction = rounded_down(move.joint_fraction / slower, 1e-2);
}

/// Replaces a move around obstacles by joint moves to its waypoints, at which the arm stops: the
/// straight joint motions between them are proved, and how a controller blends them is not known.
void add_moves_around(const Arm& arm, const ControllerMove& around, const PlannedMove& planned,
                      std::vector<ControllerMove>& moves) {
  for (std::size_t k = 1; k < planned.waypoints.size(); ++k) {
    ControllerMove& written = moves.emplace_back(around);
    written.kind = MoveKind::joint;
    written.q = planned.waypoints[k];
    if (k + 1 < planned.waypoints.size()) written.dwell = 0;
    limit_tool_speed(tool_speed_ratio(arm, planned.waypoints[k - 1], written.q), around.speed,
                     written);
  }
}

}  // namespace

std::vector<ControllerMove> controller_moves(const Arm& arm, const Program& program,
                                             const ProgramMotion& motion,
                                             const Pose& world_T_frame) {
  const Trajectory& trajectory = motion.trajectory;
  const Pose frame_T_world = world_T_frame.inverse();
  std::vector<ControllerMove> moves;
  for (std::size_t i = 0; i < program.moves.size(); ++i) {
    const Move& move = program.moves[i];
    const PlannedMove& planned = motion.moves[i];
    ControllerMove written;
    written.kind = is_joint_motion(move.kind) ? MoveKind::joint : move.kind;
    const bool passed = move.kind == MoveKind::joint && !planned.waypoints.empty();
    written.q = passed ? planned.waypoints.back() : trajectory.positions[planned.end];
    written.target = frame_T_world * move.target;
    if (move.via) {
      const Pose from = forward_kinematics(arm, trajectory.positions[planned.begin]);
      written.via = interpolate(from, move.target, 0.5);
      written.via.translation() = *move.via;
      written.via = frame_T_world * written.via;
    }
    set_rates(arm, trajectory, planned, written);
    written.speed = move.speed.value_or(planned.tool_speed > 0 ? planned.tool_speed : least_speed);
    written.blend_radius = planned.blend_radius;
    written.dwell = move.dwell;
    if (move.kind == MoveKind::around && planned.waypoints.size() > 1)
      add_moves_around(arm, written, planned, moves);
    else
      moves.push_back(std::move(written));
  }
  return moves;
}

std::string urscript_moves(const MoveSource& source) {
  std::string text = commented(source.comments, "# ") + "def beeline_motion():\n" +
                     urscript_tool(source.frames) + urscript_work(source.frames) +
                     urscript_approach(source.start);
  for (const ControllerMove& move : source.moves) {
    const std::string rates =
        ", a=" + in_thousandths(move.acceleration) + ", v=" + metres_per_second(move.speed);
    const std::string blend = ", r=" + fixed_point(move.blend_radius, 6);
    const std::string target = pose_in_base(source.frames, move.target);
    if (move.kind == MoveKind::joint) {
      text += "  movej(" + radians_of(move.q) + ", a=" + in_thousandths(move.joint_acceleration) +
              ", v=" + in_thousandths(move.joint_speed) + ")\n";
    } else if (move.kind == MoveKind::arc) {
      text += "  movec(" + pose_in_base(source.frames, move.via) + ", " + target + rates + blend +
              ", mode=0)\n";
    } else {
      text += "  movel(" + target + rates + blend + ")\n";
    }
    if (move.dwell > 0) text += "  sleep(" + seconds(move.dwell) + ")\n";
  }
  return text + "end\n";
}

std::string rapid_moves(const MoveSource& source) {
  check_rapid_name(source.name);
  const std::string tool = rapid_tool(source.frames, source.name);
  const std::string tool_and_work = rapid_tool_and_work(source.frames, source.name);
  std::string text = "MODULE " + source.name + "\n" + commented(source.comments, "  ! ") +
                     rapid_declarations(source.frames, source.name) + "  PROC play_" + source.name +
                     "()\n    ConfJ\\Off;\n    ConfL\\Off;\n    MoveAbsJ " +
                     rapid_axes(source.start) + "\\NoEOffs,v100,fine," + tool + ";\n";
  for (const ControllerMove& move : source.moves) {
    const std::string rates = "," + speeddata(move.speed) + "," + zonedata(move.blend_radius) + ",";
    const std::string target = robtarget(move.target) + rates + tool_and_work + ";\n";
    if (move.kind == MoveKind::joint) {
      text += "    MoveAbsJ " + rapid_axes(move.q) + "\\NoEOffs" + rates + tool + ";\n";
    } else if (move.kind == MoveKind::arc) {
      text += "    MoveC " + robtarget(move.via) + "," + target;
    } else {
      text += "    MoveL " + target;
    }
    if (move.dwell > 0) text += "    WaitTime " + seconds(move.dwell) + ";\n";
  }
  return text + "  ENDPROC\nENDMODULE\n";
}

std::string krl_moves(const MoveSource& source) {
  check_krl_name(source.name);
  std::string text = "DEF " + source.name + "()\n" + commented(source.comments, "; ") +
                     "INT I\nBAS(#INITMOV,0)\n" + krl_tool(source.frames) + krl_base(source.frames);
  const auto joint_speed = [](double fraction) {
    const double percent = std::clamp(std::ceil(100 * fraction), 1.0, 100.0);
    return "FOR I=1 TO 6\n  $VEL_AXIS[I]=" + fixed_point(percent, 0) + "\nENDFOR\n";
  };
  text += joint_speed(0.1) + "PTP " + krl_axes(source.start) + "\n";
  for (std::size_t i = 0; i < source.moves.size(); ++i) {
    const ControllerMove& move = source.moves[i];
    const std::string frame = krl_pose(move.target);
    const std::string speed = "$VEL.CP=" + metres_per_second(move.speed);
    if (move.kind == MoveKind::joint) {
      text += joint_speed(move.joint_fraction) + "PTP " + krl_axes(move.q) + "\n";
    } else if (move.kind == MoveKind::arc) {
      text += speed + "\nCIRC " + krl_pose(move.via) + "," + frame + "\n";
    } else if (move.kind == MoveKind::spline) {
      const SplineRun run = spline_run(source.moves, i);
      text += krl_spline(source.moves, i, run);
      i += run.count - 1;
    } else {
      const std::string blend = "$APO.CDIS=" + fixed_point(1e3 * move.blend_radius, 6) + "\n";
      text += speed + "\n" + (move.blend_radius > 0 ? blend : "") + "LIN " + frame +
              (move.blend_radius > 0 ? " C_DIS\n" : "\n");
    }
    const double dwell = source.moves[i].dwell;  // of the last of a spline
    if (dwell > 0) text += "WAIT SEC " + seconds(dwell) + "\n";
  }
  return text + "END\n";
}

}  // namespace beeline::internal
