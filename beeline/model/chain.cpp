#include <cmath>

#include <beeline/model/arm.h>

namespace beeline {
namespace {

bool slides(const Joint& joint) { return kind(joint) == JointKind::prismatic; }

/// The unit normal of `from` and `to`, or `otherwise` where they are parallel. It is made exactly
/// normal to `from`: then its error, however short the cross product, changes the angle to `to` by
/// rounding only.
Vector3 common_normal(const Vector3& from, const Vector3& to, const Vector3& otherwise) {
  constexpr double parallel = 1e-14;  // of the cross product, which is rounding below
  const Vector3 cross = from.cross(to);
  const Vector3 normal = cross.norm() < parallel ? otherwise : Vector3(cross.normalized());
  return (normal - normal.dot(from) * from).normalized();
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

Pose inverse(const Pose& pose) { return pose.inverse(Eigen::Isometry); }

/// The chain with these axes in the world, without theta_per_q and d_per_q of its links.
Chain frames_along(const std::vector<JointAxis>& axes, const Pose& world_T_tool) {
  Chain chain;
  Vector3 x = axes[0].direction.unitOrthogonal();
  Pose world_T_before = frame(x, axes[0].direction, axes[0].point);
  chain.base = world_T_before;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const Vector3& z = axes[i].direction;
    const Pose before = world_T_before;
    Chain::Link link;
    link.translation = inverse(before) * axes[i].point;
    // x is the common normal of the previous axis and this one.
    const double alpha = angle_about(x, before.linear().col(2), z);
    link.cos_alpha = std::cos(alpha);
    link.sin_alpha = std::sin(alpha);
    const Vector3 next = i + 1 < axes.size() ? common_normal(z, axes[i + 1].direction, x) : x;
    link.theta_offset = angle_about(z, x, next);
    link.coordinate = static_cast<int>(i);
    chain.links.push_back(link);
    x = next;
    world_T_before = frame(x, z, axes[i].point);
  }
  chain.tool = inverse(world_T_before) * world_T_tool;
  return chain;
}

}  // namespace

Pose constant_transform(const Chain::Link& link) {
  Pose pose = Pose::Identity();
  pose.linear() << 1, 0, 0, 0, link.cos_alpha, -link.sin_alpha, 0, link.sin_alpha, link.cos_alpha;
  pose.translation() = link.translation;
  return pose;
}

Pose joint_motion(const Chain::Link& link, double q) {
  const double theta = link.theta_offset + link.theta_per_q * q;
  Pose pose(Eigen::AngleAxisd(theta, Vector3::UnitZ()));
  pose.translation().z() = link.d_per_q * q;
  return pose;
}

Pose link_transform(const Chain::Link& link, double q) {
  return constant_transform(link) * joint_motion(link, q);
}

ChainAngles angles_of(const Chain& chain) {
  constexpr std::size_t lanes = 8;
  const std::size_t links = chain.links.size(), padded = (links + lanes - 1) / lanes * lanes;
  ChainAngles angles{std::vector<double>(padded, 0), std::vector<double>(padded, 1),
                     std::vector<double>(padded, 0)};
  for (std::size_t i = 0; i < links; ++i) {
    const Chain::Link& link = chain.links[i];
    angles.cos_offset[i] = std::cos(link.theta_offset);
    angles.sin_offset[i] = std::sin(link.theta_offset);
    angles.theta_per_q[i] = link.theta_per_q;
    angles.in_order = angles.in_order && link.coordinate == static_cast<int>(i);
  }
  return angles;
}

Chain chain_of(const Arm& arm) {
  const std::size_t n = arm.joints().size();
  std::vector<Pose> world_T_link(n + 1);
  world_T_link[0] = arm.base();
  for (std::size_t i = 0; i < n; ++i) {
    world_T_link[i + 1] = world_T_link[i] * joint_transform(arm.joints()[i], arm.drives()[i].shift);
  }
  std::vector<JointAxis> axes;
  Vector3 origin = world_T_link[1].translation();
  for (std::size_t i = 0; i < n; ++i) {
    const Joint& joint = arm.joints()[i];
    const Vector3 linear = joint.screw.head<3>(), angular = joint.screw.tail<3>();
    const Vector3 direction = world_T_link[i + 1].linear() * (slides(joint) ? linear : angular);
    if (!slides(joint)) {  // a prismatic joint's axis has a direction only
      const Vector3 point = world_T_link[i + 1] * angular.cross(linear);
      origin = i == 0 ? point : Vector3(point + (origin - point).dot(direction) * direction);
    }
    axes.push_back({direction, origin});
  }
  Chain chain = frames_along(axes, world_T_link[n] * arm.tool());
  for (std::size_t i = 0; i < n; ++i) {
    const Joint& joint = arm.joints()[i];
    const Arm::Drive& drive = arm.drives()[i];
    chain.links[i].theta_per_q = slides(joint) ? 0 : drive.ratio;
    chain.links[i].d_per_q = slides(joint) ? drive.ratio : pitch(joint) * drive.ratio;
    chain.links[i].coordinate = drive.coordinate;
  }
  return chain;
}

Chain chain_through(const Chain& chain, const std::vector<JointAxis>& axes) {
  const std::vector<JointAxis> own = axes_of(chain);
  Pose world_T_tool = chain.base;
  for (const Chain::Link& link : chain.links) world_T_tool = world_T_tool * link_transform(link, 0);
  Chain other = frames_along(axes, world_T_tool * chain.tool);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double sign = own[i].direction.dot(axes[i].direction) < 0 ? -1 : 1;
    other.links[i].theta_per_q = sign * chain.links[i].theta_per_q;
    other.links[i].d_per_q = sign * chain.links[i].d_per_q;
    other.links[i].coordinate = chain.links[i].coordinate;
  }
  return other;
}

std::vector<JointAxis> axes_of(const Chain& chain) {
  std::vector<JointAxis> axes;
  Pose world_T_link = chain.base;
  for (const Chain::Link& link : chain.links) {
    world_T_link = world_T_link * link_transform(link, 0);
    axes.push_back({world_T_link.linear().col(2), world_T_link.translation()});
  }
  return axes;
}

}  // namespace beeline
