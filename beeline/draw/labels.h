#pragma once

#include <beeline/draw/projection.h>

namespace beeline {

/// The farthest that a label is put from its point, measured to its nearest edge, in points.
constexpr double farthest_label = 24;

/// Puts each label beside its point where it covers least of `marks` and of the labels before it.
void place_labels(const std::vector<Label>& labels, const Projection& projection,
                  std::vector<Mark>& marks);

}  // namespace beeline
