#pragma once

#include <array>

#include <beeline/reach/grid.h>

namespace beeline::internal {

/// The slabs of a grid, in which its map is computed, compressed and stored: boxes of positions,
/// each a range of position numbers. There are about a thousand, of 2^16 to 2^22 cells; of a
/// cylindrical grid, whose azimuths are stored as one, of 2^16 to 2^18 times the azimuths.
class Slabs {
 public:
  explicit Slabs(const ReachGrid& grid);

  Eigen::Index count() const { return per_x_ * per_row_ * per_column_; }
  /// The positions of slab s: from first(s) to last(s), exclusive.
  Eigen::Index first(Eigen::Index s) const;
  Eigen::Index last(Eigen::Index s) const;
  Eigen::Index slab_of(Eigen::Index position) const;

  /// The positions of a slab along ReachGrid::axes(); the last one along an axis has those left.
  const std::array<Eigen::Index, 3>& edges() const { return edges_; }
  /// The first of them along each axis.
  std::array<Eigen::Index, 3> begin(Eigen::Index s) const;
  /// The positions of slab s along each axis.
  std::array<Eigen::Index, 3> size(Eigen::Index s) const;

 private:
  std::array<Eigen::Index, 3> cells_, edges_;
  Eigen::Index per_x_, per_row_, per_column_;  // slabs along x, y and z
};

}  // namespace beeline::internal
