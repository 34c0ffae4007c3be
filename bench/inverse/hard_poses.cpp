#include "hard_poses.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace beeline::bench {
namespace {

constexpr double pi = std::numbers::pi;

/// Returns 1e-15 to 0.1, log-uniform, with random sign.
double hair(Engine& engine) {
  const double size = std::pow(10.0, uniform(engine, -15, -1));
  return uniform(engine, -1, 1) < 0 ? -size : size;
}

Vector3 direction(Engine& engine) {
  for (;;) {
    const Vector3 v(uniform(engine, -1, 1), uniform(engine, -1, 1), uniform(engine, -1, 1));
    if (v.norm() > 0.1 && v.norm() < 1) return v.normalized();
  }
}

Rotation any_rotation(Engine& engine) {
  return Eigen::AngleAxisd(uniform(engine, -pi, pi), direction(engine)).toRotationMatrix();
}

/// Returns a configuration within limits, half of its values at or next to a multiple of a right
/// angle.
Configuration near_singular(const Screws& screws, Engine& engine) {
  Configuration q = random_configuration(screws, engine);
  for (int i = 0; i < screws.free; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (screws.slides[k] || uniform(engine, 0, 1) < 0.5) continue;
    const double corner = std::round(q[i] / (pi / 2)) * (pi / 2);
    const double off = uniform(engine, 0, 1) < 0.3 ? 0 : hair(engine);
    q[i] = std::clamp(corner + off, screws.lower[k], screws.upper[k]);
  }
  return q;
}

/// Returns a configuration within limits, half of its values at or next to a limit.
Configuration near_limit(const Screws& screws, Engine& engine) {
  Configuration q = random_configuration(screws, engine);
  for (int i = 0; i < screws.free; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (uniform(engine, 0, 1) < 0.5) continue;
    const double off = uniform(engine, 0, 1) < 0.3 ? 0 : std::abs(hair(engine));
    q[i] = uniform(engine, -1, 1) < 0 ? std::min(screws.lower[k] + off, screws.upper[k])
                                      : std::max(screws.upper[k] - off, screws.lower[k]);
  }
  return q;
}

}  // namespace

HardPose hard_pose(const BenchArm& arm, const Screws& screws, Hardness hardness, Engine& engine) {
  Pose pose = forward(screws, random_configuration(screws, engine));
  switch (hardness) {
    case Hardness::plain:
      return {pose, true};
    case Hardness::beyond: {
      const Arm::Reach& reach = arm.arm.reach();
      const double radius = reach.radius * (1 + std::abs(hair(engine)));
      pose.translation() = reach.centre + radius * direction(engine);
      pose.linear() = any_rotation(engine);
      return {pose, false};
    }
    case Hardness::turned:
      pose.linear() = any_rotation(engine);
      return {pose, false};
    case Hardness::singular:
      return {forward(screws, near_singular(screws, engine)), true};
    case Hardness::at_limit:
      return {forward(screws, near_limit(screws, engine)), true};
    case Hardness::pushed:
      break;
  }
  pose = forward(screws, near_singular(screws, engine));
  const Vector3 centre = screws.point[0];
  pose.translation() += hair(engine) * (pose.translation() - centre);
  pose.linear() = Eigen::AngleAxisd(hair(engine), direction(engine)) * pose.linear();
  return {pose, false};
}

}  // namespace beeline::bench
