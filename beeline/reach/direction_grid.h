#pragma once

#include <vector>

#include <beeline/error.h>
#include <beeline/pose/se3.h>

namespace beeline {

/// Directions that cover the unit sphere evenly: rings at equal steps of the polar angle, from +z
/// to -z, each of a multiple of four directions at equal steps of the azimuth. The three axes and
/// their opposites are among them where the spacing divides 90 degrees.
class DirectionGrid {
 public:
  /// `spacing`: the angle between neighbours, rad, from 0.01 to pi/2; rounded so that the rings
  /// fit. Throws Error for another one.
  explicit DirectionGrid(double spacing);

  Eigen::Index size() const { return first_.back(); }
  double spacing() const { return spacing_; }

  /// The polar angle (from +z) and the azimuth (from +x towards +y) of direction k, rad.
  struct Angles {
    double polar = 0, azimuth = 0;
  };
  Angles angles(Eigen::Index k) const;
  Vector3 direction(Eigen::Index k) const;

  /// The fraction of the sphere that direction k stands for. They sum to 1.
  double fraction(Eigen::Index k) const;

  /// The direction of the ring nearest in polar angle that is nearest in azimuth: within 0.75
  /// spacings of `direction`, which need not be of unit length. Throws Error for zero.
  Eigen::Index nearest(const Vector3& direction) const;

 private:
  Eigen::Index ring_of(Eigen::Index k) const;
  Eigen::Index count(Eigen::Index ring) const { return first_[ring + 1] - first_[ring]; }

  double spacing_ = 0;
  std::vector<Eigen::Index> first_;  // of each ring, and the number of all
};

}  // namespace beeline
