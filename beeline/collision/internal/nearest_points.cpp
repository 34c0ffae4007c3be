#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>

#include <beeline/collision/internal/bounding_capsule.h>
#include <beeline/collision/internal/nearest_points.h>

namespace beeline::internal {
namespace {

using Core = ConvexBody::Core;

/// A point a - b of the Minkowski difference of two cores.
struct DifferencePoint {
  Vector3 difference, on_a, on_b;
};

DifferencePoint difference_support(const ConvexBody& a, const ConvexBody& b,
                                   const Vector3& direction) {
  const Vector3 on_a = core_support(a, direction), on_b = core_support(b, -direction);
  return {on_a - on_b, on_a, on_b};
}

/// One to four points with the weights of the point of their hull that is nearest to the origin.
class Simplex {
 public:
  int size() const { return size_; }

  void add(const DifferencePoint& point) { points_[static_cast<std::size_t>(size_++)] = point; }

  bool has(const Vector3& difference) const {
    return std::any_of(points_.begin(), points_.begin() + size_,
                       [&](const auto& point) { return point.difference == difference; });
  }

  /// Drops the points without weight.
  void reduce() {
    switch (size_) {
      case 1:
        weights_[0] = 1;
        break;
      case 2:
        reduce_segment();
        break;
      case 3:
        reduce_triangle();
        break;
      default:
        reduce_tetrahedron();
    }
  }

  /// Returns its nearest point as a simplex of one point.
  Simplex collapsed() const {
    Simplex point;
    point.add({nearest(), on_a(), on_b()});
    point.weights_[0] = 1;
    return point;
  }

  Vector3 nearest() const { return sum(&DifferencePoint::difference); }

  /// Returns the unit vector from the nearest point to the origin, which is not in the simplex. It
  /// is at right angles to the edges. Of a nearest point close to the origin few digits remain, but
  /// the edges have theirs.
  Vector3 towards_origin() const {
    Vector3 direction = -nearest();
    if (size_ == 2) {
      const Vector3 along = (at(1) - at(0)).normalized();
      for (int i = 0; i < 2; ++i) direction -= direction.dot(along) * along;
    } else if (size_ == 3) {
      const Vector3 ab = at(1) - at(0), ac = at(2) - at(0);
      const Vector3 normal = ab.cross(ac);
      if (normal.norm() > 1e-10 * ab.norm() * ac.norm()) {
        direction = at(0).dot(normal) > 0 ? Vector3(-normal) : normal;
      }
    }
    const double length = direction.norm();
    return length > 0 ? Vector3(direction / length) : Vector3(-nearest().normalized());
  }

  Vector3 on_a() const { return sum(&DifferencePoint::on_a); }
  Vector3 on_b() const { return sum(&DifferencePoint::on_b); }
  const Vector3& of_b(int i) const { return points_[static_cast<std::size_t>(i)].on_b; }

 private:
  const Vector3& at(int i) const { return points_[static_cast<std::size_t>(i)].difference; }

  Vector3 sum(Vector3 DifferencePoint::*member) const {
    Vector3 total = Vector3::Zero();
    for (std::size_t i = 0; i < static_cast<std::size_t>(size_); ++i) {
      total += weights_[i] * points_[i].*member;
    }
    return total;
  }

  void keep(std::initializer_list<int> indices, std::initializer_list<double> weights) {
    std::array<DifferencePoint, 4> kept;
    std::size_t n = 0;
    for (const int i : indices) kept[n++] = points_[static_cast<std::size_t>(i)];
    std::copy_n(kept.begin(), n, points_.begin());
    std::copy(weights.begin(), weights.end(), weights_.begin());
    size_ = static_cast<int>(n);
  }

  void reduce_segment() {
    const Vector3 along = at(1) - at(0);
    const double length = along.squaredNorm();
    const double t = length > 0 ? -at(0).dot(along) / length : 0;
    if (t <= 0) return keep({0}, {1});
    if (t >= 1) return keep({1}, {1});
    weights_ = {1 - t, t};
  }

