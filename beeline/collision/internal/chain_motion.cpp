#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/collision/internal/chain_motion.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/internal/chain.h>

namespace beeline::internal {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// Bounds the error of an angle or a length of this size that is computed from a coordinate.
double coordinate_rounding(double value) { return 4 * epsilon * std::abs(value); }

/// The arm with link 0 at the world's origin: far away, sums of translations lose digits.
Arm at_origin(const Arm& arm) {
  return {arm.name(), arm.joints(), arm.tool(), make_pose(Vector3::Zero(), arm.base().linear())};
}

}  // namespace

ChainMotion::ChainMotion(const Arm& arm)
    : arm_(std::make_shared<const Arm>(at_origin(arm))),
      world_origin_(arm.base().translation()),
      frames_(arm.joints().size() + 1),
      steps_(arm.joints().size() + 1),
      link_frames_(arm.joints().size() + 1, Pose::Identity()),
      rounding_(arm.joints().size() + 1),
      chain_length_(arm.joints().size() + 1) {
  const Configuration zero = Configuration::Zero(arm.dof());
  set({zero, zero, zero});
  const std::vector<Pose> links = link_poses(*arm_, zero);
  for (std::size_t i = 0; i < frames_.size(); ++i) {
    Pose frame = Pose::Identity();
    if (i > 0) frame = make_pose(frames_[i].origin, frames_[i].rotation);
    link_frames_[i] = frame.inverse() * links[i];
  }
}

void ChainMotion::set(const JointTube& tube) {
  const Chain& chain = chain_of(*arm_);
  Rotation rotation = chain.base.linear();
  Vector3 origin = chain.base.translation();
  Vector3 linear = Vector3::Zero(), angular = Vector3::Zero();
  double length = origin.norm();
  for (std::size_t i = 0; i < chain.links.size(); ++i) {
    const Chain::Link& link = chain.links[i];
    const double q = tube.middle[link.coordinate], half_motion = tube.half_motion[link.coordinate];
    const double slack = tube.slack[link.coordinate];
    const double theta = link.theta_offset + link.theta_per_q * q, d = link.d_per_q * q;
    const double c = std::cos(theta), s = std::sin(theta);
    origin += rotation * link.translation;
    const Vector3 x = rotation.col(0);
    const Vector3 y = link.cos_alpha * rotation.col(1) + link.sin_alpha * rotation.col(2);
    const Vector3 z = link.cos_alpha * rotation.col(2) - link.sin_alpha * rotation.col(1);
    rotation.col(0) = c * x + s * y;
    rotation.col(1) = c * y - s * x;
    rotation.col(2) = z;
    if (d != 0) origin += d * z;
    const double angle = link.theta_per_q * half_motion, slide = link.d_per_q * half_motion;
    linear += angle * origin.cross(z) + slide * z;
    angular += angle * z;
    length += link.translation.norm() + std::abs(d);
    frames_[i + 1] = {rotation, origin, linear, angular};
    steps_[i + 1] = {
        .angle = std::abs(angle),
        .slide = std::abs(slide),
        .angle_slack = std::abs(link.theta_per_q) * slack,
        .slide_slack = std::abs(link.d_per_q) * slack,
        .angle_rounding = coordinate_rounding(link.theta_per_q * q) + coordinate_rounding(theta),
        .slide_rounding = coordinate_rounding(d)};
    chain_length_[i + 1] = length;
  }
  set_rounding();
}

bool ChainMotion::slides(std::size_t i) const {
  const auto& links = chain_of(*arm_).links;
  return std::any_of(links.begin(), links.begin() + static_cast<std::ptrdiff_t>(i),
                     [](const Chain::Link& link) { return link.d_per_q != 0; });
}

JointReach ChainMotion::reach(const ConvexBody& body, std::size_t i, const Eigen::VectorXd& lower,
                              const Eigen::VectorXd& upper) const {
  JointReach reach{std::vector<double>(i + 1)};
  include_reach(body, i, lower, upper, reach);
  return reach;
}

void ChainMotion::include_reach(const ConvexBody& body, std::size_t i, const Eigen::VectorXd& lower,
                                const Eigen::VectorXd& upper, JointReach& largest) const {
  const Chain& chain = chain_of(*arm_);
  double from_origin = farthest_distance(body, Vector3::Zero());
  double from_axis = farthest_distance(body, Vector3::Zero(), Vector3::UnitZ());
  constexpr double outwards = 1 + 1e-12;
  for (std::size_t l = i; l > 0; --l) {
    largest.of[l] = std::max(largest.of[l], outwards * from_axis);
    const Chain::Link& link = chain.links[l - 1];
    // The origin of this frame in the frame before: the translation, and the joint's slide, whose
    // direction is this frame's z axis.
    const double slide = std::abs(link.d_per_q) * std::max(std::abs(lower[link.coordinate]),
                                                           std::abs(upper[link.coordinate]));
    from_axis = link.translation.head<2>().norm() + std::abs(link.sin_alpha) * slide + from_origin;
    from_origin += link.translation.norm() + slide;
  }
}

double ChainMotion::remainder(const JointReach& reach, std::size_t i, std::size_t j) const {
  return bounds(reach, i, j).remainder;
}

double ChainMotion::displacement(const JointReach& reach, std::size_t i, std::size_t j) const {
  return bounds(reach, i, j).displacement;
}

ChainMotion::TubeBounds ChainMotion::bounds(const JointReach& reach, std::size_t i,
                                            std::size_t j) const {
  TubeBounds bounds;
  double angle_before = 0;  // of the joints in front
  for (std::size_t l = j + 1; l <= i; ++l) {
    const JointStep& step = steps_[l];
    const double along = step.angle * reach.of[l];
    const double beside = step.angle_slack * reach.of[l] + step.slide_slack;
    bounds.displacement += along + step.slide + beside;
    bounds.remainder += step.angle * along / 2 + angle_before * (along + step.slide) + beside;
    angle_before += step.angle;
  }
  constexpr double outwards = 1 + 1e-12;
  return {outwards * bounds.displacement, outwards * bounds.remainder};
}

void ChainMotion::set_rounding() {
  double moved = 1, angle_rounding = 0, slide_rounding = 0;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    moved += steps_[i].angle + steps_[i].slide;
    angle_rounding += steps_[i].angle_rounding;
    slide_rounding += steps_[i].slide_rounding;
    // Each link multiplies by a rotation that is wrong by a few units of the last place.
    const double relative = 16 * epsilon * (static_cast<double>(i) + 2) + angle_rounding;
    rounding_[i] = {slide_rounding + relative * moved * chain_length_[i], relative * moved};
  }
}

double ChainMotion::rounding(std::size_t i, double distance) const {
  return rounding_[i].at_origin + rounding_[i].relative * distance;
}

}  // namespace beeline::internal
