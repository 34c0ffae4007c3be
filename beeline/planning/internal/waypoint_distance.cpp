#include <algorithm>
#include <cmath>

#include <beeline/kinematics/forward.h>
#include <beeline/path/tool_path.h>
#include <beeline/planning/internal/program_parts.h>
#include <beeline/planning/internal/waypoint_distance.h>

namespace beeline::internal {

double joint_distance(const Arm& arm, const ConfigurationRef& a, const ConfigurationRef& b,
                      const Deviation& tolerance) {
  double largest = 0;
  for (int i = 0; i < arm.dof(); ++i) {
    const bool slides = kind(arm.joint_of(i)) == JointKind::prismatic;
    const double most = slides ? tolerance.position : tolerance.orientation;
    largest = std::max(largest, std::abs(a[i] - b[i]) / most);
  }
  return largest;
}

WaypointDistance::WaypointDistance(const Arm& arm, const Move& move, const Task& task,
                                   const Deviation& tolerance)
    : arm_(arm), move_(move), task_(task), tolerance_(tolerance), pose_(waypoint_of(arm, move)) {}

double WaypointDistance::operator()(const ConfigurationRef& q) const {
  const Deviation tool = task_deviation(task_, pose_, forward_kinematics(arm_, q));
  const double distance =
      std::max(tool.position / tolerance_.position, tool.orientation / tolerance_.orientation);
  return move_.q ? std::max(distance, joint_distance(arm_, q, *move_.q, tolerance_)) : distance;
}

}  // namespace beeline::internal
