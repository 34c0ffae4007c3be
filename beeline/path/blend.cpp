#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/math/minimise.h>
#include <beeline/path/blend.h>
#include <beeline/path/internal/checked_poses.h>
#include <beeline/path/internal/scaled_blends.h>

namespace beeline {
namespace {

constexpr double nothing = 1e-12;  // metres or radians that count as zero
// The part of a line that its two blends leave straight, at least. In a part much shorter than its
// neighbours the rounding of the joint values would look like jerk, and slow the motion down.
constexpr double straight = 1.0 / 16;

/// Both lines at a corner: translation and rotation vector per metre of their span.
struct Sides {
  Twist in, out;
};

bool translates(const Twist& side) { return side.head<3>().norm() > 1 - nothing; }

/// Whether the direction of the tool, or of its rotation where neither line translates, changes by
/// 175 degrees or more. The curvature of a blend grows without bound towards 180 degrees.
bool reverses(const Sides& sides) {
  constexpr double sharpest = 0.0436;  // cos(175 deg / 2)
  const auto opposite = [](const Vector3& a, const Vector3& b) {
    return (a.normalized() + b.normalized()).norm() <= 2 * sharpest;
  };
  const Vector3 a = sides.in.head<3>(), b = sides.out.head<3>();
  if (a.norm() > nothing || b.norm() > nothing) {
    return a.norm() > nothing && b.norm() > nothing && opposite(a, b);
  }
  return opposite(sides.in.tail<3>(), sides.out.tail<3>());
}

/// f(1/2) for f(s) = 2 s^3 - s^4. Its first and second derivatives are 0 at s = 0, and 2 and 0 at
/// s = 1.
constexpr double half_way = 3.0 / 16;

/// The largest curvature of -f(1 - s) a + f(s) b: 3 s (1 - s) |a x b| / |q|^3, where q = a + u (b -
/// a) with u = 3 s^2 - 2 s^3 is half its velocity. It is at s = 1/2 where |a| = |b|.
double curvature_between(const Vector3& a, const Vector3& b) {
  constexpr int intervals = 32, sections = 50;  // to 1e-12 of s
  const double area = a.cross(b).norm();
  if (area <= nothing) return 0;
  const auto curvature = [&](double s) {
    const Vector3 q = a + (3 - 2 * s) * s * s * (b - a);
    return 3 * s * (1 - s) * area / std::pow(q.norm(), 3);
  };
  const auto found =
      internal::scan_and_refine(0, 1, intervals, sections, [&](double s) { return -curvature(s); });
  return std::max(curvature(0.5), -found.value);
}

/// The blend of radius 1; all its lengths are proportional to the radius.
///
/// Deviation from the lines where |in| = |out| = 1, c being the cosine between them and s <= 1/2:
/// the nearest point of the first line is at f(1 - s) - f(s) c before the corner, at distance
/// f(s) |sin|. Its rotation from the corner is that fraction of in's, so the orientations differ by
/// at most f(s) |out - c in|. The other half is the mirror image. If one of the lines does not
/// translate: the pose at f(1 - s) before the corner differs by f(s) out, position and rotation.
Blend of_radius_one(const Sides& sides) {
  const Vector3 a = sides.in.head<3>(), b = sides.out.head<3>();
  const Vector3 turn_a = sides.in.tail<3>(), turn_b = sides.out.tail<3>();
  Blend blend;
  blend.corner_deviation = {half_way * (b - a).norm(), half_way * (turn_b - turn_a).norm()};
  blend.curvature = curvature_between(a, b);
  if (!translates(sides.in) || !translates(sides.out)) {
    blend.line_deviation = {half_way * std::max(a.norm(), b.norm()),
                            half_way * std::max(turn_a.norm(), turn_b.norm())};
    return blend;
  }
  const double c = a.dot(b);
  const double rotation = std::max((turn_b - c * turn_a).norm(), (turn_a - c * turn_b).norm());
  blend.line_deviation = {half_way * a.cross(b).norm(), half_way * rotation};
  return blend;
}

/// The largest radius whose deviations are within the tolerances; 0 where there is no corner.
double wanted_radius(const Blend& one, const Deviation& within) {
  const double position = std::max(one.corner_deviation.position, one.line_deviation.position);
  const double orientation =
      std::max(one.corner_deviation.orientation, one.line_deviation.orientation);
  double radius = Limits::none;
  if (position > nothing) radius = within.position / position;
  if (orientation > nothing) radius = std::min(radius, within.orientation / orientation);
  if (position <= nothing && orientation <= nothing) return 0;
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

SplineSegment blend_segment(const Pose& corner, const Sides& sides, double radius) {
  const Twist in = radius * sides.in, out = radius * sides.out;
  SplineSegment segment{corner};
  segment.terms.col(0) = -in;
  segment.terms.col(1) = 2 * in;
  segment.terms.col(3) = 2 * (out - in);
  segment.terms.col(4) = in - out;
  return segment;
}

void check_tolerances(std::span<const Deviation> within, std::size_t corners) {
  if (within.size() != corners) {
    throw Error(std::to_string(corners) + " corners need as many tolerances, not " +
                std::to_string(within.size()));
  }
  for (const Deviation& one : within) internal::check_blend_tolerance(one);
}

/// The poses between lines. Poses that are passed as one are one of them.
struct Corners {
  std::vector<Pose> poses;
  std::vector<std::size_t> last;  ///< the last of the given poses that are passed as each of them
  std::vector<Deviation> within;  ///< of each
  std::vector<double> scales;     ///< of each
};

Corners corners_of(const std::vector<Pose>& given, std::span<const Deviation> within,
                   std::span<const double> scales) {
  Corners corners;
  for (std::size_t i = 0; i < given.size(); ++i) {
    const bool inner = i > 0 && i + 1 < given.size();
    const bool again = i > 0 && internal::passed_as_one(given[i], corners.poses.back());
    if (!again) {
      corners.poses.push_back(given[i]);
      corners.last.push_back(i);
      corners.within.push_back(inner ? within[i - 1] : Deviation{});
      corners.scales.push_back(inner ? scales[i - 1] : 1);
      continue;
    }
    corners.last.back() = i;
    if (!inner && corners.poses.size() > 1) corners.poses.back() = given[i];  // the end
    if (!inner) continue;
    const Twist away = pose_difference(given[i], corners.poses.back());
    Deviation& most = corners.within.back();
    most.position = std::min(most.position, within[i - 1].position - away.head<3>().norm());
    most.orientation =
        std::min(most.orientation, within[i - 1].orientation - away.tail<3>().norm());
    corners.scales.back() = std::min(corners.scales.back(), scales[i - 1]);
  }
  if (corners.poses.size() > 1) return corners;
  throw Error("pose " + std::to_string(given.size()) +
              " is the same as the first one; lines need two different poses");
}

/// The blends at the corners: as large as they are wanted, then as large as the lines allow, then
/// scaled, so that a smaller one never makes its neighbours larger. One for each pose; those at
/// both ends are none.
std::vector<Blend> blends_at(const Corners& corners, const std::vector<Twist>& direction,
                             const std::vector<double>& span) {
  const std::size_t lines = span.size();
  std::vector<double> wanted(lines + 1, 0);
  std::vector<Blend> blends(lines + 1);
  for (std::size_t i = 1; i < lines; ++i) {
    const Sides sides{direction[i - 1], direction[i]};
    blends[i] = of_radius_one(sides);
    blends[i].sharp = reverses(sides);
    if (!blends[i].sharp) wanted[i] = wanted_radius(blends[i], corners.within[i]);
  }
  for (std::size_t i = 1; i < lines; ++i) {
    const double before_span = (1 - straight) * span[i - 1], after_span = (1 - straight) * span[i];
    const double before = std::max(before_span / 2, before_span - wanted[i - 1]);
    const double after = std::max(after_span / 2, after_span - wanted[i + 1]);
    const double radius = std::min({wanted[i], before, after});
    blends[i] = scaled(blends[i], corners.scales[i] * radius);
    blends[i].shortened = corners.scales[i] > 0 && radius < wanted[i];
  }
  return blends;
}

}  // namespace

void internal::check_blend_tolerance(const Deviation& within) {
  constexpr double smallest = 1e-4;  // metres and radians; joints nearly stop in smaller ones
  if (within.position >= smallest && within.orientation >= smallest) return;
  throw Error("the tolerances of a blend must be at least " + number(smallest) +
              " m and rad, not " + deviation_text(within) + "; without a blend the tool stops");
}

bool internal::passed_as_one(const Pose& pose, const Pose& before) {
  constexpr double same = 1e-5;  // metres and radians: a tenth of the smallest tolerance
  const Twist away = pose_difference(pose, before);
  return away.head<3>().norm() <= same && away.tail<3>().norm() <= same;
}

BlendedPath blended_lines(std::span<const Pose> poses, const Deviation& within) {
  internal::check_blend_tolerance(within);
  return blended_lines(poses,
                       std::vector<Deviation>(poses.size() < 2 ? 0 : poses.size() - 2, within));
}

BlendedPath blended_lines(std::span<const Pose> poses, std::span<const Deviation> within) {
  return internal::scaled_blends(poses, within, std::vector<double>(within.size(), 1));
}

BlendedPath internal::scaled_blends(std::span<const Pose> given, std::span<const Deviation> within,
                                    std::span<const double> scales) {
  if (given.size() < 2) throw Error("a path needs at least two poses");
  const std::vector<Pose> checked = checked_poses(given);
  check_tolerances(within, checked.size() - 2);
  for (const double scale : scales) {
    if (!(scale >= 0 && scale <= 1)) throw Error("the scale of a blend must be from 0 to 1");
  }
  const Corners corners = corners_of(checked, within, scales);
  const std::vector<Pose>& poses = corners.poses;
  const std::size_t lines = poses.size() - 1;
  std::vector<double> span(lines);
  std::vector<Twist> direction(lines);  // per metre of the span
  for (std::size_t i = 0; i < lines; ++i) {
    span[i] = span_of({poses[i], poses[i + 1]});
    direction[i] = pose_difference(poses[i + 1], poses[i]) / span[i];
  }
  const std::vector<Blend> blends = blends_at(corners, direction, span);
  BlendedPath blended;
  blended.blends.resize(checked.size() - 2);
  for (std::size_t i = 0; i < lines; ++i) {
    const double from = blends[i].radius / span[i], to = 1 - blends[i + 1].radius / span[i];
    blended.path.segments.emplace_back(
        Line{interpolate(poses[i], poses[i + 1], from), interpolate(poses[i], poses[i + 1], to)});
    blended.path.spans.push_back((to - from) * span[i]);
    blended.lines.push_back(corners.last[i]);
    blended.stops.push_back(false);
    if (i + 1 == lines) break;
    const Blend& blend = blended.blends[corners.last[i + 1] - 1] = blends[i + 1];
    blended.stops.back() = blend.sharp || corners.scales[i + 1] == 0;
    if (blend.radius == 0) continue;
    blended.path.segments.emplace_back(
        blend_segment(poses[i + 1], {direction[i], direction[i + 1]}, blend.radius));
    blended.path.spans.push_back(2 * blend.radius);
    blended.lines.push_back(corners.last[i + 1] - 1);
    blended.stops.push_back(false);
  }
  blended.path.names = blend_names(blended);
  return blended;
}

Route route_of(const BlendedPath& blended) { return {blended.path, blended.stops}; }

std::vector<std::string> blend_names(const BlendedPath& blended, const PoseNumbers& numbers) {
  const auto number_of = [&](std::size_t pose) {
    return std::to_string(numbers.start_first ? pose : pose + 1);
  };
  const auto name_of = [&](std::size_t pose) {
    return numbers.start_first && pose == 0 ? "start" : numbers.noun + " " + number_of(pose);
  };
  const std::size_t lines = blended.blends.size() + 1;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < blended.lines.size(); ++k) {
    const std::size_t i = blended.lines[k];
    if (std::holds_alternative<SplineSegment>(blended.path.segments[k])) {
      names.push_back("the blend at " + name_of(i + 1));
      continue;
    }
    const bool from_start = numbers.start_first && i == 0;
    names.push_back("line " + std::to_string(i + 1) + " of " + std::to_string(lines) + " (" +
                    name_of(i) + " to " + (from_start ? name_of(1) : number_of(i + 1)) + ")");
  }
  return names;
}

}  // namespace beeline
