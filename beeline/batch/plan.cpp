#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/batch/plan.h>
#include <beeline/kinematics/forward.h>

namespace beeline {
namespace {

constexpr double nothing = 1e-15, pi = std::numbers::pi;

struct Angle {
  double cosine, sine;
};

/// Right angles are right angles.
Angle cleaned(double cosine, double sine) {
  if (std::abs(sine) < nothing) return {cosine < 0 ? -1.0 : 1.0, 0};
  if (std::abs(cosine) < nothing) return {0, sine < 0 ? -1.0 : 1.0};
  return {cosine, sine};
}

Pose turned(const Vector3& axis, double angle) { return Pose(Eigen::AngleAxisd(angle, axis)); }

template <class Real>
typename BatchPlan<Real>::Move move_of(const Vector3& step, double cosine, double sine,
                                       double size) {
  using Bend = typename BatchPlan<Real>::Bend;
  typename BatchPlan<Real>::Move move;
  for (int i = 0; i < 3; ++i) {
    move.step[i] = static_cast<Real>(step[i]);
    move.steps[i] = std::abs(step[i]) >= nothing * size;
  }
  const Angle alpha = cleaned(cosine, sine);
  move.cos_alpha = static_cast<Real>(alpha.cosine);
  move.sin_alpha = static_cast<Real>(alpha.sine);
  move.bend = Bend::other;
  // A cosine of 1 may belong to an angle of 1e-8: the sine tells.
  if (alpha.sine == 0 && alpha.cosine > 0) move.bend = Bend::none;
  if (alpha.cosine == 0 && alpha.sine < 0) move.bend = Bend::quarter;
  return move;
}

template <class Real>
typename BatchPlan<Real>::Columns columns_of(const Pose& pose) {
  typename BatchPlan<Real>::Columns columns;
  Eigen::Map<Eigen::Matrix<Real, 3, 4>>(columns.number) = pose.matrix().topRows<3>().cast<Real>();
  return columns;
}

/// Of the tool, turn_z(a) turn_x(b) turn_z(c), the first turn goes into the last link, and the
/// constant start of the first link into the base.
Chain gathered(Chain chain) {
  const Rotation tool = chain.tool.linear();
  const double a = std::hypot(tool(0, 2), tool(1, 2)) < nothing
                       ? std::atan2(tool(1, 0), tool(0, 0))
                       : std::atan2(tool(0, 2), -tool(1, 2));
  chain.links.back().theta_offset += a;
  chain.tool = turned(Vector3::UnitZ(), -a) * chain.tool;
  Chain::Link& first = chain.links.front();
  chain.base = chain.base * constant_transform(first);
  first.translation.setZero();
  first.cos_alpha = 1;
  first.sin_alpha = 0;
  // Bends by 90 degrees become bends by -90: half a turn about z before and behind them.
  for (std::size_t i = 1; i < chain.links.size(); ++i) {
    Chain::Link &before = chain.links[i - 1], &link = chain.links[i];
    if (link.sin_alpha < 1 - nothing || before.theta_per_q == 0 || link.theta_per_q == 0) continue;
    before.theta_offset += pi;
    link.translation.head<2>() *= -1;
    link.sin_alpha *= -1;
    link.theta_offset += pi;
  }
  chain.base = chain.base * turned(Vector3::UnitZ(), first.theta_offset);
  first.theta_offset = 0;
  return chain;
}

}  // namespace

template <class Real>
BatchPlan<Real>::BatchPlan(const Arm& arm)
    : dof(arm.dof()), in_order(arm.chain_angles().in_order), planar(arm.planar()) {
  const Chain chain = gathered(arm.chain());
  double size = chain.tool.translation().norm();
  for (const Chain::Link& link : chain.links) size = std::max(size, link.translation.norm());
  base = columns_of<Real>(chain.base);

  const std::vector<Pose> world_T_link = link_poses(arm, Configuration::Zero(arm.dof()));
  base_link = columns_of<Real>(world_T_link[0]);
  Pose world_T_frame = chain.base;
  for (const Chain::Link& from : chain.links) {
    Link link;
    link.move = move_of<Real>(from.translation, from.cos_alpha, from.sin_alpha, size);
    link.coordinate = from.coordinate;
    link.turn = static_cast<Real>(from.theta_per_q);
    link.travel = static_cast<Real>(from.d_per_q);
    link.turns = from.theta_per_q != 0;
    link.slides = from.d_per_q != 0;
    link.plain = from.theta_per_q == 1;
    const Angle rest = cleaned(std::cos(from.theta_offset), std::sin(from.theta_offset));
    const double half_turns = std::round(from.theta_offset / pi);
    link.whole += static_cast<Real>(half_turns);
    link.bent = rest.sine != 0;
    if (link.bent) link.rest = static_cast<Real>(from.theta_offset - half_turns * pi);
    link.rest_by_pi = link.rest / static_cast<Real>(pi);
    link.cos_angle = static_cast<Real>(rest.cosine);
    link.sin_angle = static_cast<Real>(rest.sine);
    links.push_back(link);
    world_T_frame = world_T_frame * link_transform(from, 0);
    frame_T_link.push_back(
        columns_of<Real>(world_T_frame.inverse(Eigen::Isometry) * world_T_link[links.size()]));
  }

  const Rotation rotation = chain.tool.linear();  // turn_x(b) turn_z(c)
  const Angle c = cleaned(rotation(0, 0), -rotation(0, 1));
  tool = move_of<Real>(chain.tool.translation(), rotation(2, 2), -rotation(1, 2), size);
  turns_tool = c.sine != 0 || c.cosine < 0;
  cos_tool = static_cast<Real>(c.cosine);
  sin_tool = static_cast<Real>(c.sine);
}

template struct BatchPlan<double>;
template struct BatchPlan<float>;

template <class Real>
Eigen::Index batch_work(const BatchPlan<Real>& plan) {
  const auto links = static_cast<Eigen::Index>(plan.links.size());
  // Coordinates, sines and cosines, axes; results; two buffers on their way, and a line's rest.
  const Eigen::Index columns = 6 * plan.dof, poses = 16 * (links + 1);
  return batch_width *
         (plan.dof + 8 * links + std::max<Eigen::Index>(16, columns) + 2 * (columns + poses + 2));
}
template Eigen::Index batch_work(const BatchPlan<double>&);
template Eigen::Index batch_work(const BatchPlan<float>&);

}  // namespace beeline
