#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/internal/tool_plane.h>

namespace beeline::internal {

std::optional<ToolPlane> ToolPlane::required(const Arm& arm, const std::optional<Task>& task) {
  if (task || !arm.planar()) return std::nullopt;
  return ToolPlane(pose_in_plane(arm, {}).translation().z(), arm.name());
}

std::string ToolPlane::fault(const std::string& what) const {
  return what + " is outside the plane z = " + number(height_) + " m of arm " + arm_ +
         "; give x,y,theta";
}

Error ToolPlane::error(const std::string& what) const {
  return {fault(what) + ", or ", "task", " planar to ignore height and tilt"};
}

void ToolPlane::refuse(const Pose& pose, const std::string& what) const {
  checked_pose(pose, what);
  throw error(what);
}

}  // namespace beeline::internal

namespace beeline {

void check_in_plane(const Arm& arm, const Pose& pose, const std::string& what, bool offers_task) {
  const auto plane = internal::ToolPlane::required(arm, std::nullopt);
  if (!plane || plane->contains(pose)) return;
  checked_pose(pose, what);
  throw offers_task ? plane->error(what) : Error(plane->fault(what));
}

}  // namespace beeline
