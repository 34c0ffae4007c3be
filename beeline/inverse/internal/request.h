#pragma once

#include <algorithm>

#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/bounds.h>

namespace beeline::internal {

struct SolverState;

/// One request for inverse kinematics, checked and with its defaults filled in. Seed, bounds and
/// weights outlive it.
struct Request {
  const Arm& arm;
  const InverseOptions& options;
  Pose goal;
  Task task;
  ConfigurationRef seed;
  const Bounds& bounds;          ///< the joint limits, or none if they are ignored
  const Configuration& weights;  ///< weights of the coordinates in distances
  double tolerance;
  BudgetMeter& budget;
  Redundancy redundancy;   ///< options.redundancy, or `any`
  bool near_seed = false;  ///< whether `any` solution moves to a local minimum of the distance
  /// Whether the steps take the effort that suffices for most poses: few values of a redundant
  /// joint, few restarts, and no corrections of solutions within the tolerance.
  bool quick = false;
  /// Whether the residual of a closed form stands for the error by forward kinematics.
  bool skips_forward_check = false;
  bool has_lock = false;  ///< whether `arm` is another one with a coordinate locked

  /// Whether the task determines all coordinates but the locked one.
  bool finitely_many() const { return arm.dof() - (options.lock ? 1 : 0) <= task.size(); }

  /// The error up to which a solution is not corrected. A correction would move a locked joint.
  double accepted_error() const {
    const bool coarse = options.lock || (quick && !options.all);
    return coarse ? tolerance : std::max(1e-13, tolerance / 100);
  }
};

/// Returns the options. Throws Error if they are not valid for the arm, whatever the pose.
const InverseOptions& checked_options(const Arm& arm, const InverseOptions& options);

/// Requires checked options and a seed that fits. Throws Error when the pose is not valid.
Request make_request(const SolverState& state, const Pose& world_T_tool,
                     const ConfigurationRef& seed, BudgetMeter& budget);

/// Returns the weighted distance of q from the seed.
double distance_from_seed(const Request& request, const ConfigurationRef& q);

/// Replaces the angles of joints without limits that are more than `beyond` from zero, radians, by
/// their representatives in (-pi, pi]: sums of many turns lose digits.
void wrap_unlimited_angles(const Arm& arm, const Bounds& bounds, double beyond, Configuration& q);

}  // namespace beeline::internal
