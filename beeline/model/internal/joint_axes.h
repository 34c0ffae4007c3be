#pragma once

#include <vector>

#include <beeline/model/internal/chain.h>

namespace beeline::internal {

/// A joint's axis in the world at q = 0: a line through `point`.
struct JointAxis {
  Vector3 direction;  ///< unit length
  Vector3 point;      ///< metres
};
std::vector<JointAxis> axes_of(const Chain& chain);

/// Returns the frame at `origin` with these x and z axes, of unit length and normal to each other.
Pose frame_along(const Vector3& x, const Vector3& z, const Vector3& origin);

/// Returns the chain with these axes in the world, without theta_per_q and d_per_q of its links.
Chain chain_along(const std::vector<JointAxis>& axes, const Pose& world_T_tool);

/// Returns a chain with the same motion whose link frames have their origins at the given points
/// and their z axes along the given directions. Each point lies on its joint's axis, and each
/// direction is parallel or antiparallel to the axis.
Chain chain_through(const Chain& chain, const std::vector<JointAxis>& axes);

}  // namespace beeline::internal
