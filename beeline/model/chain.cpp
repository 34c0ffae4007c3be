#include <cmath>

#include <beeline/model/arm.h>

namespace beeline {
namespace {

bool slides(const Joint& joint) { return kind(joint) == JointKind::prismatic; }

/// The direction about which `from` turns into `to`, or `otherwise` where they are parallel.
/// However short the cross product, its error turns `to` by rounding only, once what of it is along
/// `from` is taken out.
Vector3 turning_direction(const Vector3& from, const Vector3& to, const Vector3& otherwise) {
  constexpr double nothing = 1e-14;
  const Vector3 cross = from.cross(to);
  const Vector3 normal = cross.norm() < nothing ? otherwise : Vector3(cross.normalized());
  return (normal - normal.dot(from) * from).normalized();
}

Pose frame(const Vector3& x, const Vector3& z, const Vector3& origin) {
  Pose world_T_frame = Pose::Identity();
  world_T_frame.linear() << x, z.cross(x), z;
  world_T_frame.translation() = origin;
  return world_T_frame;
}

/// The link's motion when its coordinate is zero.
Pose at_rest(const Chain::Link& link) {
  Pose pose = Pose::Identity();
  pose.linear() << 1, 0, 0, 0, link.cos_alpha, -link.sin_alpha, 0, link.sin_alpha, link.cos_alpha;
  pose.linear() = pose.linear() * Eigen::AngleAxisd(link.rest_angle, Vector3::UnitZ());
  pose.translation() = link.step;
  return pose;
}

double angle_about(const Vector3& z, const Vector3& from, const Vector3& to) {
  return std::atan2(z.dot(from.cross(to)), from.dot(to));
}

Pose inverse(const Pose& pose) { return pose.inverse(Eigen::Isometry); }

/// The chain along the axes that are given in the world: all but what drives the links.
Chain frames_along(const std::vector<JointAxis>& axes, const Pose& world_T_tool) {
  Chain chain;
  Vector3 x = axes[0].direction.unitOrthogonal();
  Pose world_T_before = frame(x, axes[0].direction, axes[0].point);
  chain.base = world_T_before;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const Vector3& z = axes[i].direction;
    const Pose before = world_T_before;
    Chain::Link link;
    link.step = inverse(before) * axes[i].point;
    // x is already the direction about which the axis before turns into this one.
    const double alpha = angle_about(x, before.linear().col(2), z);
    link.cos_alpha = std::cos(alpha);
    link.sin_alpha = std::sin(alpha);
    const Vector3 next = i + 1 < axes.size() ? turning_direction(z, axes[i + 1].direction, x) : x;
    link.rest_angle = angle_about(z, x, next);
    link.coordinate = static_cast<int>(i);
    chain.links.push_back(link);
    x = next;
    world_T_before = frame(x, z, axes[i].point);
  }
  chain.tool = inverse(world_T_before) * world_T_tool;
  return chain;
}

}  // namespace

ChainAngles angles_of(const Chain& chain) {
  constexpr std::size_t lanes = 8;
  const std::size_t links = chain.links.size(), room = (links + lanes - 1) / lanes * lanes;
  ChainAngles angles{std::vector<double>(room, 0), std::vector<double>(room, 1),
                     std::vector<double>(room, 0)};
  for (std::size_t i = 0; i < links; ++i) {
    const Chain::Link& link = chain.links[i];
    angles.cos_rest[i] = std::cos(link.rest_angle);
    angles.sin_rest[i] = std::sin(link.rest_angle);
    angles.turn[i] = link.turn;
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
    if (!slides(joint)) {  // a slide has no place
      const Vector3 point = world_T_link[i + 1] * angular.cross(linear);
      origin = i == 0 ? point : Vector3(point + (origin - point).dot(direction) * direction);
    }
    axes.push_back({direction, origin});
  }
  Chain chain = frames_along(axes, world_T_link[n] * arm.tool());
  for (std::size_t i = 0; i < n; ++i) {
    const Joint& joint = arm.joints()[i];
    const Arm::Drive& drive = arm.drives()[i];
    chain.links[i].turn = slides(joint) ? 0 : drive.ratio;
    chain.links[i].travel = slides(joint) ? drive.ratio : pitch(joint) * drive.ratio;
    chain.links[i].coordinate = drive.coordinate;
  }
  return chain;
}

Chain chain_through(const Chain& chain, const std::vector<JointAxis>& axes) {
  const std::vector<JointAxis> own = axes_of(chain);
  Pose world_T_tool = chain.base;
  for (const Chain::Link& link : chain.links) world_T_tool = world_T_tool * at_rest(link);
  Chain other = frames_along(axes, world_T_tool * chain.tool);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const double sign = own[i].direction.dot(axes[i].direction) < 0 ? -1 : 1;
    other.links[i].turn = sign * chain.links[i].turn;
    other.links[i].travel = sign * chain.links[i].travel;
    other.links[i].coordinate = chain.links[i].coordinate;
  }
  return other;
}

std::vector<JointAxis> axes_of(const Chain& chain) {
  std::vector<JointAxis> axes;
  Pose world_T_link = chain.base;
  for (const Chain::Link& link : chain.links) {
    world_T_link = world_T_link * at_rest(link);
    axes.push_back({world_T_link.linear().col(2), world_T_link.translation()});
  }
  return axes;
}

}  // namespace beeline
