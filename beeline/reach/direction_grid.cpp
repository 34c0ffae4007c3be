#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <beeline/reach/grid.h>

namespace beeline {

using std::numbers::pi;

DirectionGrid::DirectionGrid(double spacing) {
  constexpr double finest = 0.01, coarsest = pi / 2 + 1e-9;
  if (!(spacing >= finest && spacing <= coarsest)) {
    throw Error::of("directions", "the spacing of tool directions is " + number(spacing) +
                                      " rad; it can be 0.01 to 1.5708 (0.6 to 90 degrees)");
  }
  const auto rings = static_cast<Eigen::Index>(std::round(pi / spacing));
  spacing_ = pi / static_cast<double>(rings);
  first_ = {0, 1};
  for (Eigen::Index i = 1; i < rings; ++i) {
    const double around = 2 * pi * std::sin(static_cast<double>(i) * spacing_);
    const double quarter = std::floor(around / (4 * spacing_) + 0.6);  // at least 1
    first_.push_back(first_.back() + 4 * static_cast<Eigen::Index>(quarter));
  }
  first_.push_back(first_.back() + 1);
}

Eigen::Index DirectionGrid::ring_of(Eigen::Index k) const {
  return std::upper_bound(first_.begin(), first_.end(), k) - first_.begin() - 1;
}

DirectionGrid::Angles DirectionGrid::angles(Eigen::Index k) const {
  const Eigen::Index ring = ring_of(k);
  const double step = 2 * pi / static_cast<double>(count(ring));
  return {static_cast<double>(ring) * spacing_, static_cast<double>(k - first_[ring]) * step};
}

Vector3 DirectionGrid::direction(Eigen::Index k) const {
  const Angles at = angles(k);
  return {std::sin(at.polar) * std::cos(at.azimuth), std::sin(at.polar) * std::sin(at.azimuth),
          std::cos(at.polar)};
}

double DirectionGrid::fraction(Eigen::Index k) const {
  const Eigen::Index ring = ring_of(k);
  const double polar = static_cast<double>(ring) * spacing_;
  const double upper = std::max(polar - spacing_ / 2, 0.0);
  const double lower = std::min(polar + spacing_ / 2, pi);
  return (std::cos(upper) - std::cos(lower)) / 2 / static_cast<double>(count(ring));
}

Eigen::Index DirectionGrid::nearest(const Vector3& direction) const {
  if (!(direction.norm() > 0)) throw Error("the direction is zero");
  const double polar = std::atan2(std::hypot(direction.x(), direction.y()), direction.z());
  const auto ring = static_cast<Eigen::Index>(std::round(polar / spacing_));
  const double revolution = std::atan2(direction.y(), direction.x()) / (2 * pi);
  const auto step =
      static_cast<Eigen::Index>(std::round(revolution * static_cast<double>(count(ring))));
  return first_[ring] + (step + count(ring)) % count(ring);
}

}  // namespace beeline
