#pragma once

#include <string>

#include <beeline/pose/so3.h>

namespace beeline::internal {

/// Whether the axis, finite numbers of any length, has a direction: its length exceeds 1e-9.
bool has_direction(const Vector3& axis);

/// Returns the clause of a message about an axis without one: `axis 0 0 0 has no direction; ...`.
std::string no_direction(const Vector3& axis);

}  // namespace beeline::internal
