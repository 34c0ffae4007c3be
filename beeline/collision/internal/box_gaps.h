#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <beeline/collision/internal/box_tree.h>
#include <beeline/collision/internal/moving_capsule.h>

namespace beeline::internal {

/// The boxes whose gaps are computed together.
inline constexpr std::size_t boxes_at_once = 8;

/// Computes lower bounds of the distances, m, of a capsule from one to eight of the boxes, given by
/// their indices, over a joint tube: along the directions that towards() proposes, less the
/// rounding of the boxes. -infinity where the segment meets the box.
void box_gaps(const MovingCapsule& capsule, const BoxRows& boxes,
              std::span<const std::uint32_t> indices, std::array<double, boxes_at_once>& gaps);

}  // namespace beeline::internal
