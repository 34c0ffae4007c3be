#pragma once

#include <vector>

#include <beeline/draw/paper.h>

namespace beeline {

/// As few of a curve's points as still look the same: none leaves the line through those kept by
/// more than a tenth of a point, but where more lie on top of each other than paper shows. The
/// highest and the lowest of them stay, and so do the ends.
std::vector<Point> thinned(const std::vector<Point>& points);

}  // namespace beeline
