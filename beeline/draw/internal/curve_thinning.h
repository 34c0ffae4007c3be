#pragma once

#include <vector>

#include <beeline/draw/paper.h>

namespace beeline::internal {

/// Returns a subset of the curve's points that looks the same on paper: no omitted point is farther
/// than a tenth of a point from the polyline through the kept ones. Of points that coincide on
/// paper only the first, lowest, highest and last are kept. The ends are kept.
std::vector<PaperPoint> thinned(const std::vector<PaperPoint>& points);

}  // namespace beeline::internal
