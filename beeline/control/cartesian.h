#pragma once

#include <optional>
#include <span>

#include <beeline/control/simulate.h>
#include <beeline/kinematics/task.h>

namespace beeline {

/// The chapter's two ways to move the tool from pose to pose (section 1.8).
enum class CartesianMethod {
  inverse_jacobian,    ///< eq. 1.6: the error in the workspace, through the Jacobian's inverse
  inverse_kinematics,  ///< inverse kinematics at poses on the way, joint control between them
};
std::string name(CartesianMethod method);

struct CartesianOptions {
  CartesianMethod method = CartesianMethod::inverse_jacobian;
  std::optional<Task> task = std::nullopt;  ///< default: planar for a planar arm, else spatial
  double gain = 0.1;                        ///< the chapter's K_p
  int intermediate = 10;  ///< poses on each line, its end counted; inverse_kinematics only
  SimulationOptions simulation = {};
};

/// Moves the tool towards each waypoint in turn by feedback. How straight that is depends on the
/// gain and is told by path_deviation(); move_in_lines() is the motion that is straight by proof.
/// The Jacobian is damped near singularities, no step turns a joint by more than a radian, angles
/// are compared by ⊖, limits are kept; where the arm cannot go on the motion stops with a reason.
/// Throws Error when the start, a waypoint or an option makes no sense.
ControlledMotion control_in_lines(const Arm& arm, const Configuration& start,
                                  std::span<const Pose> waypoints,
                                  const CartesianOptions& options = {});

}  // namespace beeline
