#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <beeline/collision/internal/bounding_capsule.h>
#include <beeline/collision/internal/nearest_points.h>
#include <beeline/collision/internal/simplex.h>

namespace beeline::internal {
namespace {

using Core = ConvexBody::Core;

DifferencePoint difference_support(const ConvexBody& a, const ConvexBody& b,
                                   const Vector3& direction) {
  const Vector3 on_a = core_support(a, direction), on_b = core_support(b, -direction);
  return {on_a - on_b, on_a, on_b};
}

/// The simplex whose nearest point to the origin is the difference of the nearest points, and the
/// direction, from `a` to `b`, that proves the largest distance of those that were tried.
struct FoundSimplex {
  Simplex simplex;
  Vector3 direction = Vector3::Zero();  ///< zero: none was tried
};

Vector3 from_body(const ConvexBody& body, const Vector3& point) {
  return body.origin + body.axes * point;
}

Vector3 to_body(const ConvexBody& body, const Vector3& point) {
  return body.axes.transpose() * (point - body.origin);
}

/// Returns the simplex of the last search at the current poses of the bodies.
Simplex started_simplex(const SearchStart& start, const ConvexBody& a, const ConvexBody& b) {
  Simplex simplex;
  for (std::size_t i = 0; i < static_cast<std::size_t>(start.count); ++i) {
    const Vector3 on_a = from_body(a, start.on_a[i]), on_b = from_body(b, start.on_b[i]);
    simplex.add({on_a - on_b, on_a, on_b});
  }
  return simplex;
}

/// Makes the simplex that was found the next start. A point of the last start keeps its
/// coordinates: computed in each search from the world's, it would leave its body.
void store(const Simplex& found, const ConvexBody& a, const ConvexBody& b, SearchStart& start) {
  const SearchStart last = start;
  const bool is_usable = found.size() < 4 && found.nearest().allFinite();
  start.count = is_usable ? found.size() : 0;
  for (int i = 0; i < start.count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    start.on_a[k] = to_body(a, found.of_a(i));
    start.on_b[k] = to_body(b, found.of_b(i));
    for (std::size_t j = 0; j < static_cast<std::size_t>(last.count); ++j) {
      if (from_body(a, last.on_a[j]) == found.of_a(i)) start.on_a[k] = last.on_a[j];
      if (from_body(b, last.on_b[j]) == found.of_b(i)) start.on_b[k] = last.on_b[j];
    }
  }
}

/// Ends early where `is_enough`, called with a lower and an upper bound of the distance, is true.
template <class IsEnough>
FoundSimplex search_until(const IsEnough& is_enough, const ConvexBody& a, const ConvexBody& b,
                          const Vector3& guess, SearchStart* start = nullptr) {
  constexpr int max_steps = 128;
  constexpr double relative = 1e-13, of_size = 1e-15;
  const double size = a.bound + b.bound + (a.centre - b.centre).norm();
  Simplex simplex;
  if (start != nullptr && start->count > 0) {
    simplex = started_simplex(*start, a, b);
  } else {
    simplex.add(difference_support(a, b, guess));
  }
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
  if (start != nullptr) store(best.simplex, a, b, *start);
  return best;
}

FoundSimplex search(const ConvexBody& a, const ConvexBody& b, const Vector3& guess,
                    double tolerance, SearchStart* start = nullptr) {
  const auto is_enough = [tolerance](double lower, double upper) {
    return upper - lower <= tolerance;
  };
  return search_until(is_enough, a, b, guess, start);
}

/// The nearest points of two cores, and the direction between them if they are apart.
struct CorePoints {
  Vector3 on_a, on_b, direction;

  CorePoints(const Vector3& a, const Vector3& b)
      : on_a(a), on_b(b), direction((b - a).normalized()) {}
};

CorePoints core_points(const ConvexBody& a, const ConvexBody& b, const Vector3& guess,
                       double tolerance, SearchStart* start) {
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
  const FoundSimplex found = search(a, b, guess, tolerance, start);
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

NearestPoints nearest_points(const ConvexBody& a, const ConvexBody& b, const Vector3& guess,
                             double tolerance, SearchStart* start) {
  if (b.core == Core::half_space) return nearest_to_half_space(a, b);
  const CorePoints core = core_points(a, b, guess, tolerance, start);
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
  const auto is_enough = [of_cores](double lower, double upper) {
    return lower >= of_cores || upper < of_cores;
  };
  const FoundSimplex found = search_until(is_enough, a, b, guess);
  return found.simplex.nearest().norm() < of_cores;
}

HullPoint nearest_in_hull(const Vector3& point, const ConvexBody& hull) {
  const ConvexBody at{.origin = point, .centre = point};
  const Simplex found = search(at, hull, hull.centre - point, 0).simplex;
  HullPoint nearest{.mean = found.on_b(), .count = found.size()};
  for (int i = 0; i < nearest.count; ++i) {
    nearest.vertices[static_cast<std::size_t>(i)] = found.of_b(i);
  }
  return nearest;
}

}  // namespace beeline::internal
