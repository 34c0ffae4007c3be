#include "screws.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/error.h>

namespace beeline::bench {

Screws screws_of(const BenchArm& measured) {
  const Arm& arm = measured.arm;
  if (arm.dof() > Screws::most || arm.dof() != static_cast<int>(arm.joints().size())) {
    throw Error("arm " + arm.name() + " does not fit the benchmark: at most " +
                std::to_string(Screws::most) + " joints, no mimic joints");
  }
  Screws screws;
  screws.joints = arm.dof();
  screws.free = measured.free();
  screws.last = measured.last.value_or(0);
  Pose world_T_link = arm.base();
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    const Joint& joint = arm.joints()[i];
    if (kind(joint) == JointKind::helical) throw Error("the benchmark has no helical joints");
    world_T_link = world_T_link * joint.offset;
    const Vector3 v = joint.screw.head<3>(), w = joint.screw.tail<3>();
    screws.slides[i] = kind(joint) == JointKind::prismatic;
    screws.axis[i] = world_T_link.linear() * (screws.slides[i] ? v : w);
    screws.point[i] = world_T_link * Vector3(w.cross(v));
    screws.lower[i] = joint.limits.lower;
    screws.upper[i] = joint.limits.upper;
  }
  screws.home = world_T_link * arm.tool();
  return screws;
}

Pose axis_frame(const Screws& screws, std::size_t i) {
  Pose frame = Pose::Identity();
  frame.linear() =
      Eigen::Quaterniond::FromTwoVectors(Vector3::UnitZ(), screws.axis[i]).toRotationMatrix();
  frame.translation() = screws.point[i];
  return frame;
}

Pose forward(const Screws& screws, const ConfigurationRef& q) {
  Pose world_T_tool = screws.home;
  for (int i = screws.joints; i-- > 0;) {
    const auto k = static_cast<std::size_t>(i);
    if (screws.slides[k]) {
      world_T_tool.translation() += q[i] * screws.axis[k];
      continue;
    }
    const Rotation turn = Eigen::AngleAxisd(q[i], screws.axis[k]).toRotationMatrix();
    world_T_tool.linear() = turn * world_T_tool.linear();
    world_T_tool.translation() =
        screws.point[k] + turn * (world_T_tool.translation() - screws.point[k]);
  }
  return world_T_tool;
}

double miss(const Pose& goal, const Pose& reached) {
  const double distance = (goal.translation() - reached.translation()).norm();
  // |R - I| = 2 sqrt(2) sin(angle / 2), which keeps its digits where the trace loses them.
  const double chord = (goal.linear() - reached.linear()).norm() / (2 * std::sqrt(2.0));
  const double angle = 2 * std::asin(std::min(1.0, chord));
  return std::isfinite(chord) ? std::max(distance, angle) : chord;
}

bool within_limits(const Screws& screws, const ConfigurationRef& q, double slack) {
  for (int i = 0; i < screws.joints; ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (!(q[i] >= screws.lower[k] - slack && q[i] <= screws.upper[k] + slack)) return false;
  }
  return true;
}

double difference(const Screws& screws, const ConfigurationRef& a, const ConfigurationRef& b) {
  double largest = 0;
  for (int i = 0; i < screws.free; ++i) {
    const double apart = a[i] - b[i];
    const bool slides = screws.slides[i];
    largest =
        std::max(largest, std::abs(slides ? apart : std::remainder(apart, 2 * std::numbers::pi)));
  }
  return largest;
}

}  // namespace beeline::bench
