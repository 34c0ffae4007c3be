#pragma once

#include <optional>
#include <string>

#include <beeline/io/internal/controller_form.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

/// The frames that a program for a controller states.
struct ProgramFrames {
  Pose world_T_root = Pose::Identity();  ///< ControllerFrames::base of the arm
  bool root_assumed = false;             ///< ControllerFrames::base_assumed
  bool flange_assumed = false;           ///< ControllerFrames::flange_assumed
  Pose flange_T_tool = Pose::Identity();
  std::optional<Pose> root_T_work = std::nullopt;  ///< the frame of the poses; none: the root frame

  /// Whether the tool is not the flange, apart from rounding.
  bool has_tool() const { return !flange_T_tool.matrix().isIdentity(1e-12); }
  /// Its pose in the world.
  Pose frame_of_poses() const { return root_T_work ? world_T_root * *root_T_work : world_T_root; }
};

ProgramFrames program_frames(const Arm& arm, const std::optional<Pose>& world_T_work);

/// p[x,y,z,rx,ry,rz] of URScript: metres, and the rotation vector in radians.
std::string urscript_pose(const Pose& pose);

/// [x,y,z],[q1,q2,q3,q4] of RAPID: millimetres and the quaternion.
std::string rapid_pose(const Pose& pose);

/// {X ..,Y ..,Z ..,A ..,B ..,C ..} of KRL: millimetres, and degrees about z, y and x.
std::string krl_pose(const Pose& pose);

/// The statements that set the tool, and the frame of the poses.
std::string urscript_tool(const ProgramFrames& frames);
std::string urscript_work(const ProgramFrames& frames);  ///< the variable `work`; or nothing
std::string krl_tool(const ProgramFrames& frames);
std::string krl_base(const ProgramFrames& frames);

/// The declarations of the tool and of the work object in a module of RAPID, empty where the
/// predefined ones serve; and what motion instructions name: tool0 or tool_NAME, and for a target
/// also \WObj.
std::string rapid_declarations(const ProgramFrames& frames, const std::string& name);
std::string rapid_tool(const ProgramFrames& frames, const std::string& name);
std::string rapid_tool_and_work(const ProgramFrames& frames, const std::string& name);

/// Returns the sentences of ControllerFile::note about the tool, empty without one, and about the
/// frame of the poses and the tool.
std::string note_on_tool(const ProgramFrames& frames);
std::string note_on_frames(ControllerForm form, const ProgramFrames& frames);

}  // namespace beeline::internal
