#pragma once

#include <cmath>
#include <string>
#include <vector>

#include <beeline/path/blend.h>
#include <beeline/path/tool_path.h>

#include <tests/random.h>

namespace beeline::testing {

/// Poses each of which is `size` at most from the one before, and turned by `angle` at most.
inline std::vector<Pose> random_poses(Random& random, int count, double size, double angle) {
  std::vector<Pose> poses{random.pose()};
  while (static_cast<int>(poses.size()) < count) {
    Pose next = poses.back();
    next.translation() += random.direction() * random.uniform(0.1, 1) * size;
    next.linear() = random.rotation(angle) * next.linear();
    poses.push_back(next);
  }
  return poses;
}

/// A segment of a random kind, size and turn, up to 3 radians.
inline Segment random_segment(Random& random) {
  const double size = std::pow(10, random.uniform(-2, 0.5));
  const double angle = random.integer(0, 3) > 0 ? random.uniform(0, 3) : 0;
  const std::vector<Pose> poses = random_poses(random, random.integer(1, 3) * 2 + 1, size, angle);
  const int kind = random.integer(0, 4);
  if (kind == 4) {
    const BlendedPath rounded = blended_lines(poses, {random.uniform(1e-3, 1), 3});
    for (const Segment& segment : rounded.path.segments) {
      if (std::holds_alternative<SplineSegment>(segment)) return segment;
    }
    return Line{poses[0], poses[1]};
  }
  const auto segments = path_through(poses, static_cast<PathKind>(kind)).segments;
  return segments[random.integer(0, static_cast<int>(segments.size()) - 1)];
}

inline const char* kind_of(const Segment& segment) {
  constexpr const char* names[] = {"line", "screw", "arc", "spline"};
  return names[segment.index()];
}

/// A scale for tolerances: 1 plus the velocity and acceleration of the segment at its middle.
inline double size_of(const Segment& segment) {
  const PoseMotion at = motion_at(segment, 0.5);
  return 1 + at.velocity.norm() + at.acceleration.norm();
}

inline double turn_between(const Pose& a, const Pose& b) {
  return pose_difference(a, b).tail<3>().norm();
}

inline double distance_between(const Pose& a, const Pose& b) {
  return (a.translation() - b.translation()).norm();
}

}  // namespace beeline::testing
