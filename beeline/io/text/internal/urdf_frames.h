#pragma once

#include <string>

#include <beeline/io/text/internal/urdf_file.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

/// Returns the controller's frames of the chain from link `base`, whose frame is the world, to link
/// `tip`, at pose `tool` in the frame of the last joint. By the convention of ROS-Industrial (REP
/// 199) the root frame is the link `base` and the flange is the link `tool0`. Each counts where
/// only fixed joints connect it to its end of the chain.
ControllerFrames controller_frames(const UrdfFile& file, const std::string& base,
                                   const std::string& tip, const Pose& tool);

}  // namespace beeline::internal
