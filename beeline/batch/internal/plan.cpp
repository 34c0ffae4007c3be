#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/batch/internal/plan.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/internal/chain.h>

namespace beeline::internal {
namespace {

constexpr double rounding = 1e-15, pi = std::numbers::pi;

struct Angle {
  double cosine, sine;
};

/// Replaces sines and cosines of right angles by the exact ones.
Angle cleaned(double cosine, double sine) {
  if (std::abs(sine) < rounding) return {cosine < 0 ? -1.0 : 1.0, 0};
  if (std::abs(cosine) < rounding) return {0, sine < 0 ? -1.0 : 1.0};
  return {cosine, sine};
}

Pose rotation_about(const Vector3& axis, double angle) {
  return Pose(Eigen::AngleAxisd(angle, axis));
}

template <class Real>
typename BatchPlan<Real>::Constant constant_of(const Vector3& translation, double cosine,
                                               double sine, double size) {
  using XRotation = typename BatchPlan<Real>::XRotation;
  typename BatchPlan<Real>::Constant constant;
  for (int i = 0; i < 3; ++i) {
    constant.translation[i] = static_cast<Real>(translation[i]);
    constant.translates[i] = std::abs(translation[i]) >= rounding * size;
  }
  const Angle alpha = cleaned(cosine, sine);
  constant.cos_alpha = static_cast<Real>(alpha.cosine);
  constant.sin_alpha = static_cast<Real>(alpha.sine);
  constant.rotation = XRotation::other;
  // A cosine that rounds to 1 may belong to an angle of 1e-8: the sine decides.
  if (alpha.sine == 0 && alpha.cosine > 0) constant.rotation = XRotation::none;
  if (alpha.cosine == 0 && alpha.sine < 0) constant.rotation = XRotation::minus_quarter;
  return constant;
}

template <class Real>
typename BatchPlan<Real>::Columns columns_of(const Pose& pose) {
  typename BatchPlan<Real>::Columns columns;
  Eigen::Map<Eigen::Matrix<Real, 3, 4>>(columns.number) = pose.matrix().topRows<3>().cast<Real>();
  return columns;
}

/// Returns a chain with the same motion that takes fewer operations. With the tool's rotation as
/// Rot_z(a) Rot_x(b) Rot_z(c), Rot_z(a) moves into the last link, and the constant transform of the
/// first link into the base.
Chain gathered(Chain chain) {
  const Rotation tool = chain.tool.linear();
  const double a = std::hypot(tool(0, 2), tool(1, 2)) < rounding
                       ? std::atan2(tool(1, 0), tool(0, 0))
                       : std::atan2(tool(0, 2), -tool(1, 2));
  chain.links.back().theta_offset += a;
  chain.tool = rotation_about(Vector3::UnitZ(), -a) * chain.tool;
  Chain::Link& first = chain.links.front();
  chain.base = chain.base * constant_transform(first);
  first.translation.setZero();
  first.cos_alpha = 1;
  first.sin_alpha = 0;
  // Rot_x(90 deg) = Rot_z(pi) Rot_x(-90 deg) Rot_z(pi): one kind of quarter remains.
  for (std::size_t i = 1; i < chain.links.size(); ++i) {
    Chain::Link &before = chain.links[i - 1], &link = chain.links[i];
    if (link.sin_alpha < 1 - rounding || before.theta_per_q == 0 || link.theta_per_q == 0) continue;
    before.theta_offset += pi;
    link.translation.head<2>() *= -1;
    link.sin_alpha *= -1;
    link.theta_offset += pi;
  }
  chain.base = chain.base * rotation_about(Vector3::UnitZ(), first.theta_offset);
  first.theta_offset = 0;
  return chain;
}

}  // namespace

template <class Real>
BatchPlan<Real>::BatchPlan(const Arm& arm)
    : dof(arm.dof()), in_order(chain_angles_of(arm).in_order), planar(arm.planar()) {
  const Chain chain = gathered(chain_of(arm));
  double size = chain.tool.translation().norm();
  for (const Chain::Link& link : chain.links) size = std::max(size, link.translation.norm());
  base = columns_of<Real>(chain.base);

  const std::vector<Pose> world_T_link = link_poses(arm, Configuration::Zero(arm.dof()));
  base_link = columns_of<Real>(world_T_link[0]);
  Pose world_T_frame = chain.base;
  for (const Chain::Link& from : chain.links) {
    Link link;
    link.constant = constant_of<Real>(from.translation, from.cos_alpha, from.sin_alpha, size);
    link.coordinate = from.coordinate;
    link.theta_per_q = static_cast<Real>(from.theta_per_q);
    link.d_per_q = static_cast<Real>(from.d_per_q);
    link.rotates = from.theta_per_q != 0;
    link.translates = from.d_per_q != 0;
    link.unit_rate = from.theta_per_q == 1;
    const Angle offset = cleaned(std::cos(from.theta_offset), std::sin(from.theta_offset));
    const double half_turns = std::round(from.theta_offset / pi);
    link.half_turns += static_cast<Real>(half_turns);
    link.has_remainder = offset.sine != 0;
    if (link.has_remainder) link.remainder = static_cast<Real>(from.theta_offset - half_turns * pi);
    link.remainder_by_pi = link.remainder / static_cast<Real>(pi);
    link.cos_offset = static_cast<Real>(offset.cosine);
    link.sin_offset = static_cast<Real>(offset.sine);
    links.push_back(link);
    world_T_frame = world_T_frame * link_transform(from, 0);
    frame_T_link.push_back(
        columns_of<Real>(world_T_frame.inverse(Eigen::Isometry) * world_T_link[links.size()]));
  }

  const Rotation rotation = chain.tool.linear();  // Rot_x(b) Rot_z(c)
  const Angle c = cleaned(rotation(0, 0), -rotation(0, 1));
  tool = constant_of<Real>(chain.tool.translation(), rotation(2, 2), -rotation(1, 2), size);
  rotates_tool = c.sine != 0 || c.cosine < 0;
  cos_tool = static_cast<Real>(c.cosine);
  sin_tool = static_cast<Real>(c.sine);
}

template struct BatchPlan<double>;
template struct BatchPlan<float>;

}  // namespace beeline::internal
