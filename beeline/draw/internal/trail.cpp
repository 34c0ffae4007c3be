#include <algorithm>
#include <cmath>

#include <beeline/draw/internal/simplification.h>
#include <beeline/draw/internal/trail.h>
#include <beeline/kinematics/forward.h>
#include <beeline/trajectory/internal/interval_polynomial.h>

namespace beeline::internal {
namespace {

constexpr std::size_t min_trail_points = 2000, max_trail_points = 20'000;

/// Keeps the first point of each group of neighbours, and its extremes along each axis.
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

/// Adds a line through the points, and over it the parts below the floor.
void add_line(Drawing& drawing, const Arm& arm, const std::vector<Vector3>& points,
              double appears) {
  drawing.add(Layer::trail, Polyline{points, amber, 0.8}, appears);
  if (!drawing.floor || !stands_upright(arm)) return;
  const double floor = *drawing.floor - 1e-9;
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
    drawing.add(Layer::trail, Polyline{below, below_ground, 1.4}, appears);
    below.clear();
  }
}

/// Returns the visible points, at most 2500: more would merge.
ToolTrail visible_part(const ToolTrail& trail) {
  constexpr std::size_t max_kept = 2500;
  const auto off = [&](std::size_t i, std::size_t a, std::size_t b) {
    return distance_from_chord(trail.points[i], trail.points[a], trail.points[b]);
  };
  double tolerance = 1e-4 * extent(trail.points);  // a fraction of a point on paper
  std::vector<std::size_t> kept = simplified(0, trail.points.size() - 1, tolerance, off);
  while (kept.size() > max_kept) {
    kept = simplified(0, trail.points.size() - 1, tolerance *= 2, off);
  }
  ToolTrail part;
  for (const std::size_t i : kept) {
    part.times.push_back(trail.times[i]);
    part.points.push_back(trail.points[i]);
  }
  return part;
}

/// Returns i / n of the trail's duration, seconds.
double share_of(const ToolTrail& trail, std::size_t i, std::size_t n) {
  return (trail.times.back() - trail.times.front()) * static_cast<double>(i) /
         static_cast<double>(n);
}

/// Returns the position of the tool `since` seconds after the beginning.
Vector3 tool_after(const Arm& arm, const Trajectory& trajectory, double since) {
  const Configuration q = sample(trajectory, trajectory.times.front() + since).position;
  return forward_kinematics(arm, q).translation();
}

/// Adds the trail in parts that appear when the tool has passed them.
void add_growing_trail(Drawing& drawing, const Arm& arm, const Trajectory& trajectory,
                       const ToolTrail& trail, std::size_t gaps) {
  // The line follows the tool more closely than the dots do.
  const std::size_t parts = std::max<std::size_t>(1, 300 / gaps);
  std::vector<Vector3> line{trail.points.front()};
  for (std::size_t part = 0, next = 1; part <= gaps * parts; ++part) {
    const double since = share_of(trail, part, gaps * parts);
    const Vector3 at = tool_after(arm, trajectory, since);
    while (next < trail.points.size() && trail.times[next] < trail.times.front() + since) {
      line.push_back(trail.points[next++]);
    }
    line.push_back(at);
    if (part > 0 && extent(line) > 0) add_line(drawing, arm, line, since);
    line = {at};
    if (part % parts == 0) drawing.add(Layer::trail, Dots{{at}, amber, 3}, since);
  }
}

}  // namespace

double extent(const std::vector<Vector3>& points) {
  Vector3 low = points.front(), high = low;
  for (const Vector3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

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

bool stands_upright(const Arm& arm) { return !arm.planar() && arm.base().linear()(2, 2) > 0.5; }

void add_trail(Drawing& drawing, const Arm& arm, const Trajectory& trajectory,
               const TrailStyle& style) {
  const ToolTrail trail = visible_part(tool_trail(arm, trajectory));
  const std::size_t gaps = std::max<std::size_t>(style.dots, 2) - 1;
  if (style.growing) return add_growing_trail(drawing, arm, trajectory, trail, gaps);
  add_line(drawing, arm, trail.points, 0);
  Dots dots{{}, amber, 3};
  for (std::size_t i = 0; i <= gaps; ++i) {
    dots.points.push_back(tool_after(arm, trajectory, share_of(trail, i, gaps)));
  }
  drawing.add(Layer::trail, dots);
}

void add_poses(Drawing& drawing, const std::vector<Pose>& poses,
               const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Vector3 at = poses[i].translation();
    drawing.add(Layer::mark, Dots{{at}, amber, 9});
    drawing.add(Layer::mark, Dots{{at}, paper_white, 6});
    drawing.add(Layer::mark, FrameTriad{poses[i], 20});
    const std::string name = names.empty() ? std::to_string(i + 1) : names[i];
    drawing.add(Layer::note, Label{at, name, amber});
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
