#include <cmath>

#include <beeline/kinematics/chain.h>
#include <beeline/kinematics/forward.h>

namespace beeline {
namespace {

/// A joint's axis in the world when every coordinate is zero.
struct Axis {
  Vector3 direction;
  Vector3 point;
  bool anywhere = false;  ///< a slide has no place
};

Axis axis_in_world(const Joint& joint, const Pose& world_T_link) {
  const Vector3 linear = joint.screw.head<3>(), angular = joint.screw.tail<3>();
  if (angular.isZero(0)) return {world_T_link.linear() * linear, Vector3::Zero(), true};
  const Vector3 point = angular.cross(linear);  // the axis's nearest to the link's origin
  return {world_T_link.linear() * angular, world_T_link * point};
}

/// The direction about which `from` turns into `to`, or `otherwise` where they are parallel.
/// However short the cross product, its error turns `to` by rounding only.
Vector3 turning_direction(const Vector3& from, const Vector3& to, const Vector3& otherwise) {
  const Vector3 normal = from.cross(to);
  constexpr double nothing = 1e-14;
  if (normal.norm() < nothing) return (otherwise - otherwise.dot(from) * from).normalized();
  return normal.normalized();
}

Pose frame(const Vector3& x, const Vector3& z, const Vector3& origin) {
  Pose world_T_frame = Pose::Identity();
  world_T_frame.linear() << x, z.cross(x), z;
  world_T_frame.translation() = origin;
  return world_T_frame;
}

double angle_about(const Vector3& z, const Vector3& from, const Vector3& to) {
  return std::atan2(z.dot(from.cross(to)), from.dot(to));
}

}  // namespace

Chain chain_of(const Arm& arm) {
  const std::size_t n = arm.joints().size();
  std::vector<Pose> world_T_link(n + 1);
  link_poses(arm, Configuration::Zero(arm.dof()), world_T_link);
  std::vector<Axis> axes;
  for (std::size_t i = 0; i < n; ++i) {
    axes.push_back(axis_in_world(arm.joints()[i], world_T_link[i + 1]));
  }

  Chain chain;
  Vector3 z = axes[0].direction;
  Vector3 x = z.unitOrthogonal();
  Vector3 origin = axes[0].anywhere ? world_T_link[1].translation() : axes[0].point;
  chain.base = frame(x, z, origin);
  for (std::size_t i = 0; i < n; ++i) {
    const Arm::Drive& drive = arm.drives()[i];
    Chain::Link link;
    if (i > 0) {  // x is already the direction about which the axis before turns into this one
      const Pose before = frame(x, z, origin);
      const Axis& axis = axes[i];
      if (!axis.anywhere) {
        origin = axis.point + (origin - axis.point).dot(axis.direction) * axis.direction;
      }
      link.step = before.linear().transpose() * (origin - before.translation());
      const double alpha = angle_about(x, z, axis.direction);
      link.cos_alpha = std::cos(alpha);
      link.sin_alpha = std::sin(alpha);
      z = axis.direction;
    }
    const Vector3 next = i + 1 < n ? turning_direction(z, axes[i + 1].direction, x) : x;
    link.rest_angle = angle_about(z, x, next);
    x = next;
    const Joint& joint = arm.joints()[i];
    link.turn = kind(joint) == JointKind::prismatic ? 0 : drive.ratio;
    link.travel = kind(joint) == JointKind::prismatic ? drive.ratio : pitch(joint) * drive.ratio;
    link.coordinate = drive.coordinate;
    chain.links.push_back(link);
  }
  chain.tool = frame(x, z, origin).inverse() * world_T_link[n] * arm.tool();
  return chain;
}

}  // namespace beeline
