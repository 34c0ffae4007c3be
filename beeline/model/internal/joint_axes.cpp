#include <cmath>

#include <beeline/model/internal/joint_axes.h>

namespace beeline::internal {
namespace {

/// The unit normal of `from` and `to`, or `otherwise` where they are parallel. It is made exactly
/// normal to `from`: then its error, however short the cross product, changes the angle to `to` by
/// rounding only.
Vector3 common_normal(const Vector3& from, const Vector3& to, const Vector3& otherwise) {
  constexpr double parallel = 1e-14;  // of the cross product, which is rounding below
  const Vector3 cross = from.cross(to);
  const Vector3 normal = cross.norm() < parallel ? otherwise : Vector3(cross.normalized());
  return (normal - normal.dot(from) * from).normalized();
}

double angle_about(const Vector3& z, const Vector3& from, const Vector3& to) {
  return std::atan2(z.dot(from.cross(to)), from.dot(to));
}

Pose inverse(const Pose& pose) { return pose.inverse(Eigen::Isometry); }

}  // namespace

Pose frame_along(const Vector3& x, const Vector3& z, const Vector3& origin) {
  Pose world_T_frame = Pose::Identity();
  world_T_frame.linear() << x, z.cross(x), z;
  world_T_frame.translation() = origin;
  return world_T_frame;
}

Chain chain_along(const std::vector<JointAxis>& axes, const Pose& world_T_tool) {
  Chain chain;
  Vector3 x = axes[0].direction.unitOrthogonal();
  Pose world_T_before = frame_along(x, axes[0].direction, axes[0].point);
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
    world_T_before = frame_along(x, z, axes[i].point);
  }
  chain.tool = inverse(world_T_before) * world_T_tool;
  return chain;
}

Chain chain_through(const Chain& chain, const std::vector<JointAxis>& axes) {
  const std::vector<JointAxis> own = axes_of(chain);
  Pose world_T_tool = chain.base;
  for (const Chain::Link& link : chain.links) world_T_tool = world_T_tool * link_transform(link, 0);
  Chain other = chain_along(axes, world_T_tool * chain.tool);
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

}  // namespace beeline::internal
