#pragma once

#include <span>
#include <string>
#include <vector>

#include <beeline/formula/internal/symbolic_twists.h>
#include <beeline/kinematics/jacobian.h>

namespace beeline::internal {

/// The poses of all places of the list in the world, for given values of all symbols.
std::vector<Pose> place_poses(const TransformList& list, std::span<const double> symbols);

/// The pose of frame `to` in frame `from`, see pose_between().
Pose numeric_pose(const SymbolicArm& arm, std::size_t from, std::size_t to,
                  std::span<const double> symbols);

/// The numbers of symbolic_twists() for places with these poses.
Jacobian numeric_twists(const SymbolicArm& arm, const TransformList& list,
                        const std::vector<Pose>& places, std::span<const double> symbols,
                        const TwistFrame& frame);

/// Returns the sum of all constant lengths, plus 1 for each displacement: the scale of rounding
/// errors of positions.
double length_scale(const SymbolicArm& arm);

/// Throws Error, which names the formula `what`, if its numbers differ by more than rounding from
/// the numbers of the transforms. Rounding is relative to `scale`.
void check_formula(const SymbolicArm& arm, const Eigen::MatrixXd& formula,
                   const Eigen::MatrixXd& expected, double scale, const std::string& what);

/// Returns random configurations for checks of formulas, the same for each arm and call: angles
/// within +-3 rad, displacements within +-1 m.
std::vector<Configuration> check_configurations(const SymbolicArm& arm, int count);

}  // namespace beeline::internal