  /// The regions of Ericson, "Real-Time Collision Detection" (2005), section 5.1.5.
  void reduce_triangle() {
    const Vector3 ab = at(1) - at(0), ac = at(2) - at(0);
    const double d1 = -ab.dot(at(0)), d2 = -ac.dot(at(0));
    if (d1 <= 0 && d2 <= 0) return keep({0}, {1});
    const double d3 = -ab.dot(at(1)), d4 = -ac.dot(at(1));
    if (d3 >= 0 && d4 <= d3) return keep({1}, {1});
    const double d5 = -ab.dot(at(2)), d6 = -ac.dot(at(2));
    if (d6 >= 0 && d5 <= d6) return keep({2}, {1});
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) {
      const double t = d1 / (d1 - d3);
      return keep({0, 1}, {1 - t, t});
    }
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0 && d2 >= 0 && d6 <= 0) {
      const double t = d2 / (d2 - d6);
      return keep({0, 2}, {1 - t, t});
    }
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0) {
      const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
      return keep({1, 2}, {1 - t, t});
    }
    set_weights({va, vb, vc});
    refine();
  }

  /// The nearest of the four faces, unless the origin is inside.
  void reduce_tetrahedron() {
    constexpr int faces[4][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};
    Simplex best;
    double least = std::numeric_limits<double>::infinity();
    for (const auto& face : faces) {
      const Vector3 normal = (at(face[1]) - at(face[0])).cross(at(face[2]) - at(face[0]));
      const double inner = normal.dot(at(face[3]) - at(face[0]));
      const double origin = -normal.dot(at(face[0]));
      // A flat tetrahedron does not show the side of the face where the origin is.
      const double rounding = 1e-12 * normal.norm() * at(face[0]).norm();
      if ((inner > rounding && origin > rounding) || (inner < -rounding && origin < -rounding)) {
        continue;
      }
      Simplex part;
      for (int i = 0; i < 3; ++i) part.add(points_[static_cast<std::size_t>(face[i])]);
      part.reduce();
      const double size = part.nearest().squaredNorm();
      if (size < least) least = size, best = part;
    }
    if (best.size_ > 0) {
      *this = best;
    } else {
      set_weights_of_origin();
    }
  }

  /// The weights of the origin, which is inside the tetrahedron.
  void set_weights_of_origin() {
    const auto volume = [&](const Vector3& p, const Vector3& q, const Vector3& r) {
      return std::abs(p.cross(q).dot(r));
    };
    set_weights({volume(at(1), at(2), at(3)), volume(at(0), at(2), at(3)),
                 volume(at(0), at(1), at(3)), volume(at(0), at(1), at(2))});
    refine();
  }

  /// Changes the weights of three or four points by Newton's step for the least |nearest()| in
  /// their plane or space: the proportions above lose digits where the points are far from the
  /// origin and some of them are close to each other.
  void refine() {
    constexpr double enough = 1e-15;
    for (int step = 0; step < 2 && size_ >= 3; ++step) {
      const Vector3 point = nearest();
      Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3> edges(3, size_ - 1);
      double along = 0;  // 0 at the nearest point
      for (int i = 1; i < size_; ++i) {
        const Vector3 edge = at(i) - at(0);
        edges.col(i - 1) = edge;
        along = std::max(along, std::abs(point.dot(edge)) / edge.norm());
      }
      if (!(along > enough * at(0).norm())) return;
      const Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> change =
          edges.colPivHouseholderQr().solve(-point);
      std::array<double, 4> refined = weights_;
      for (int i = 1; i < size_; ++i) {
        refined[static_cast<std::size_t>(i)] += change[i - 1];
        refined[0] -= change[i - 1];
      }
      Simplex other = *this;
      other.set_weights(refined);
      if (!(other.nearest().squaredNorm() < point.squaredNorm())) return;
      *this = other;
    }
  }

  /// Sets weights in these proportions. Weighted means are points of the bodies only if no weight
  /// is negative and their sum is 1, also where rounding gives other proportions.
  void set_weights(const std::array<double, 4>& proportions) {
    double total = 0;
    for (const double proportion : proportions) total += std::max(proportion, 0.0);
    if (!(total > 0)) return collapse_to_first();
    for (std::size_t i = 0; i < 4; ++i) weights_[i] = std::max(proportions[i], 0.0) / total;
  }

  void collapse_to_first() { keep({0}, {1}); }

  std::array<DifferencePoint, 4> points_;
  std::array<double, 4> weights_{};
  int size_ = 0;
};

