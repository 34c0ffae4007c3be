#include <algorithm>

#include <beeline/draw/internal/trail.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {

std::vector<Vector3> tool_positions(const Arm& arm, const std::vector<Configuration>& motion) {
  std::vector<Vector3> points;
  points.reserve(motion.size());
  for (const Configuration& q : motion) {
    points.push_back(forward_kinematics(arm, q).translation());
  }
  return points;
}

void add_trail(Scene& scene, const std::vector<Vector3>& points, std::size_t max_dots) {
  if (points.empty()) return;
  const std::size_t gaps = std::max<std::size_t>(max_dots, 2) - 1;
  const std::size_t stride = std::max<std::size_t>(1, (points.size() - 1 + gaps - 1) / gaps);
  Polyline line{{}, amber, 0.8};
  Dots dots{{}, amber, 3};
  for (std::size_t i = 0; i < points.size(); i += stride) {
    dots.points.push_back(points[i]);
    line.points.push_back(points[i]);
    const std::size_t end = std::min(i + stride, points.size() - 1);
    const auto squared_distance = [&](const Vector3& p) {
      const Vector3 chord = points[end] - points[i];
      const double t = chord.isZero(0) ? 0 : chord.dot(p - points[i]) / chord.squaredNorm();
      return (p - points[i] - std::clamp(t, 0.0, 1.0) * chord).squaredNorm();
    };
    const auto first = points.begin() + static_cast<std::ptrdiff_t>(i);
    const auto last = points.begin() + static_cast<std::ptrdiff_t>(end);
    const auto extreme = std::max_element(first, last, [&](const Vector3& a, const Vector3& b) {
      return squared_distance(a) < squared_distance(b);
    });
    if (extreme != last && extreme != first) line.points.push_back(*extreme);
  }
  if ((points.size() - 1) % stride != 0) {
    dots.points.push_back(points.back());
    line.points.push_back(points.back());
  }
  scene.add(Layer::trail, line);
  scene.add(Layer::trail, dots);
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

std::vector<std::size_t> evenly_along(const std::vector<Vector3>& tool, int count) {
  std::vector<double> length(tool.size(), 0);
  for (std::size_t i = 1; i < tool.size(); ++i) {
    length[i] = length[i - 1] + (tool[i] - tool[i - 1]).norm();
  }
  std::vector<std::size_t> samples;
  for (int k = 0; k < count && !tool.empty(); ++k) {
    const double wanted = length.back() * k / count;
    const auto found = std::lower_bound(length.begin(), length.end(), wanted);
    samples.push_back(static_cast<std::size_t>(found - length.begin()));
  }
  samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
  return samples;
}

}  // namespace beeline::internal
