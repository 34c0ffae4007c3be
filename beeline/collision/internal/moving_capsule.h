#pragma once

#include <algorithm>
#include <cmath>

#include <beeline/collision/internal/bounding_capsule.h>
#include <beeline/collision/internal/chain_motion.h>

namespace beeline::internal {

/// A bounding capsule over a joint tube, in the world's axes from the origin of link 0: where it is
/// at the middle, and its motion relative to a frame of the chain along the half motion, to first
/// order.
struct MovingCapsule {
  BoundingCapsule at_middle;
  Vector3 velocity = Vector3::Zero();            ///< of the centre
  Vector3 half_axis_velocity = Vector3::Zero();  ///< of an end of the axis relative to the centre
  Vector3 angular = Vector3::Zero();             ///< rotation vector
  ChainMotion::TubeBounds bounds;                ///< of all points relative to the frame
};

/// A vector whose square is less gives no unit vector: its square has lost digits.
inline constexpr double least_square = 1e-200;

/// Returns the motion relative to the base of a capsule that a frame carries, for which `bounds`
/// are.
inline MovingCapsule carried_by(const ChainMotion::Frame& frame, const BoundingCapsule& capsule,
                                const ChainMotion::TubeBounds& bounds) {
  MovingCapsule moving{.at_middle = {frame.origin + frame.rotation * capsule.centre,
                                     frame.rotation * capsule.half_axis, capsule.radius},
                       .angular = frame.angular,
                       .bounds = bounds};
  moving.velocity = frame.linear + frame.angular.cross(moving.at_middle.centre);
  moving.half_axis_velocity = frame.angular.cross(moving.at_middle.half_axis);
  return moving;
}

/// Returns the motion relative to another frame, for which `bounds` are.
inline MovingCapsule relative_to(const ChainMotion::Frame& frame,
                                 const ChainMotion::TubeBounds& bounds, MovingCapsule capsule) {
  capsule.velocity -= frame.linear + frame.angular.cross(capsule.at_middle.centre);
  capsule.half_axis_velocity -= frame.angular.cross(capsule.at_middle.half_axis);
  capsule.angular -= frame.angular;
  capsule.bounds = bounds;
  return capsule;
}

/// Bounds from above, over the tube, the maximum of n . x over the points x of the capsule, where
/// the unit vector n is fixed to the frame: by the first-order motion of tube_gap.h and its
/// remainder, or by the largest displacement, whichever is less. With u the half axis and
/// w the rotation vector, the support value in the direction n + s n x w is
///     n . c + s n . v + max_a a (n . u + s n . (w x u)) + r sqrt(1 + s^2 |n x w|^2),  a = -1, 1,
/// with sqrt(1 + x) <= 1 + x / 2. The tilt of n is |n x w|.
inline double highest_along(const MovingCapsule& capsule, const Vector3& n) {
  const BoundingCapsule& at = capsule.at_middle;
  const double along = n.dot(at.half_axis), sideways = n.dot(capsule.half_axis_velocity);
  const double forwards = n.dot(capsule.velocity), about_n = n.dot(capsule.angular);
  const double tilt_squared = std::max(0.0, capsule.angular.squaredNorm() - about_n * about_n);
  const double ends =
      std::max(along + std::abs(forwards + sideways), -along + std::abs(forwards - sideways));
  const double first_order = ends + at.radius * (1 + tilt_squared / 2) + capsule.bounds.remainder;
  const double largest = std::abs(along) + at.radius + capsule.bounds.displacement;
  return n.dot(at.centre) + std::min(first_order, largest);
}

/// The minimum of n . x over the points of a capsule at rest.
inline double lowest_along(const BoundingCapsule& capsule, const Vector3& n) {
  return n.dot(capsule.centre) - std::abs(n.dot(capsule.half_axis)) - capsule.radius;
}

inline Vector3 nearest_on_segment(const BoundingCapsule& capsule, const Vector3& point) {
  const double length = capsule.half_axis.squaredNorm();
  if (!(length > 0)) return capsule.centre;
  const double t = (point - capsule.centre).dot(capsule.half_axis) / length;
  return capsule.centre + std::clamp(t, -1.0, 1.0) * capsule.half_axis;
}

/// Proposes a vector from the capsule's segment to a body: between the last points of three
/// projections (Cheney and Goldstein, "Proximity maps for convex sets", 1959). `project` returns
/// the point of the body nearest to a point. 0 if they meet.
template <class Projection>
Vector3 towards(const BoundingCapsule& capsule, const Vector3& centre, const Projection& project) {
  Vector3 point = nearest_on_segment(capsule, centre);
  Vector3 other = project(point);
  if (!capsule.half_axis.isZero(0)) {
    point = nearest_on_segment(capsule, other);
    other = project(point);
  }
  return other - point;
}

/// Returns the shortest vector from a capsule's segment to another's.
inline Vector3 towards(const BoundingCapsule& capsule, const BoundingCapsule& other) {
  const SegmentPoints nearest = nearest_on_segments(capsule, other);
  return nearest.on_b - nearest.on_a;
}

}  // namespace beeline::internal
