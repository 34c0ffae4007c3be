#pragma once

#include <optional>
#include <span>
#include <string>

#include <beeline/control/joint.h>
#include <beeline/error.h>
#include <beeline/kinematics/task.h>

namespace beeline {

/// The method of Cartesian control (Dellaert, *Serial Link Manipulators*, section 1.8).
enum class CartesianMethod {
  inverse_jacobian,    ///< eq. 1.6: the inverse Jacobian maps the tool's pose error to joint space
  inverse_kinematics,  ///< inverse kinematics at intermediate poses, joint-space control between
};
std::string name(CartesianMethod method);

struct CartesianOptions {
  CartesianMethod method = CartesianMethod::inverse_jacobian;
  /// Task rows that are controlled; default: planar for a planar arm, whose waypoints must then be
  /// in its plane, else spatial.
  std::optional<Task> task = std::nullopt;
  double gain = 0.1;  ///< K_p of the chapter, fraction of the error per step, above 0
  /// Number of poses on each line, including its end, 1 or more; for
  /// CartesianMethod::inverse_kinematics only.
  int intermediate = 10;
  SimulationOptions simulation = {};  ///< tolerance, steps and time step
};

/// Moves the tool towards each waypoint in turn by feedback control. The tool's path is straight
/// only approximately, depending on the gain. path_deviation() measures it; move_in_lines()
/// computes a motion with a proved bound.
/// The Jacobian's inverse is damped near singularities, and no step rotates a joint by more than 1
/// rad. Orientation errors are differences of angles in [-pi, pi]. Joint limits are kept; if the
/// arm cannot continue, the motion stops with a status and a reason.
/// Throws Error for an invalid start, waypoint or option.
ControlledMotion control_in_lines(const Arm& arm, const Configuration& start,
                                  std::span<const Pose> waypoints,
                                  const CartesianOptions& options = {});

}  // namespace beeline
