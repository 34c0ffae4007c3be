#pragma once

#include <span>
#include <string>
#include <vector>

#include <beeline/draw/internal/keyframes.h>
#include <beeline/draw/internal/page_layout.h>

namespace beeline::internal {

/// The marks of one frame that a group of an SVG animation shows.
using FrameSlice = std::span<const FrameMark>;

/// Returns the elements of marks that change with the frames. `frames` has the slice of each frame
/// of the timeline. Consecutive frames with the same sources in the same order share a group. In a
/// group, the marks of a source are shared while they have the same shapes. Points and colours are
/// interpolated between keyframes. The groups of the last frame are visible without animation.
/// `tolerance`, in points: see animated_svg().
std::string moving_elements(const Timeline& timeline, const std::vector<FrameSlice>& frames,
                            double tolerance);

}  // namespace beeline::internal
