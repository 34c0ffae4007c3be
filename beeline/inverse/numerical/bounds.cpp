#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/inverse/numerical/bounds.h>

namespace beeline::internal {
Bounds bounds_of(const Arm& arm) {
  Bounds bounds = no_bounds(arm);
  for (int k = 0; k < arm.dof(); ++k) {
    bounds.lower[k] = arm.limits(k).lower;
    bounds.upper[k] = arm.limits(k).upper;
  }
  return bounds;
}

Bounds no_bounds(const Arm& arm) {
  return {Configuration::Constant(arm.dof(), -Limits::none),
          Configuration::Constant(arm.dof(), Limits::none)};
}

bool any_finite(const Bounds& bounds) {
  return bounds.lower.array().isFinite().any() || bounds.upper.array().isFinite().any();
}

bool within(const Bounds& bounds, const Configuration& q) {
  return (q.array() >= bounds.lower.array()).all() && (q.array() <= bounds.upper.array()).all();
}

Configuration clamped(const Bounds& bounds, Configuration q) {
  q = q.cwiseMax(bounds.lower).cwiseMin(bounds.upper);
  return q;
}

double excess(const Bounds& bounds, const Configuration& q) {
  return (bounds.lower - q).cwiseMax(q - bounds.upper).cwiseMax(0).sum();
}

void check_task(const Arm& arm, const Task& task, const Bounds& bounds) {
  check_task(task);
  if (bounds.lower.size() != arm.dof() || bounds.upper.size() != arm.dof() ||
      !(bounds.lower.array() <= bounds.upper.array()).all()) {
    throw Error("the bounds for arm " + arm.name() + " need " + std::to_string(arm.dof()) +
                " lower values, none above its upper one");
  }
}

double unit_of_length(const Arm& arm) {
  constexpr double rounding = 1e-12;  // metres and relative: a tool that never moves has no reach
  const Arm::Reach& reach = arm.reach();
  return reach.size > rounding * std::max(1.0, reach.centre.norm()) ? reach.size : 1;
}

}  // namespace beeline::internal
