#pragma once

#include <beeline/draw/internal/projection.h>

namespace beeline::internal {

/// Max distance of a label's nearest edge from its point, points.
constexpr double farthest_label = 24;

/// Adds each label to `marks`, beside its point, at the position that covers the least of the marks
/// and of the previous labels. The cost of a position is the sum of covered line length, covered
/// label area, distance and the angle to the preferred direction.
void place_labels(const std::vector<Label>& labels, const Projection& projection,
                  std::vector<PaperMark>& marks);

}  // namespace beeline::internal
