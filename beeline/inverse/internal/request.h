#pragma once

#include <beeline/internal/budget_meter.h>
#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/inverse/numerical/bounds.h>

namespace beeline::internal {

struct SolverState;

/// One request for inverse kinematics, checked and with its defaults filled in.
struct Request {
  const Arm& arm;
  const InverseOptions& options;
  Pose goal;
  Task task;
  Configuration seed;
  const Bounds& bounds;          ///< the joint limits, or none if they are ignored
  const Configuration& weights;  ///< weights of the coordinates in distances
  double tolerance;
  BudgetMeter& budget;
};

/// Returns the options. Throws Error if they are not valid for the arm, whatever the pose.
const InverseOptions& checked_options(const Arm& arm, const InverseOptions& options);

/// Requires checked options. Throws Error when pose or seed are not valid.
Request make_request(const SolverState& state, const Pose& world_T_tool, const Configuration& seed,
                     BudgetMeter& budget);

/// Returns the weighted distance of q from the seed.
double distance_from_seed(const Request& request, const Configuration& q);

/// Replaces the angles of joints without limits that are more than `beyond` from zero, radians, by
/// their representatives in (-pi, pi]: sums of many turns lose digits.
void wrap_unlimited_angles(const Arm& arm, const Bounds& bounds, double beyond, Configuration& q);

}  // namespace beeline::internal
