#pragma once

#include <array>

#include "arms.h"

namespace beeline::bench {

/// The arm as axes in the world at q = 0: a product of exponentials (Brockett 1984). Written apart
/// from beeline/kinematics, so that no answer is checked by the code that gave it.
struct Screws {
  static constexpr int most = 7;

  int joints = 0;
  int free = 0;     ///< the first `free` joints move
  double last = 0;  ///< where the last joint stands if it does not
  std::array<Vector3, most> axis;
  std::array<Vector3, most> point;  ///< a point of the axis; unused where the joint slides
  std::array<bool, most> slides{};
  std::array<double, most> lower{}, upper{};
  Pose home = Pose::Identity();  ///< of the tool at q = 0
};

/// Throws Error for an arm with more than seven joints, helical or mimic joints.
Screws screws_of(const BenchArm& arm);

/// A frame in the world at q = 0 whose z axis is that of joint i.
Pose axis_frame(const Screws& screws, std::size_t i);

/// The tool's pose; q holds screws.joints values.
Pose forward(const Screws& screws, const ConfigurationRef& q);

/// The larger of the distance (metres) and the angle (radians) between two poses.
double miss(const Pose& goal, const Pose& reached);

/// Whether every value of q is finite and within its limits, to `slack`.
bool within_limits(const Screws& screws, const ConfigurationRef& q, double slack);

/// The largest difference in any value, whole turns aside where the joint turns.
double difference(const Screws& screws, const ConfigurationRef& a, const ConfigurationRef& b);

}  // namespace beeline::bench
