#include <algorithm>
#include <cmath>
#include <memory>

#include <beeline/inverse/internal/arm_defaults.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/inverse/numerical/seed_table.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/math/six_row_svd.h>

namespace beeline::internal {
namespace {

/// Returns the largest error of random configurations of the arm that the closed form recovers,
/// infinite if it reports a continuum for all of them, or nothing if it does neither for one. That
/// happens if axes of its loop coincide. Sixteen trials suffice, because it then fails almost
/// everywhere. The tolerance 1e-4 is far below the distance of other solutions and far above
/// rounding.
std::optional<double> recovered_error(const PieperSolver& kept, const Arm& arm, const Task& task) {
  constexpr int trials = 16;
  std::optional<double> error;
  std::unique_ptr<PieperSolver> own;
  const Configuration zero = Configuration::Zero(arm.dof());
  const Bounds open = no_bounds(arm);
  PieperRequest loop = kept.request(zero, Configuration::Ones(arm.dof()), open.lower, open.upper);
  Splitmix random(1);
  for (int trial = 0; trial < trials; ++trial) {
    Configuration q(arm.dof()), recovered(arm.dof());
    for (double& value : q) value = 2 * random.next() - 1;
    const Pose goal = forward_kinematics(arm, q);
    const PieperSolver* form = kept.for_goal(chain_of(arm), goal, own);
    if (form == nullptr) return std::nullopt;
    PieperBranches found;
    const double value = kept.locked() ? q[*kept.locked()] : 0;
    form->branches(goal, value, loop, found);
    bool met = found.continuum != 0;
    for (int lane = 0; lane < 8 && !met; ++lane) {
      if ((found.found >> lane & 1) == 0) continue;
      form->configuration(found, lane, value, recovered.data());
      met = same_posture(arm, q, recovered, 1e-4);
      if (!met) continue;
      const Deviation off = task_deviation(task, goal, forward_kinematics(arm, recovered));
      error = std::max({error.value_or(0), off.position, off.orientation});
    }
    if (!met) return std::nullopt;
  }
  return error.value_or(Limits::none);
}

/// Whether an arm of six or more joints is singular at every configuration, such as a
/// shoulder-elbow-wrist arm of six joints with its elbow locked. Its poses have no solution, or
/// more than the closed form counts.
bool is_singular_everywhere(const Arm& arm) {
  if (arm.dof() < 6) return false;
  // Of seven joints, the values of the locked one lose their solutions to rounding sooner.
  const double rounding = arm.dof() == 6 ? 1e-12 : 1e-6;
  Splitmix random(1);
  Configuration q(arm.dof());
  for (int trial = 0; trial < 3; ++trial) {
    for (double& value : q) value = 2 * random.next() - 1;
    const SixRowSvd svd = six_row_svd(jacobian(arm, q));
    if (svd.singular_values[5] > rounding * svd.singular_values[0]) return false;
  }
  return true;
}

}  // namespace

PieperForm PieperForm::make(const Arm& arm, const Task& task) {
  PieperForm form;
  if (!is_singular_everywhere(arm)) form.solver = PieperSolver::make(arm, task);
  if (!form.solver) return form;
  const std::optional<double> error = recovered_error(*form.solver, arm, task);
  form.verified = error.has_value();
  form.error = error.value_or(Limits::none);
  form.name = form.solver->family();
  return form;
}

}  // namespace beeline::internal
