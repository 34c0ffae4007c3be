#include <algorithm>

#include <beeline/timing/internal/joint_motion.h>

namespace beeline::internal {

JointMotion::State JointMotion::at(const ParameterState& now) const {
  const auto next = std::upper_bound(path_.s.begin() + 1, path_.s.end() - 1, now.s);
  const auto step = static_cast<std::size_t>(next - path_.s.begin()) - 1;
  PathPoint point = point_at(step, now.s);
  return {std::move(point.q), now.speed * point.dq,
          now.acceleration * point.dq + now.speed * now.speed * point.ddq, now};
}

/// Grid points are returned exactly.
PathPoint JointMotion::point_at(std::size_t step, double s) const {
  for (const std::size_t k : {step, step + 1}) {
    if (path_.s[k] == s) return {path_.q[k], path_.dq[k], path_.ddq[k], {}};
  }
  const double u = (s - path_.s[step]) / (path_.s[step + 1] - path_.s[step]);
  return path_point(path_, step, std::clamp(u, 0.0, 1.0));
}

SampledSection with_columns(const Arm& arm, const std::vector<Sample>& samples,
                            Interpolation interpolation) {
  SampledSection section;
  Trajectory& trajectory = section.trajectory;
  trajectory.joint_names = arm.joint_names();
  for (const Sample& sample : samples) {
    trajectory.times.push_back(sample.t);
    trajectory.positions.push_back(sample.state.q);
    if (interpolation != Interpolation::linear) trajectory.velocities.push_back(sample.state.v);
    if (interpolation == Interpolation::quintic) trajectory.accelerations.push_back(sample.state.a);
    section.progress.push_back(sample.state.progress);
  }
  return section;
}

}  // namespace beeline::internal
