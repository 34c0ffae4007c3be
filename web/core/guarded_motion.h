#pragma once

#include <optional>
#include <vector>

#include <beeline/collision/collision_model.h>
#include <beeline/control/servo.h>

namespace beeline::web {

/// Where a motion that a hand asks for has led.
struct GuardedStep {
  Configuration q;                        ///< where the arm may stand
  std::optional<NamedPair> held_by = {};  ///< the pair of bodies that keeps it from the goal
  bool is_on_its_way = false;             ///< whether the computation ended before the motion did
  bool is_goal_free = false;              ///< whether the arm could stand at the goal
};

/// Moves an arm among obstacles as a hand drags it, as far as the clearance allows.
///
/// The arm is led along joint motions that are proved to keep the clearance, so it passes through
/// no obstacle, however thin. A pair of bodies that is below its clearance at the start may only
/// come apart. The arm stops a little in front of the clearance, where a planner can start.
class GuardedMotion {
 public:
  /// `clearance`: the distance that the page shows as required, with `options` as for a model.
  GuardedMotion(const Arm& arm, const std::vector<LinkShapes>& links, const Scene& scene,
                const CollisionOptions& options);
  GuardedMotion(const GuardedMotion&) = delete;
  GuardedMotion& operator=(const GuardedMotion&) = delete;

  /// Leads the arm from one configuration towards another: on the straight joint motion if that is
  /// clear. If not, the tool slides along the bodies to where it is nearest to its pose at the
  /// goal, or, without `slides`, the arm stops on the straight motion. The work of a call is
  /// bounded: some milliseconds.
  GuardedStep towards(const Configuration& from, const Configuration& to, bool slides);

 private:
  bool go_straight(const Configuration& to, GuardedStep& step);
  bool slide(const Configuration& from, const Configuration& to, GuardedStep& step);
  bool come_apart(const Configuration& to, GuardedStep& step) const;

  Arm arm_;
  CollisionModel model_;
  Servo servo_;
};

}  // namespace beeline::web
