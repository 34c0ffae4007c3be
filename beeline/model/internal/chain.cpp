#include <cmath>

#include <beeline/model/internal/chain.h>
#include <beeline/model/internal/joint_axes.h>

namespace beeline::internal {
namespace {

// An arm keeps at most 64 kB: the seeds of a search take 48 kB, the closed forms some hundred
// bytes.
constexpr std::size_t max_bytes_of_arm = 56 * 1024;
constexpr std::size_t max_bytes_of_geometry = 7 * 1024;
constexpr std::size_t max_bytes_of_links = 1024;

bool slides(const Joint& joint) { return kind(joint) == JointKind::prismatic; }

}  // namespace

ArmMemory::ArmMemory(Chain arm_chain, ChainAngles chain_angles)
    : chain(std::move(arm_chain)),
      angles(std::move(chain_angles)),
      of_arm(max_bytes_of_arm,
             sizeof(ArmMemory) + heap_bytes(chain.links) + 3 * heap_bytes(angles.cos_offset)),
      of_geometry(std::make_shared<KeptObjects>(max_bytes_of_geometry, sizeof(KeptObjects))),
      of_links(std::make_shared<KeptObjects>(max_bytes_of_links, sizeof(KeptObjects))) {}

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

Chain make_chain(const Arm& arm) {
  const std::size_t n = arm.joints().size();
  std::vector<Pose> world_T_link(n + 1);
  world_T_link[0] = arm.base();
  for (std::size_t i = 0; i < n; ++i) {
    world_T_link[i + 1] =
        world_T_link[i] * joint_transform(arm.joints()[i], arm.couplings()[i].shift);
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
  Chain chain = chain_along(axes, world_T_link[n] * arm.tool());
  for (std::size_t i = 0; i < n; ++i) {
    const Joint& joint = arm.joints()[i];
    const Arm::JointCoupling& coupling = arm.couplings()[i];
    chain.links[i].theta_per_q = slides(joint) ? 0 : coupling.ratio;
    chain.links[i].d_per_q = slides(joint) ? coupling.ratio : pitch(joint) * coupling.ratio;
    chain.links[i].coordinate = coupling.coordinate;
  }
  return chain;
}

}  // namespace beeline::internal
