#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/path/blend.h>

namespace beeline {
namespace {

constexpr double nothing = 1e-12;     // metres or radians that count as none
constexpr double least_share = 1e-9;  // of a line, that is worth a segment

/// Both lines at a corner, for each metre of their span.
struct Sides {
  Twist in, out;
};

bool moves(const Twist& side) { return side.head<3>().norm() > 1 - nothing; }

/// The tool's way, or where neither line has one the turn, leads back: by 175 degrees or more.
bool turns_back(const Sides& sides) {
  constexpr double sharpest = 0.0436;  // cos(175 deg / 2)
  const auto back = [](const Vector3& a, const Vector3& b) {
    return (a.normalized() + b.normalized()).norm() <= 2 * sharpest;
  };
  const Vector3 a = sides.in.head<3>(), b = sides.out.head<3>();
  if (a.norm() > nothing || b.norm() > nothing) {
    return a.norm() > nothing && b.norm() > nothing && back(a, b);
  }
  return back(sides.in.tail<3>(), sides.out.tail<3>());
}

/// f(s) = 2 s^3 - s^4 half-way. Its derivatives are 0 at s = 0, and 2 and 0 at s = 1.
constexpr double half_way = 3.0 / 16;

/// Most curvature of -f(1 - s) a + f(s) b: 3 s (1 - s) |a x b| / |q|^3 where q is half its
/// velocity, on the way from a to b by u = 3 s^2 - 2 s^3. Half-way where both are of a length; else
/// found by looks, and thirds about the best of them.
double curvature_between(const Vector3& a, const Vector3& b) {
  constexpr int looks = 32, thirds = 60;
  const double area = a.cross(b).norm();
  if (area <= nothing) return 0;
  const auto at = [&](double s) {
    const Vector3 q = a + (3 - 2 * s) * s * s * (b - a);
    return 3 * s * (1 - s) * area / std::pow(q.norm(), 3);
  };
  int best = looks / 2;
  for (int i = 1; i < looks; ++i) {
    if (at(double(i) / looks) > at(double(best) / looks)) best = i;
  }
  double low = (best - 1.0) / looks, high = (best + 1.0) / looks;
  for (int i = 0; i < thirds; ++i) {
    const double third = (high - low) / 3;
    const bool rises = at(low + third) < at(high - third);
    (rises ? low : high) += rises ? third : -third;
  }
  return std::max(at(double(best) / looks), at((low + high) / 2));
}

/// Everything about the corner is in proportion to its radius: this is for 1.
///
/// Off the lines, with in and out of the same length, c the cosine between them and s <= 1/2: the
/// nearest point of the first line is its share f(1 - s) - f(s) c before the corner, at the
/// distance f(s) |sin|; its turn from the corner is that share of in's, so that the turns differ by
/// f(s) |out - c in| at most. The other half is the mirror image. If one of them does not move:
/// from the share f(1 - s) before the corner it is f(s) out away, position and turn.
Blend of_radius_one(const Sides& sides) {
  const Vector3 a = sides.in.head<3>(), b = sides.out.head<3>();
  const Vector3 turn_a = sides.in.tail<3>(), turn_b = sides.out.tail<3>();
  Blend blend;
  blend.corner_deviation = {half_way * (b - a).norm(), half_way * (turn_b - turn_a).norm()};
  blend.curvature = curvature_between(a, b);
  if (!moves(sides.in) || !moves(sides.out)) {
    blend.line_deviation = {half_way * std::max(a.norm(), b.norm()),
                            half_way * std::max(turn_a.norm(), turn_b.norm())};
    return blend;
  }
  const double c = a.dot(b);
  const double turned = std::max((turn_b - c * turn_a).norm(), (turn_a - c * turn_b).norm());
  blend.line_deviation = {half_way * a.cross(b).norm(), half_way * turned};
  return blend;
}

/// The largest radius that keeps within the distances; 0 where there is no corner.
double wanted_radius(const Blend& one, const Deviation& within) {
  const double far = std::max(one.corner_deviation.position, one.line_deviation.position);
  const double turned = std::max(one.corner_deviation.orientation, one.line_deviation.orientation);
  double radius = Limits::none;
  if (far > nothing) radius = within.position / far;
  if (turned > nothing) radius = std::min(radius, within.orientation / turned);
  if (far <= nothing && turned <= nothing) return 0;
  return radius;
}

Blend scaled(const Blend& one, double radius) {
  Blend blend = one;
  blend.radius = radius;
  for (double* size : {&blend.line_deviation.position, &blend.line_deviation.orientation,
                       &blend.corner_deviation.position, &blend.corner_deviation.orientation}) {
    *size *= radius;
  }
  blend.curvature = radius > 0 ? one.curvature / radius : 0;
  return blend;
}

SplineSegment rounding(const Pose& corner, const Sides& sides, double radius) {
  const Twist in = radius * sides.in, out = radius * sides.out;
  SplineSegment segment{corner};
  segment.terms.col(0) = -in;
  segment.terms.col(1) = 2 * in;
  segment.terms.col(3) = 2 * (out - in);
  segment.terms.col(4) = in - out;
  return segment;
}

}  // namespace

BlendedPath blended_lines(std::span<const Pose> given, const Deviation& within) {
  if (!(within.position > 0) || !(within.orientation > 0)) {
    throw Error("corners are blended within a distance and an angle above zero, not " +
                number(within.position) + " m and " + number(within.orientation) + " rad");
  }
  const std::vector<Pose> poses = checked_path(given);
  const std::size_t lines = poses.size() - 1;
  std::vector<double> span(lines), wanted(lines + 1, 0);
  std::vector<Twist> way(lines);  // for each metre of the span
  for (std::size_t i = 0; i < lines; ++i) {
    span[i] = span_of({poses[i], poses[i + 1]});
    way[i] = pose_difference(poses[i + 1], poses[i]) / span[i];
  }
  std::vector<Blend> ones;
  for (std::size_t i = 1; i < lines; ++i) {
    const Sides sides{way[i - 1], way[i]};
    ones.push_back(of_radius_one(sides));
    ones.back().sharp = turns_back(sides);
    if (!ones.back().sharp) wanted[i] = wanted_radius(ones.back(), within);
  }
  BlendedPath blended;
  std::vector<double> radius(lines + 1, 0);  // of corner i, between the lines i - 1 and i
  for (std::size_t i = 1; i < lines; ++i) {
    const double before = std::max(span[i - 1] / 2, span[i - 1] - wanted[i - 1]);
    const double after = std::max(span[i] / 2, span[i] - wanted[i + 1]);
    radius[i] = std::min({wanted[i], before, after});
    blended.blends.push_back(scaled(ones[i - 1], radius[i]));
    blended.blends.back().shortened = radius[i] < wanted[i];
  }
  for (std::size_t i = 0; i < lines; ++i) {
    const double from = radius[i] / span[i], to = 1 - radius[i + 1] / span[i];
    if (to - from > least_share) {
      blended.path.segments.emplace_back(
          Line{interpolate(poses[i], poses[i + 1], from), interpolate(poses[i], poses[i + 1], to)});
      blended.path.spans.push_back((to - from) * span[i]);
    }
    if (radius[i + 1] > 0) {
      blended.path.segments.emplace_back(
          rounding(poses[i + 1], {way[i], way[i + 1]}, radius[i + 1]));
      blended.path.spans.push_back(2 * radius[i + 1]);
    }
    blended.stops.resize(blended.path.segments.size(), false);
    if (i + 1 < lines && blended.blends[i].sharp) blended.stops.back() = true;
  }
  return blended;
}

Route route_of(const BlendedPath& blended) { return {blended.path, blended.stops}; }

}  // namespace beeline
