#pragma once

#include <vector>

#include <beeline/model/arm.h>

namespace beeline::internal {

/// A volume in the world that the tool's origin does not leave within the position limits: a ball
/// around the arm, swept over the ranges of the prismatic joints before all others, such as a rail.
class ToolVolume {
 public:
  explicit ToolVolume(const Arm& arm);

  /// Whether a position is proved to be more than `tolerance` outside. Of a planar arm only x and y
  /// count.
  bool excludes(const Vector3& position, double tolerance) const;

 private:
  /// The range of a prismatic joint, to both sides of its middle.
  struct Slide {
    Vector3 axis;  ///< of length 1, in the world
    double half_range;
  };

  bool add_slide(const Arm& arm, std::size_t joint, Pose& base_T_link);

  bool planar_;
  std::vector<Slide> slides_;  ///< at right angles to each other
  /// The ball with the slides in the middle of their ranges.
  Arm::Reach ball_;
};

}  // namespace beeline::internal
