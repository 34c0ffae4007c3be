#pragma once

#include <array>

#include "arms.h"

namespace beeline::bench {

/// The arm as axes in the world at q = 0: a product of exponentials (Brockett 1984). Independent
/// of beeline/kinematics, so that no answer is checked by the code that computed it.
struct Screws {
  static constexpr int most = 7;

  int joints = 0;
  int free = 0;     ///< the first `free` joints move
  double last = 0;  ///< value of a locked last joint
  std::array<Vector3, most> axis;
  std::array<Vector3, most> point;  ///< a point of the axis; unused for a prismatic joint
  std::array<bool, most> slides{};
  std::array<double, most> lower{}, upper{};
  Pose home = Pose::Identity();  ///< tool pose at q = 0
};

/// Throws Error for an arm with more than seven joints, helical or mimic joints.
Screws screws_of(const BenchArm& arm);

/// Returns a frame at q = 0, in the world, whose z axis is the axis of joint i.
Pose axis_frame(const Screws& screws, std::size_t i);

/// Returns the tool pose; q has screws.joints values.
Pose forward(const Screws& screws, const ConfigurationRef& q);

/// Returns the larger of the distance (metres) and the angle (radians) between two poses.
double miss(const Pose& goal, const Pose& reached);

/// Returns whether every value of q is finite and within its limits, up to `slack`.
bool within_limits(const Screws& screws, const ConfigurationRef& q, double slack);

/// Returns the largest difference of any value, modulo full revolutions for revolute joints.
double difference(const Screws& screws, const ConfigurationRef& a, const ConfigurationRef& b);

}  // namespace beeline::bench
