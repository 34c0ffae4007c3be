#include <algorithm>
#include <cmath>
#include <limits>

#include <beeline/kinematics/jacobian.h>
#include <beeline/model/internal/joint_reason.h>
#include <beeline/path/tool_path.h>
#include <beeline/timing/internal/ended_scaling.h>
#include <beeline/timing/internal/timed_section.h>
#include <beeline/trajectory/internal/given_duration.h>
#include <beeline/trajectory/internal/sample_rate.h>
#include <beeline/trajectory/internal/tool_speed.h>

namespace beeline::internal {
namespace {

/// Returns the reason if the path leaves the arm's position limits.
Reason outside(const Arm& arm, const JointPath& samples, const JointPath& refined,
               BudgetMeter& budget) {
  for (const Configuration& q : samples.q) {
    const auto violations = limit_violations(arm, q);
    if (!violations.empty()) return violations.front();
  }
  for (const Configuration& q : refined.q) {
    if (budget.ended(0)) return {};
    const auto violations = limit_violations(arm, q);
    if (violations.empty()) continue;
    return computed_violation(violations, ReasonCode::spline_outside_limits);
  }
  return {};
}

/// The least number of steps of the refined path: the default, and fewer for a path so short that
/// the rounding of its positions would count as jerk. In steps of length h = L / n the rounding r
/// of a position changes the third derivative by about 60 r / h^3, which is to be a small fraction
/// f of 1 / L^2, the third derivative of a motion along the whole path: n^3 <= f L / (60 r).
std::size_t steps_above_rounding(const JointPath& path) {
  constexpr double fraction = 0.05, fewest = 4;
  double largest = 0;
  for (const Configuration& q : path.q) largest = std::max(largest, q.lpNorm<Eigen::Infinity>());
  const double rounding = std::numeric_limits<double>::epsilon() * std::max(largest, 1e-3);
  const double steps = std::cbrt(fraction * (path.s.back() - path.s.front()) / (60 * rounding));
  const auto usual = static_cast<double>(RefineOptions{}.min_steps);
  return static_cast<std::size_t>(std::clamp(steps, fewest, usual));
}

/// Returns the limits of the path's speed ds/dt at its grid points that keep the limits of the
/// tool's speed.
std::vector<double> path_speeds(const Arm& arm, const JointPath& path, const ToolSpeeds& tool_speed,
                                BudgetMeter& budget) {
  std::vector<double> speeds;
  if (!(tool_speed.lowest() < Limits::none)) return speeds;
  Jacobian columns(6, arm.dof());
  for (std::size_t k = 0; k < path.size() && !budget.ended(0); ++k) {
    jacobian(arm, path.q[k], columns);
    const double limit = tool_speed.lowest(path.s[k], path.s[k]);
    speeds.push_back(limit / (columns.topRows<3>() * path.dq[k]).norm());
  }
  return speeds;
}

}  // namespace

double ToolSpeeds::lowest(double from, double to) const {
  double least = Limits::none;
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const bool before = i > 0 && ends[i - 1] > to;
    if (ends[i] >= from && !before) least = std::min(least, limits[i]);
  }
  return least;
}

void slow_down(TimeScaling& scaling, double k) {
  for (double& t : scaling.t) t *= k;
  for (double& v : scaling.speed) v /= k;
  for (double& a : scaling.acceleration) a /= k * k;
}

void check_options(const RetimeOptions& options) {
  if (!(options.tool_speed >= slowest_tool)) {
    throw Error("the tool's speed must be " + number(slowest_tool) + " m/s at least, not " +
                number(options.tool_speed) + " m/s");
  }
  if (options.joint_blend && !(*options.joint_blend >= 0)) {
    throw Error("", "joint_blend",
                " is " + number(*options.joint_blend) + "; it must be 0 or more");
  }
  check_rate(options.rate, "the samples of the path");
  check_duration(options.duration);
  refuse_duration_with_rate(options.duration, options.rate);
  if (options.max_samples >= 2) return;
  throw Error("", "max_samples", " must be at least 2, not " + std::to_string(options.max_samples));
}

TimedSection timed_section(const Arm& arm, const JointPath& path, const SectionOptions& options) {
  BudgetMeter& budget = options.budget;
  TimedSection section;
  section.path = refined(path, {.min_steps = steps_above_rounding(path), .budget = budget.part()});
  section.scaling.reason = outside(arm, path, section.path, budget);
  if (section.scaling.reason) return section;
  section.profile = options.profile();
  section.limits = path_limits(arm, options.timing.speed_scale);
  section.limits.speed = path_speeds(arm, section.path, options.tool_speeds, budget);
  if (budget.ended(0)) {
    section.scaling = ended_scaling(budget);
    return section;
  }
  section.scaling = time_scaling(section.path, section.limits, section.profile, budget.part());
  return section;
}

}  // namespace beeline::internal
