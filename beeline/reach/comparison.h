#pragma once

#include <array>

#include <beeline/error.h>
#include <beeline/reach/slice.h>

namespace beeline {

/// What one of two maps has, at the points at which they are compared. Volumes are areas, m^2, if
/// both arms are planar.
struct ReachSide {
  double volume = 0;      ///< reached in some orientation, m^3
  double alone = 0;       ///< of it, not reached by the other
  double better = 0;      ///< where it reaches more of the directions than the other, m^3
  double directions = 0;  ///< mean fraction reached, where either arm reaches some
  /// Means of the best at each point, where both arms reach some orientation; NaN if nowhere.
  double manipulability = 0, margin = 0;
};

struct ReachComparison {
  std::array<ReachSide, 2> sides;
  double both = 0;  ///< volume that both reach, m^3
  double step = 0;  ///< between the points, m
};

/// Compares two maps, of two arms, mounts or tools, in the same world: at the centres of cells
/// along x, y and z that cover both, each map with the position that contains the point. Maps of
/// the same box are compared cell by cell. Fractions of directions are comparable between maps with
/// the same kind of orientations. Throws Error for maps of which one has headings, directions, or
/// one orientation and the other another kind, or of which one is by sampling, for an incomplete
/// one, and for more than 1e8 points.
ReachComparison compare_reach(const ReachMap& first, const ReachMap& second);

/// The slices of both maps at the same cells, as slice_of() reads them.
std::array<ReachSlice, 2> slices_of(const ReachMap& first, const ReachMap& second, int normal,
                                    double at, ReachMeasure measure = ReachMeasure::directions);

}  // namespace beeline
