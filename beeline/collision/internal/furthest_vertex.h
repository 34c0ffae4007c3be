#pragma once

#include <span>

#include <beeline/pose/so3.h>

namespace beeline::internal {

/// Returns the vertex with the largest direction . vertex, to rounding; of equal ones any. Requires
/// one.
const Vector3& furthest_vertex(std::span<const Vector3> vertices, const Vector3& direction);

}  // namespace beeline::internal
