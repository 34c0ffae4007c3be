#include <algorithm>
#include <array>
#include <cmath>

#include <beeline/error.h>
#include <beeline/model/moving_base.h>
#include <beeline/pose/se3.h>

namespace beeline {
namespace {

/// A joint that moves the whole arm: its screw is in the world with all joints at 0.
struct BaseJoint {
  const char* name;
  const char* link;
  Twist world_screw;
  const Limits& limits;
};

/// Returns `wanted` or, if a joint has this name, `wanted2`, `wanted3` and so on.
std::string free_name(const std::vector<Joint>& joints, const std::string& wanted,
                      std::string Joint::*name) {
  std::string free = wanted;
  const auto has_name = [&](const Joint& joint) { return joint.*name == free; };
  for (int i = 2; std::any_of(joints.begin(), joints.end(), has_name); ++i) {
    free = wanted + std::to_string(i);
  }
  return free;
}

/// Whether a name is `wanted` or one that free_name() gives instead.
bool is_made_of(const std::string& name, const std::string& wanted) {
  return name.starts_with(wanted) &&
         name.find_first_not_of("0123456789", wanted.size()) == std::string::npos;
}

/// Returns the arm with these joints before its own. Their links have the frame of link 0, which
/// the links behind them keep: base * exp(base^-1 S base q) = exp(S q) * base.
template <std::size_t count>
Arm behind(const Arm& arm, const std::array<BaseJoint, count>& base_joints) {
  const Pose link_T_world = arm.base().inverse(Eigen::Isometry);
  std::vector<Joint> joints;
  for (const BaseJoint& base_joint : base_joints) {
    Joint joint;
    joint.name = free_name(arm.joints(), base_joint.name, &Joint::name);
    joint.link = free_name(arm.joints(), base_joint.link, &Joint::link);
    joint.screw = adjoint(link_T_world, base_joint.world_screw);
    joint.limits = base_joint.limits;
    joints.push_back(std::move(joint));
  }
  joints.insert(joints.end(), arm.joints().begin(), arm.joints().end());
  return {arm.name(), std::move(joints), arm.tool(), arm.base(), arm.controller()};
}

}  // namespace

Arm with_rail(const Arm& arm, const Vector3& axis, const Limits& limits) {
  constexpr double shortest = 1e-9;
  const double length = axis.norm();
  if (!(length > shortest && std::isfinite(length))) {
    throw Error::of("axis", "the axis of a rail has the length " + number(length) +
                                "; it must be a finite direction, longer than " + number(shortest));
  }
  return behind(arm, std::array{BaseJoint{"rail", "carriage", translation_screw(axis), limits}});
}

bool has_moving_base(const Arm& arm) {
  if (arm.joints().empty()) return false;
  const Joint& first = arm.joints().front();
  return (is_made_of(first.name, "rail") && is_made_of(first.link, "carriage")) ||
         (is_made_of(first.name, "base_x") && is_made_of(first.link, "platform_x"));
}

Arm with_mobile_base(const Arm& arm, const MobileBase& base) {
  return behind(
      arm,
      std::array{
          BaseJoint{"base_x", "platform_x", translation_screw(Vector3::UnitX()), base.x},
          BaseJoint{"base_y", "platform_y", translation_screw(Vector3::UnitY()), base.y},
          BaseJoint{"base_heading", "platform", rotation_screw(Vector3::UnitZ()), base.heading}});
}

}  // namespace beeline
