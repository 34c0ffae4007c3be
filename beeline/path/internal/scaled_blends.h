#pragma once

#include <beeline/path/blend.h>

namespace beeline::internal {

/// Returns blended_lines() with smaller blends: the radius of the blend at each pose between the
/// first and the last is multiplied by its scale, from 0 to 1. With 0 the tool stops there. Of
/// poses that are passed as one the smallest scale holds. Throws Error for another scale, too.
BlendedPath scaled_blends(std::span<const Pose> poses, std::span<const Deviation> within,
                          std::span<const double> scales);

/// Throws Error for a tolerance that blended_lines() refuses.
void check_blend_tolerance(const Deviation& within);

/// Whether blended_lines() passes two consecutive poses as one.
bool passed_as_one(const Pose& pose, const Pose& before);

}  // namespace beeline::internal
