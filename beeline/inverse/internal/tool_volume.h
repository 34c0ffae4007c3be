#pragma once

#include <array>

#include <beeline/kinematics/task.h>

namespace beeline::internal {

/// Returns a ball that the tool never leaves, with or without joint limits; smaller than
/// Arm::reach(). The radius is infinite if a joint that moves is not revolute.
Arm::Reach ball_of_tool(const Arm& arm);

/// A volume in the world that the tool's origin never leaves: a ball around the arm, swept over the
/// ranges of the prismatic joints before all others, such as a rail. The volume is rounded
/// outwards.
class ToolVolume {
 public:
  explicit ToolVolume(const Arm& arm);

  /// Whether it is proved that no configuration, within the position limits or with limits ignored,
  /// brings the tool within `tolerance` of the pose's position, in the rows of the task.
  bool excludes(const Pose& world_T_tool, const Task& task, double tolerance,
                bool ignore_limits) const;

 private:
  /// The range of a prismatic joint, to both sides of its middle. A range without an end is
  /// infinite.
  struct Slide {
    Vector3 axis = Vector3::Zero();  ///< of length 1, in the world
    double half_range = 0;
  };

  bool add_slide(const Joint& joint, Pose& base_T_link);

  std::array<Slide, 3> slides_ = {};  ///< at right angles to each other
  std::size_t slide_count_ = 0;
  /// The balls with the slides in the middle of their ranges, of the other joints within their
  /// limits and with limits ignored.
  Arm::Reach limited_ball_, ball_;
};

}  // namespace beeline::internal