/// The simplex whose nearest point to the origin is the difference of the nearest points, and the
/// direction, from `a` to `b`, that proves the largest distance of those that were tried.
struct FoundSimplex {
  Simplex simplex;
  Vector3 direction = Vector3::Zero();  ///< zero: none was tried
};

/// Ends early where `is_enough`, called with a lower and an upper bound of the distance, is true.
template <class IsEnough>
FoundSimplex search(const ConvexBody& a, const ConvexBody& b, const Vector3& guess,
                    const IsEnough& is_enough) {
  constexpr int max_steps = 128;
  constexpr double relative = 1e-13, of_size = 1e-15;
  const double size = a.bound + b.bound + (a.centre - b.centre).norm();
  Simplex simplex;
  simplex.add(difference_support(a, b, guess));
  simplex.reduce();
  FoundSimplex best{simplex};
  Vector3 nearest = simplex.nearest();
  double proved = -std::numeric_limits<double>::infinity();
  for (int step = 0; step < max_steps; ++step) {
    const double distance = nearest.norm();
    if (distance <= of_size * size || simplex.size() == 4) break;
    const Vector3 direction = simplex.towards_origin();
    const DifferencePoint next = difference_support(a, b, direction);
    const double bound = -direction.dot(next.difference);
    if (bound > proved) proved = bound, best.direction = direction;
    if (is_enough(proved, distance)) break;
    if (distance - bound <= relative * distance + of_size * size) break;
    if (simplex.has(next.difference)) break;
    simplex.add(next);
    simplex.reduce();
    if (!(simplex.nearest().norm() < distance)) {
      // A simplex of nearly coinciding points is flat to rounding: go on from the nearest point.
      simplex = best.simplex.collapsed();
      simplex.add(next);
      simplex.reduce();
      if (!(simplex.nearest().norm() < distance)) break;
    }
    nearest = simplex.nearest();
    best.simplex = simplex;
  }
  return best;
}

FoundSimplex search(const ConvexBody& a, const ConvexBody& b, const Vector3& guess) {
  return search(a, b, guess, [](double, double) { return false; });
}

/// The nearest points of two cores, and the direction between them if they are apart.
struct CorePoints {
  Vector3 on_a, on_b, direction;

  CorePoints(const Vector3& a, const Vector3& b)
      : on_a(a), on_b(b), direction((b - a).normalized()) {}
};

CorePoints core_points(const ConvexBody& a, const ConvexBody& b, const Vector3& guess) {
  if (a.core == Core::point && has_projection(b.core)) {
    return {a.origin, projection_on_core(b, a.origin)};
  }
  if (b.core == Core::point && has_projection(a.core)) {
    return {projection_on_core(a, b.origin), b.origin};
  }
  if (a.core == Core::segment && b.core == Core::segment) {
    const SegmentPoints points = nearest_on_segments(capsule_around(a), capsule_around(b));
    return {points.on_a, points.on_b};
  }
  const FoundSimplex found = search(a, b, guess);
  CorePoints points(found.simplex.on_a(), found.simplex.on_b());
  if (!found.direction.isZero(0)) points.direction = found.direction;
  return points;
}

double gap_along(const ConvexBody& a, const ConvexBody& b, const Vector3& direction) {
  return -support(b, -direction) - support(a, direction);
}

