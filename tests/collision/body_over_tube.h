#pragma once

#include <beeline/collision/internal/moving_capsule.h>
#include <beeline/collision/internal/tube_gap.h>

#include <tests/collision/random_shape.h>
#include <tests/random_arm.h>

namespace beeline::testing {

/// A kind of shape that a link may have.
inline int random_finite_kind(Random& random) {
  const int kind = random.integer(0, shape_kinds - 1);
  return kind == place_of<HalfSpace>() ? place_of<ConvexHull>() : kind;
}

/// A body on the last link over a random tube with slack, and its capsule relative to a frame of
/// the chain in front of it.
struct BodyOverTube {
  Arm arm;
  Shape shape;
  internal::ConvexBody body;
  std::size_t last, first;  ///< frames
  internal::ChainMotion motion;
  Configuration middle, half_motion, slack;
  internal::MovingCapsule capsule;

  BodyOverTube(Random& random, bool relative)
      : arm(random_arm(random, random.integer(1, 7), 4)),
        shape(random_shape(random, random_finite_kind(random), 0.5, 0.5)),
        body(internal::convex_body(shape)),
        last(arm.joints().size()),
        first(relative ? static_cast<std::size_t>(random.integer(0, static_cast<int>(last) - 1))
                       : 0),
        motion(arm),
        middle(random.configuration(arm)) {
    const double size = std::pow(10, random.uniform(-4, 0));
    half_motion =
        Configuration::NullaryExpr(arm.dof(), [&] { return random.uniform(-size, size); });
    slack = Configuration::NullaryExpr(arm.dof(), [&] {
      return random.integer(0, 1) * random.uniform(0, std::max(size * size, 1e-3));
    });
    const internal::JointReach reach = motion.reach(
        body, last, Configuration::Constant(arm.dof(), -5), Configuration::Constant(arm.dof(), 5));
    motion.set({middle, half_motion, slack});
    capsule = carried_by(motion.frame(last), capsule_around(body), motion.bounds(reach, last, 0));
    if (!relative) return;
    capsule = relative_to(motion.frame(first), motion.bounds(reach, last, first), capsule);
  }

  BodyOverTube(const BodyOverTube&) = delete;  // the body refers to the shape's vertices
  BodyOverTube& operator=(const BodyOverTube&) = delete;

  /// The frames at s on the line and at a corner of the slack.
  internal::ChainMotion at(double s, Random& random) const {
    Configuration q = middle + s * half_motion;
    for (Eigen::Index k = 0; k < q.size(); ++k) q[k] += random.integer(-1, 1) * slack[k];
    const Configuration none = Configuration::Zero(arm.dof());
    internal::ChainMotion still(arm);
    still.set({q, none, none});
    return still;
  }
};

}  // namespace beeline::testing
