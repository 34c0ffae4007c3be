#pragma once

#include <cmath>
#include <limits>

#include <beeline/collision/scene.h>
#include <beeline/model/arm.h>

namespace beeline::testing {

// The same quantities in more digits, by formulas of their own. They are rounded a thousand times
// finer, so they decide whether a rounded bound is above the truth.

using Wide = long double;
constexpr bool has_wide = std::numeric_limits<Wide>::digits > std::numeric_limits<double>::digits;
using WideVector = Eigen::Matrix<Wide, 3, 1>;
using WideRotation = Eigen::Matrix<Wide, 3, 3>;

struct WidePose {
  WideRotation rotation = WideRotation::Identity();
  WideVector translation = WideVector::Zero();

  WideVector operator*(const WideVector& p) const { return rotation * p + translation; }
  WidePose operator*(const WidePose& other) const {
    return {rotation * other.rotation, *this * other.translation};
  }
};

inline WidePose wide(const Pose& pose) {
  return {pose.linear().cast<Wide>(), pose.translation().cast<Wide>()};
}

/// exp(screw q): Rodrigues' formula, and the integral of the rotation along the axis.
inline WidePose wide_exp(const Twist& screw, double q) {
  const WideVector v = screw.head<3>().cast<Wide>(), w = screw.tail<3>().cast<Wide>();
  const Wide rate = std::sqrt(w.squaredNorm()), angle = rate * Wide(q);
  WidePose pose;
  if (rate == 0) {
    pose.translation = Wide(q) * v;
    return pose;
  }
  const WideVector axis = w / rate;
  WideRotation cross;
  cross << 0, -axis.z(), axis.y(), axis.z(), 0, -axis.x(), -axis.y(), axis.x(), 0;
  const Wide sine = std::sin(angle), versine = 2 * std::sin(angle / 2) * std::sin(angle / 2);
  pose.rotation += sine * cross + versine * cross * cross;
  const WideVector slide = v / rate;
  pose.translation =
      angle * slide + versine * axis.cross(slide) + (angle - sine) * axis.cross(axis.cross(slide));
  return pose;
}

/// The poses of the links in the world's axes, from the origin of the base: far from the world's
/// origin, more digits would be lost than a bound has to include.
inline std::vector<WidePose> wide_link_poses(const Arm& arm, const Configuration& q) {
  std::vector<WidePose> poses{{arm.base().linear().cast<Wide>()}};
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    const Joint& joint = arm.joints()[i];
    const auto& coupling = arm.couplings()[i];
    const double value = coupling.ratio * q[coupling.coordinate] + coupling.shift;
    poses.push_back(poses.back() * wide(joint.offset) * wide_exp(joint.screw, value));
  }
  return poses;
}

/// The maximum of n . x over the points of a shape whose frame is at `pose`; of a half-space only
/// for its normal.
struct WideSupport {
  const WideVector local;  ///< n in the axes of the shape

  Wide operator()(const Sphere& sphere) const { return sphere.radius * norm(); }
  Wide operator()(const Capsule& capsule) const {
    return capsule.radius * norm() + Wide(capsule.length) / 2 * std::abs(local.z());
  }
  Wide operator()(const Box& box) const {
    return (box.size.cast<Wide>() / 2).dot(local.cwiseAbs());
  }
  Wide operator()(const Cylinder& cylinder) const {
    return cylinder.radius * std::sqrt(local.x() * local.x() + local.y() * local.y()) +
           Wide(cylinder.length) / 2 * std::abs(local.z());
  }
  Wide operator()(const HalfSpace&) const { return 0; }
  Wide operator()(const ConvexHull& hull) const {
    Wide most = -std::numeric_limits<Wide>::infinity();
    for (const Vector3& vertex : hull.vertices) {
      most = std::max(most, local.dot(vertex.cast<Wide>()));
    }
    return most;
  }
  Wide norm() const { return std::sqrt(local.squaredNorm()); }
};

inline Wide wide_support(const Shape& shape, const WidePose& frame, const WideVector& n) {
  const WidePose pose = frame * wide(shape.pose);
  return n.dot(pose.translation) + shape.padding * std::sqrt(n.squaredNorm()) +
         std::visit(WideSupport{pose.rotation.transpose() * n}, shape.body);
}

}  // namespace beeline::testing
