#pragma once

#include <beeline/collision/internal/chain_motion.h>

namespace beeline::internal {

/// A body that a frame of the chain carries, in that frame.
struct CarriedBody {
  ConvexBody body;
  std::size_t frame = 0;
};

/// Returns the body in the world's axes, from the origin of link 0, at the middle of the tube.
ConvexBody in_world(const ChainMotion& motion, const CarriedBody& carried);

/// Returns the minimum of n . y over the body, n in the world's axes, at the middle of the tube.
double lowest_along(const ChainMotion& motion, const CarriedBody& carried, const Vector3& n);

/// Bounds from above, over the tube, the maximum of n . x over the points x of a body, where the
/// unit vector n is fixed to frame j, which is in front of the body's. To first order a point moves
/// by s (v + w x x), so the maximum is a support value in the direction n + s n x w, plus s n . v:
/// convex in s, and largest at an end of the tube. `remainder` is ChainMotion::remainder().
double highest_along(const ChainMotion& motion, const CarriedBody& carried, std::size_t j,
                     const Vector3& n, double remainder);

/// The same maximum to first order at one s.
double highest_at(const ChainMotion& motion, const CarriedBody& carried, std::size_t j,
                  const Vector3& n, double s);

}  // namespace beeline::internal
