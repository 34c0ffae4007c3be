#include <algorithm>
#include <bit>

#include <beeline/error.h>
#include <beeline/inverse/lock.h>
#include <beeline/inverse/locked_joint.h>
#include <beeline/inverse/methods.h>
#include <beeline/inverse/reason.h>
#include <beeline/inverse/solve.h>

namespace beeline {
namespace {

constexpr const char* method_names[] = {"automatic", "closed_form", "numerical"};
constexpr const char* redundancy_names[] = {"any", "nearest", "centred"};
constexpr const char* status_names[] = {"solved", "unreachable", "orientation", "outside_limits",
                                        "not_found"};

template <std::size_t n>
int named(std::string_view name, const char* const (&names)[n], const char* what) {
  const auto* found = std::find(std::begin(names), std::end(names), name);
  if (found != std::end(names)) return static_cast<int>(found - names);
  throw unknown_name(what, name, {std::begin(names), std::end(names)});
}

/// Why a solution that was found is not the only one of its kind.
std::string continuum_reason(const Arm& arm) {
  return "singular: arm " + arm.name() +
         " can move there with the tool at rest, so that there are infinitely many solutions; "
         "those "
         "given have the joints concerned nearest to the seed";
}

InverseResult answer(InverseMethods& methods, const Pose& world_T_tool, const Configuration& seed,
                     bool with_reason);

/// With a coordinate locked that no closed form is prepared for: another arm for each value of it.
InverseResult answer_locked(InverseMethods& methods, const Pose& world_T_tool,
                            const Configuration& seed, bool with_reason) {
  check_configuration(methods.arm, seed);
  const int k = *methods.options.lock;
  const double value = seed[k];
  const Limits& limits = methods.arm.limits()[static_cast<std::size_t>(k)];
  if (!methods.options.ignore_limits && !(value >= limits.lower && value <= limits.upper)) {
    throw Error("joint " + methods.arm.joint_of(k).name + " is locked at " + number(value) +
                ", outside its limits");
  }
  InverseOptions options = methods.options;
  options.lock.reset();
  options.seed.reset();
  options.task = methods.task;
  InverseMethods shorter = inverse_methods(with_locked(methods.arm, k, value), options);
  InverseResult result = answer(shorter, world_T_tool, without(seed, k), with_reason);
  for (Configuration& q : result.solutions) q = with(q, k, value);
  if (result.nearest) {
    result.nearest->q = with(result.nearest->q, k, value);
    if (result.nearest->blocking >= k) ++result.nearest->blocking;
  }
  return result;
}

/// Reasons take longer than answers: they are left out where nobody asks for them.
InverseResult answer(InverseMethods& methods, const Pose& world_T_tool, const Configuration& seed,
                     bool with_reason) {
  if (methods.options.lock && !methods.closed) {
    return answer_locked(methods, world_T_tool, seed, with_reason);
  }
  const Question ask =
      question(methods.arm, methods.options, methods.task, methods.bounds, world_T_tool, seed);
  InverseResult result;
  result.method = description(methods);
  const bool formulas = methods.planar || methods.closed || methods.general;
  Beyond beyond;
  const auto stays = against_what_stays(ask.arm, ask.goal, ask.task, ask.tolerance);
  if (stays) {
    result.method = "what no joint can change";
    beyond.complete = true;
  } else if (formulas) {
    beyond = solve_closed(methods, ask, result);
  }
  const bool far = !limits_bound_reach(ask.arm) &&
                   beyond_reach(ask.arm, ask.goal, ask.task, ask.tolerance).has_value();
  // Of a continuum another member may be within limits.
  const bool last_word = beyond.complete && !(beyond.continuum && result.solutions.empty());
  const bool lacking = result.solutions.empty() || (methods.general && ask.options.all);
  if (lacking && !last_word && !far && methods.options.method != InverseMethod::closed_form) {
    const bool added = result.solutions.empty();
    beyond = solve_numerical(methods, ask, result, beyond);
    if (added && !result.solutions.empty()) result.method = "numerical";
    if (result.solutions.empty() && !formulas && with_reason) {
      prepare_general(methods);  // to be sure
      if (methods.general) beyond = solve_closed(methods, ask, result);
    }
  }
  if (!result.solutions.empty()) {
    finish(ask, result);
    if (result.singular) result.reason = continuum_reason(ask.arm);
  } else if (with_reason) {
    explain(methods, ask, beyond, result);
    if (stays) result.reason = stays->reason;
    if (stays && result.status != InverseStatus::outside_limits) result.residual = stays->missing;
  }
  return result;
}

/// The closed form's answer where nothing about it needs a second look; -1 where something does.
int quick(InverseMethods& methods, const Pose& goal, const ConfigurationRef& seed,
          Eigen::Ref<Eigen::MatrixXd> solutions) {
  const ClosedForm& form = *methods.closed;
  SixQuestion six = form.question(seed, methods.bounds.lower, methods.bounds.upper);
  LockedBranch branch;
  const bool scans = form.locked() >= 0 && !methods.options.lock;
  if (scans) {
    if (methods.options.all || methods.options.redundancy != Redundancy::any) return -1;
    const LockedRange range = locked_range(methods.arm, methods.bounds, seed, form);
    // A few values find most; for the rest descents from near them find more than more values.
    constexpr int few = 9;
    LeastOutside outside;
    branch = first_within(form, goal, range, std::min(few, methods.options.grid), six, outside);
    if (branch.lane < 0 && outside.count > 0 &&
        descend_from(methods, goal, outside, methods.options.tolerance, solutions.col(0))) {
      return 1;
    }
    if (branch.lane < 0) return descend_at_once(methods, goal, seed, solutions);
  } else {
    if (form.locked() >= 0) branch.value = seed[form.locked()];
    form.branches(goal, branch.value, six, branch.found);
    branch.lane = nearest_lane(form, branch.found);
  }
  const SixBranches& found = branch.found;
  if (!methods.options.all) {
    if (branch.lane < 0 || (found.continuum >> branch.lane & 1) != 0) return -1;
    form.configuration(found, branch.lane, branch.value, solutions.col(0));
    return 1;
  }
  if (methods.options.every_turn || found.continuum != 0 || nearly_found(form, found)) return -1;
  const double closed = closed_residual(form);
  int lanes[8], count = 0;
  for (unsigned rest = found.found; rest != 0; rest &= rest - 1) {
    const int lane = std::countr_zero(rest);
    if (!(found.residual[lane] <= closed)) return -1;
    if ((found.within >> lane & 1) == 0) {
      // A hair outside its limits it may still be mended.
      constexpr double hair = 1e-6;
      if (found.excess[lane] < hair) return -1;
      continue;
    }
    int place = count++;
    for (; place > 0 && found.distance[lanes[place - 1]] > found.distance[lane]; --place) {
      lanes[place] = lanes[place - 1];
    }
    lanes[place] = lane;
  }
  constexpr double twin = 1e-5;  // solutions this near to each other may be one
  for (int i = 1; i < count; ++i) {
    if (found.distance[lanes[i]] - found.distance[lanes[i - 1]] < twin) {
      bool same = true;
      for (const auto& q : found.q) same = same && std::abs(q[lanes[i]] - q[lanes[i - 1]]) < twin;
      if (same) return -1;
    }
  }
  count = std::min(count, static_cast<int>(solutions.cols()));
  for (int i = 0; i < count; ++i) {
    form.configuration(found, lanes[i], branch.value, solutions.col(i));
  }
  return count;
}

}  // namespace

InverseMethod inverse_method_named(std::string_view name) {
  return static_cast<InverseMethod>(named(name, method_names, "method"));
}
std::string name(InverseMethod method) { return method_names[static_cast<int>(method)]; }

Redundancy redundancy_named(std::string_view name) {
  return static_cast<Redundancy>(named(name, redundancy_names, "redundancy"));
}
std::string name(Redundancy redundancy) { return redundancy_names[static_cast<int>(redundancy)]; }

std::string name(InverseStatus status) { return status_names[static_cast<int>(status)]; }

InverseSolver::InverseSolver(const Arm& arm, const InverseOptions& options)
    : methods_(std::make_unique<InverseMethods>(inverse_methods(arm, options))) {}
InverseSolver::InverseSolver(const InverseSolver& other)
    : methods_(std::make_unique<InverseMethods>(*other.methods_)) {}
InverseSolver::~InverseSolver() = default;

std::string InverseSolver::method() const { return description(*methods_); }

InverseResult InverseSolver::solve(const Pose& world_T_tool) {
  return solve(world_T_tool, methods_->options.seed ? *methods_->options.seed : methods_->middle);
}

InverseResult InverseSolver::solve(const Pose& world_T_tool, const ConfigurationRef& seed) {
  return answer(*methods_, world_T_tool, seed, true);
}

int InverseSolver::solve(const Pose& world_T_tool, const ConfigurationRef& seed,
                         Eigen::Ref<Eigen::MatrixXd> solutions) {
  check_configuration(methods_->arm, seed);
  if (solutions.rows() != methods_->arm.dof() || solutions.cols() < 1) {
    throw Error("solutions need " + std::to_string(methods_->arm.dof()) +
                " rows and at least one column");
  }
  const Pose goal = checked_pose(world_T_tool);
  if (methods_->closed) {
    const int count = quick(*methods_, goal, seed, solutions);
    if (count >= 0) return count;
  } else if (!methods_->planar && !methods_->general && !methods_->options.all &&
             !methods_->options.lock) {
    return descend_at_once(*methods_, goal, seed, solutions);
  }
  const InverseResult result = answer(*methods_, goal, seed, false);
  const auto room = static_cast<std::size_t>(solutions.cols());
  const std::size_t count = std::min(room, result.solutions.size());
  for (std::size_t i = 0; i < count; ++i) {
    solutions.col(static_cast<Eigen::Index>(i)) = result.solutions[i];
  }
  return static_cast<int>(count);
}

InverseResult inverse_kinematics(const Arm& arm, const Pose& world_T_tool,
                                 const InverseOptions& options) {
  return InverseSolver(arm, options).solve(world_T_tool);
}

}  // namespace beeline
