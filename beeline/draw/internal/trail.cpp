#include <algorithm>
#include <cmath>

#include <beeline/draw/internal/simplification.h>
#include <beeline/draw/internal/trail.h>
#include <beeline/kinematics/forward.h>
#include <beeline/trajectory/internal/interval_polynomial.h>

namespace beeline::internal {
namespace {

constexpr std::size_t min_trail_points = 2000, max_trail_points = 20'000;

/// Keeps of each group of neighbours the first point and the extremes along each axis.
ToolTrail grouped(const ToolTrail& all) {
  const std::size_t size = 1 + 7 * all.points.size() / max_trail_points;
  ToolTrail few;
  for (std::size_t begin = 0; begin < all.points.size(); begin += size) {
    const std::size_t end = std::min(begin + size, all.points.size());
    std::vector<std::size_t> kept{begin, end - 1};
    for (int axis = 0; axis < 3; ++axis) {
      std::size_t low = begin, high = begin;
      for (std::size_t i = begin; i < end; ++i) {
        if (all.points[i][axis] < all.points[low][axis]) low = i;
        if (all.points[i][axis] > all.points[high][axis]) high = i;
      }
      kept.insert(kept.end(), {low, high});
    }
    std::sort(kept.begin(), kept.end());
    kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
    for (const std::size_t i : kept) {
      few.times.push_back(all.times[i]);
      few.points.push_back(all.points[i]);
    }
  }
  return few;
}

double distance_from_chord(const Vector3& p, const Vector3& a, const Vector3& b) {
  const Vector3 chord = b - a;
  const double square = chord.squaredNorm();
  const double t = square > 0 ? std::clamp((p - a).dot(chord) / square, 0.0, 1.0) : 0;
  return (p - a - t * chord).norm();
}

double extent(const std::vector<Vector3>& points) {
  Vector3 low = points.front(), high = low;
  for (const Vector3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

/// Adds a line through the points, and over it its parts below the floor.
void add_line(Scene& scene, const std::vector<Vector3>& points, double appears) {
  scene.add(Layer::trail, Polyline{points, amber, 0.8}, appears);
  if (!scene.floor) return;
  const double floor = *scene.floor - 1e-9;
  std::vector<Vector3> below;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i > 0 && (points[i].z() < floor) != (points[i - 1].z() < floor)) {
      const double from = points[i - 1].z();
      below.emplace_back(points[i - 1] +
                         (floor - from) / (points[i].z() - from) * (points[i] - points[i - 1]));
    }
    if (points[i].z() < floor) below.push_back(points[i]);
    const bool ends = i + 1 == points.size() || points[i].z() >= floor;
    if (!ends || below.empty()) continue;
    scene.add(Layer::trail, Polyline{below, below_ground, 1.4}, appears);
    below.clear();
  }
}

}  // namespace

ToolTrail tool_trail(const Arm& arm, const Trajectory& trajectory) {
  const std::size_t intervals = trajectory.size() - 1;
  const std::size_t parts =
      intervals == 0
          ? 1
          : std::clamp<std::size_t>((min_trail_points - 1) / intervals + 1, 2, min_trail_points);
  ToolTrail trail;
  const auto add = [&](double t, const Configuration& q) {
    trail.times.push_back(t);
    trail.points.push_back(forward_kinematics(arm, q).translation());
    if (trail.points.size() >= 2'000'000) trail = grouped(trail);
  };
  std::vector<Polynomial> joints(static_cast<std::size_t>(arm.dof()));
  Configuration q(arm.dof());
  for (std::size_t k = 0; k < intervals; ++k) {
    for (int i = 0; i < arm.dof(); ++i) {
      joints[static_cast<std::size_t>(i)] = interval_polynomial(trajectory, k, i);
    }
    const double h = trajectory.times[k + 1] - trajectory.times[k];
    for (std::size_t part = 0; part < parts; ++part) {
      const double u = static_cast<double>(part) / static_cast<double>(parts);
      for (int i = 0; i < arm.dof(); ++i) q[i] = joints[static_cast<std::size_t>(i)](u);
      add(trajectory.times[k] + u * h, q);
    }
  }
  add(trajectory.times.back(), trajectory.positions.back());
  return trail.points.size() > max_trail_points ? grouped(trail) : trail;
}

void add_trail(Scene& scene, const Arm& arm, const Trajectory& trajectory,
               const TrailStyle& style) {
  const ToolTrail trail = tool_trail(arm, trajectory);
  const double begin = trail.times.front(), duration = trail.times.back() - begin;
  const auto off = [&](std::size_t i, std::size_t a, std::size_t b) {
    return distance_from_chord(trail.points[i], trail.points[a], trail.points[b]);
  };
  double tolerance = 1e-4 * extent(trail.points);  // a fraction of a point on paper
  std::vector<std::size_t> kept = simplified(0, trail.points.size() - 1, tolerance, off);
  constexpr std::size_t max_kept = 2500;  // a denser line is a blot
  while (kept.size() > max_kept) {
    kept = simplified(0, trail.points.size() - 1, tolerance *= 2, off);
  }
  const std::size_t gaps = std::max<std::size_t>(style.dots, 2) - 1;
  // A growing line follows the tool more closely than dots would.
  const std::size_t parts = style.growing ? std::max<std::size_t>(1, 300 / gaps) : 1;
  std::vector<Vector3> dots, line{trail.points.front()};
  for (std::size_t part = 0, next = 1; part <= gaps * parts; ++part) {
    const double since = duration * static_cast<double>(part) / static_cast<double>(gaps * parts);
    const Vector3 at =
        forward_kinematics(arm, sample(trajectory, begin + since).position).translation();
    const bool dot = part % parts == 0;
    if (dot) dots.push_back(at);
    if (!style.growing) continue;
    while (next < kept.size() && trail.times[kept[next]] < begin + since) {
      line.push_back(trail.points[kept[next++]]);
    }
    line.push_back(at);
    if (part > 0 && extent(line) > 0) add_line(scene, line, since);
    line = {at};
    if (dot) scene.add(Layer::trail, Dots{{at}, amber, 3}, since);
  }
  if (style.growing) return;
  line.clear();
  for (const std::size_t i : kept) line.push_back(trail.points[i]);
  add_line(scene, line, 0);
  scene.add(Layer::trail, Dots{dots, amber, 3});
}

void add_poses(Scene& scene, const std::vector<Pose>& poses,
               const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vector3 at = poses[i].translation();
    scene.add(Layer::mark, Dots{{at}, amber, 9});
    scene.add(Layer::mark, Dots{{at}, paper_white, 6});
    scene.add(Layer::mark, FrameTriad{poses[i], 20});
    if (i >= names.size() || names[i].empty()) continue;
    scene.add(Layer::note, Label{at, names[i], amber});
  }
}

std::vector<double> times_evenly_along(const ToolTrail& trail, int count) {
  std::vector<double> length(trail.points.size(), 0);
  for (std::size_t i = 1; i < length.size(); ++i) {
    length[i] = length[i - 1] + (trail.points[i] - trail.points[i - 1]).norm();
  }
  std::vector<double> times;
  for (int k = 0; k < count && !length.empty(); ++k) {
    const auto found = std::lower_bound(length.begin(), length.end(), length.back() * k / count);
    times.push_back(trail.times[static_cast<std::size_t>(found - length.begin())]);
  }
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace beeline::internal