/// The direction along which the bodies overlap least, among their axes, the line between their
/// centres, and `guess`.
Vector3 direction_of_overlap(const ConvexBody& a, const ConvexBody& b, const Vector3& guess) {
  Vector3 best = guess.squaredNorm() > 0 ? Vector3(guess.normalized()) : Vector3(Vector3::UnitX());
  double most = gap_along(a, b, best);
  const auto try_direction = [&](const Vector3& direction) {
    const double gap = gap_along(a, b, direction);
    if (gap > most) most = gap, best = direction;
  };
  const Vector3 between = b.centre - a.centre;
  if (between.norm() > 0) try_direction(between.normalized());
  for (const ConvexBody* body : {&a, &b}) {
    for (int i = 0; i < 3; ++i) {
      try_direction(body->axes.col(i));
      try_direction(-body->axes.col(i));
    }
  }
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      const Vector3 normal = a.axes.col(i).cross(b.axes.col(k));
      if (normal.norm() < 1e-6) continue;
      try_direction(normal.normalized());
      try_direction(-normal.normalized());
    }
  }
  return best;
}

NearestPoints nearest_to_half_space(const ConvexBody& a, const ConvexBody& b) {
  const Vector3 normal = b.axes.col(2);
  const Vector3 lowest = core_support(a, -normal) - a.radius * normal;
  const double height = normal.dot(lowest - b.origin) - b.radius;
  return {lowest, height > 0 ? Vector3(lowest - height * normal) : lowest, -normal};
}

}  // namespace

NearestPoints nearest_points(const ConvexBody& a, const ConvexBody& b, const Vector3& guess) {
  if (b.core == Core::half_space) return nearest_to_half_space(a, b);
  const CorePoints core = core_points(a, b, guess);
  const Vector3 between = core.on_b - core.on_a;
  const double distance = between.norm();
  const double rounding = 1e-14 * (a.bound + b.bound + (a.centre - b.centre).norm());
  if (distance <= rounding) {
    const Vector3 common = (core.on_a + core.on_b) / 2;
    return {common, common, direction_of_overlap(a, b, guess)};
  }
  const Vector3 along = between / distance;
  // Cores that nearly touch give a poor direction.
  const bool nearly_touch = distance <= 1e8 * rounding;
  NearestPoints found{.direction = nearly_touch ? direction_of_overlap(a, b, core.direction)
                                                : core.direction};
  if (distance >= a.radius + b.radius) {
    found.on_a = core.on_a + a.radius * along;
    found.on_b = core.on_b - b.radius * along;
  } else {  // a common point of the grown cores
    const double t = (std::max(0.0, distance - b.radius) + std::min(distance, a.radius)) / 2;
    found.on_a = found.on_b = core.on_a + t * along;
  }
  return found;
}

bool are_closer(const ConvexBody& a, const ConvexBody& b, double distance, const Vector3& guess) {
  const double of_cores = distance + a.radius + b.radius;
  if (b.core == Core::half_space || (a.core == Core::point && has_projection(b.core)) ||
      (b.core == Core::point && has_projection(a.core))) {
    const NearestPoints found = nearest_points(a, b, guess);
    return gap_along(a, b, found.direction) < distance;
  }
  const double size = guess.norm();
  if (size > 0 && gap_along(a, b, guess / size) >= distance) return false;
  const FoundSimplex found = search(a, b, guess, [&](double lower, double upper) {
    return lower >= of_cores || upper < of_cores;
  });
  return found.simplex.nearest().norm() < of_cores;
}

HullPoint nearest_in_hull(const Vector3& point, const ConvexBody& hull) {
  const ConvexBody at{.origin = point, .centre = point};
  const Simplex found = search(at, hull, hull.centre - point).simplex;
  HullPoint nearest{.mean = found.on_b(), .count = found.size()};
  for (int i = 0; i < nearest.count; ++i) {
    nearest.vertices[static_cast<std::size_t>(i)] = found.of_b(i);
  }
  return nearest;
}

}  // namespace beeline::internal
