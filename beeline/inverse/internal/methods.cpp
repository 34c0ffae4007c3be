#include <algorithm>

#include <beeline/error.h>
#include <beeline/inverse/analytic/planar_solver.h>
#include <beeline/inverse/internal/methods.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {
namespace {

/// Six joints that turn, each by a coordinate of its own.
bool is_general_six(const Arm& arm, const Task& task) {
  return arm.dof() == 6 && arm.joints().size() == 6 && task.size() == 6 &&
         std::all_of(arm.joints().begin(), arm.joints().end(),
                     [](const Joint& joint) { return kind(joint) == JointKind::revolute; });
}

/// With a coordinate locked: the closed form that has it so for any value, if there is one.
/// Otherwise the arm is another one for each value, and is prepared when that is known.
InverseMethods locked_methods(InverseMethods methods) {
  if (methods.options.method == InverseMethod::numerical) return methods;
  methods.closed = PieperSolver::make(methods.arm, methods.task);
  if (methods.closed && methods.closed->locked() != methods.options.lock) methods.closed.reset();
  return methods;
}

/// Whether the closed form finds random configurations of the arm again, or says that they stand
/// for infinitely many. Where axes of its loop coincide it may see nothing of what is free.
bool finds_again(const PieperSolver& form, const Arm& arm) {
  constexpr int trials = 16;
  const Configuration zero = Configuration::Zero(arm.dof());
  const Bounds open = no_bounds(arm);
  PieperRequest six = form.request(zero, open.lower, open.upper);
  Splitmix random(1);
  for (int trial = 0; trial < trials; ++trial) {
    Configuration q(arm.dof()), again(arm.dof());
    for (double& value : q) value = 2 * random.next() - 1;
    PieperBranches found;
    const double value = form.locked() ? q[*form.locked()] : 0;
    form.branches(forward_kinematics(arm, q), value, six, found);
    bool met = found.continuum != 0;
    for (int lane = 0; lane < 8 && !met; ++lane) {
      if ((found.found >> lane & 1) == 0) continue;
      form.configuration(found, lane, value, again);
      constexpr double near = 1e-4;
      met = same_posture(arm, q, again, near);
    }
    if (!met) return false;
  }
  return true;
}

}  // namespace

InverseMethods inverse_methods(const Arm& arm, const InverseOptions& options) {
  check_options(arm, options);
  const Configuration middle = middle_configuration(arm);
  InverseMethods methods{arm, options, options.task.value_or(default_task(arm)),
                         options.ignore_limits ? no_bounds(arm) : bounds_of(arm), middle};
  if (options.seed) check_configuration(arm, *options.seed);
  if (options.lock) return locked_methods(std::move(methods));
  const bool formulas = options.method != InverseMethod::numerical;
  methods.planar = formulas && has_planar_closed_form(arm, methods.task);
  if (formulas && !methods.planar) methods.closed = PieperSolver::make(arm, methods.task);
  if (methods.closed) methods.closed_is_sure = finds_again(*methods.closed, arm);
  methods.general_six = formulas && !methods.closed && is_general_six(arm, methods.task);
  // For one solution descents are sooner there.
  if (options.all || options.method == InverseMethod::closed_form) {
    methods.general = prepared_general(methods);
  }
  if (options.method == InverseMethod::closed_form && !methods.planar && !methods.closed &&
      !methods.general) {
    throw Error("arm " + arm.name() + " has no closed form for the task " + name(methods.task) +
                "; method numerical solves it");
  }
  return methods;
}

void check_lock(const InverseMethods& methods, const ConfigurationRef& seed) {
  if (methods.options.ignore_limits) return;
  const int k = *methods.options.lock;
  const double lower = methods.bounds.lower[k], upper = methods.bounds.upper[k];
  if (seed[k] >= lower && seed[k] <= upper) return;
  const Joint& joint = methods.arm.joint_of(k);
  throw Error("joint " + joint.name + " is locked at " + with_unit(joint, seed[k]) +
              "; its limits are " + with_unit(joint, lower) + " to " + with_unit(joint, upper));
}

std::optional<RaghavanRothSolver> prepared_general(const InverseMethods& methods) {
  if (!methods.general_six) return std::nullopt;
  RaghavanRothSolver general(methods.arm.chain());
  return general.reliable() ? std::optional(std::move(general)) : std::nullopt;
}

std::string description(const InverseMethods& methods) {
  if (methods.planar) return "closed form: planar";
  if (methods.closed) return "closed form: " + methods.closed->family(methods.missing);
  if (methods.general) return "closed form: general six joints";
  return "numerical";
}

}  // namespace beeline::internal
