#include <beeline/io/internal/controller_program.h>
#include <beeline/io/internal/program_frames.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {
namespace {

/// The frame in which controllers take poses, as their makers name it.
const char* root_name(ControllerForm form) {
  if (form == ControllerForm::urscript) return "the base feature";
  if (form == ControllerForm::rapid)
    return "wobj0 (the world frame must be the robot's base frame)";
  return "$ROBROOT";
}

}  // namespace

ProgramFrames program_frames(const Arm& arm, const std::optional<Pose>& world_T_work) {
  const ControllerFrames& controller = arm.controller();
  ProgramFrames frames{.world_T_root = controller.base,
                       .root_assumed = controller.base_assumed,
                       .flange_assumed = controller.flange_assumed};
  if (arm.tool().matrix() != controller.flange.matrix()) {
    frames.flange_T_tool = controller.flange.inverse() * arm.tool();
  }
  if (world_T_work) {
    frames.root_T_work = controller.base.inverse() * checked_pose(*world_T_work, "the work frame");
  }
  return frames;
}

std::string urscript_pose(const Pose& pose) {
  const Vector3 p = pose.translation(), r = so3_log(pose.linear());
  return "p[" + listed_numbers(Configuration{{p.x(), p.y(), p.z(), r.x(), r.y(), r.z()}}, 12) + "]";
}

std::string rapid_pose(const Pose& pose) {
  const Vector3 p = 1e3 * pose.translation();
  const Quaternion q = quaternion(pose.linear());
  return "[" + listed_numbers(p, 9) + "],[" +
         listed_numbers(Configuration{{q.qw, q.qx, q.qy, q.qz}}, 12) + "]";
}

std::string krl_pose(const Pose& pose) {
  const Vector3 p = 1e3 * pose.translation();
  const RollPitchYaw angles = roll_pitch_yaw(pose.linear());
  const double values[] = {p.x(), p.y(), p.z(), angles.yaw, angles.pitch, angles.roll};
  std::string text = "{";
  for (std::size_t i = 0; i < 6; ++i) {
    text += (i == 0 ? "" : ",") + std::string(1, "XYZABC"[i]) + " " +
            plain(i < 3 ? values[i] : degrees_per_radian * values[i], 9);
  }
  return text + "}";
}

std::string urscript_tool(const ProgramFrames& frames) {
  return "  set_tcp(" + urscript_pose(frames.flange_T_tool) + ")\n";
}

std::string urscript_work(const ProgramFrames& frames) {
  return frames.root_T_work ? "  work = " + urscript_pose(*frames.root_T_work) + "\n" : "";
}

std::string krl_tool(const ProgramFrames& frames) {
  return "$TOOL=" + krl_pose(frames.flange_T_tool) + "\n";
}

std::string krl_base(const ProgramFrames& frames) {
  const std::string root = "$BASE=$ROBROOT";
  return root + (frames.root_T_work ? ":" + krl_pose(*frames.root_T_work) : "") + "\n";
}

std::string rapid_declarations(const ProgramFrames& frames, const std::string& name) {
  std::string text;
  if (frames.has_tool()) {  // with the load of tool0
    text += "  PERS tooldata tool_" + name + ":=[TRUE,[" + rapid_pose(frames.flange_T_tool) +
            "],[0.001,[0,0,0.001],[1,0,0,0],0,0,0]];\n";
  }
  if (frames.root_T_work) {
    text += "  PERS wobjdata wobj_" + name + ":=[FALSE,TRUE,\"\",[" +
            rapid_pose(*frames.root_T_work) + "],[[0,0,0],[1,0,0,0]]];\n";
  }
  return text;
}

std::string rapid_tool(const ProgramFrames& frames, const std::string& name) {
  return frames.has_tool() ? "tool_" + name : "tool0";
}

std::string rapid_tool_and_work(const ProgramFrames& frames, const std::string& name) {
  return rapid_tool(frames, name) + (frames.root_T_work ? "\\WObj:=wobj_" + name : "");
}

std::string note_on_tool(const ProgramFrames& frames) {
  return frames.has_tool() ? "the tool is set, its load is not; " : "";
}

namespace {

/// Which frames of the controller no description of the arm states.
std::string note_on_assumptions(const ProgramFrames& frames) {
  if (frames.root_assumed && frames.flange_assumed) {
    return "; that frame is assumed to be the world of the arm's description, its tool frame the "
           "flange (controller_base and flange of a .json arm state others)";
  }
  if (frames.root_assumed) {
    return "; that frame is assumed to be the world of the arm's description (controller_base of "
           "a .json arm states another)";
  }
  if (frames.flange_assumed) {
    return "; the flange is assumed to be the tool frame of the arm's description (flange of a "
           ".json arm states another)";
  }
  return "";
}

}  // namespace

std::string note_on_frames(ControllerForm form, const ProgramFrames& frames) {
  const std::string root = std::string("the controller's root frame, ") + root_name(form);
  const std::string poses = frames.root_T_work
                                ? "poses are in a work frame, which is given in " + root
                                : "poses are in " + root;
  return poses + note_on_assumptions(frames) + "; " +
         (frames.has_tool() ? note_on_tool(frames) : "the tool is the flange; ");
}

}  // namespace beeline::internal
