#include <beeline/error.h>
#include <beeline/path/internal/checked_poses.h>
#include <beeline/path/tool_path.h>

namespace beeline::internal {

std::vector<Pose> checked_poses(std::span<const Pose> given, const std::string& noun) {
  if (given.size() > max_poses) {
    throw Error("a path of " + std::to_string(given.size()) + " poses; at most " +
                std::to_string(max_poses) + " are accepted: divide it");
  }
  std::vector<Pose> poses;
  for (const Pose& pose : given) {
    poses.push_back(checked_pose(pose, noun + " " + std::to_string(poses.size() + 1)));
  }
  return poses;
}

std::vector<Pose> checked_waypoints(std::span<const Pose> waypoints) {
  if (waypoints.empty()) throw Error("a line needs at least one waypoint");
  return checked_poses(waypoints, "waypoint");
}

}  // namespace beeline::internal
