#include <algorithm>
#include <cmath>

#include <beeline/inverse/internal/infeasibility.h>
#include <beeline/reach/internal/tool_volume.h>

namespace beeline::internal {
namespace {

constexpr double rounding = 1e-12;  // more than the rounding error of a length, relative

bool has_mimic_joint(const Arm& arm) {
  return std::any_of(arm.joints().begin(), arm.joints().end(),
                     [](const Joint& joint) { return joint.mimic.has_value(); });
}

/// The smaller one of two balls, both of which contain the tool's origin.
Arm::Reach smallest_ball(const Arm& arm) {
  const Arm::Reach any = ball_of_tool(arm);
  return any.radius < arm.reach().radius ? any : arm.reach();
}

}  // namespace

ToolVolume::ToolVolume(const Arm& arm) : planar_(arm.planar()) {
  const std::vector<Joint>& joints = arm.joints();
  Pose base_T_link = arm.base();
  std::size_t first = 0;  // joint behind the slides
  if (!has_mimic_joint(arm)) {
    while (first + 1 < joints.size() && add_slide(arm, first, base_T_link)) ++first;
  }
  const auto behind = joints.begin() + static_cast<std::ptrdiff_t>(first);
  ball_ = smallest_ball({arm.name(), {behind, joints.end()}, arm.tool(), base_T_link});
  double size = ball_.radius + ball_.centre.norm();
  for (const Slide& slide : slides_) size += slide.half_range;
  ball_.radius += 4 * rounding * size;
}

/// Adds the joint and moves the link to the middle of its range. Returns false for a joint that is
/// not prismatic, has no limits, or is not at right angles to the slides before it.
bool ToolVolume::add_slide(const Arm& arm, std::size_t joint, Pose& base_T_link) {
  const Joint& slide = arm.joints()[joint];
  const double range = slide.limits.upper - slide.limits.lower;
  if (kind(slide) != JointKind::prismatic || !std::isfinite(range)) return false;
  const Pose link = base_T_link * slide.offset;
  const Vector3 axis = (link.linear() * slide.screw.head<3>()).normalized();
  for (const Slide& before : slides_) {
    if (std::abs(axis.dot(before.axis)) > rounding) return false;
  }
  slides_.push_back({axis, range / 2});
  base_T_link = link;
  base_T_link.translation() += (slide.limits.lower + range / 2) * axis;
  return true;
}

bool ToolVolume::excludes(const Vector3& position, double tolerance) const {
  Vector3 offset = position - ball_.centre;
  for (const auto& [axis, half_range] : slides_) {
    offset -= std::clamp(offset.dot(axis), -half_range, half_range) * axis;
  }
  if (planar_) offset.z() = 0;
  return offset.norm() - ball_.radius > tolerance;
}

}  // namespace beeline::internal
