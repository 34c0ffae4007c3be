#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/inverse/numerical/nearest_on_self_motion.h>
#include <beeline/inverse/numerical/representative.h>

// As in gauss_newton.cpp.
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beeline/inverse/numerical/nearest_on_self_motion.cpp"

#include <hwy/foreach_target.h>

#include <beeline/inverse/numerical/gauss_newton-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

using namespace internal;
using namespace gauss_newton;

/// The derivative of half the squared distance from a start along the self-motion, at the last
/// Jacobian. The unit tangent replaces near.move.
struct Slope {
  double value = 0;      ///< along the tangent, which is in the direction of the last tangent
  double curvature = 0;  ///< for straight self-motion
};

HWY_INLINE Slope slope_of_distance(const double* start, const double* weight,
                                   GaussNewtonState& near) {
  double dual[6] = {};
  const size_t dof = near.q.size();
  for (size_t k = 0; k < dof; ++k) {
    near.move[k] = near.free[k] ? weight[k] * (near.q[k] - start[k]) : 0;
    for (int r = 0; r < 6; ++r) dual[r] += near.column[k].lane[r] * near.move[k];
  }
  solve(near.normal, dual);
  double square = 0, curvature = 0, forward = 0;
  for (size_t k = 0; k < dof; ++k) {
    near.move[k] -= along(near.column[k].lane, dual);
    square += near.move[k] * near.move[k];
    curvature += weight[k] * near.move[k] * near.move[k];
    forward += near.move[k] * near.tangent[k];
  }
  if (!(square > 0)) return {0, 1};
  const double length = std::sqrt(square), sign = forward < 0 ? -1 : 1;
  for (double& component : near.move) component *= sign / length;
  return {sign * length, curvature / square};
}

HWY_INLINE double squared_distance(const double* start, const double* weight,
                                   const std::vector<double>& q) {
  double sum = 0;
  for (size_t k = 0; k < q.size(); ++k) sum += weight[k] * (q[k] - start[k]) * (q[k] - start[k]);
  return sum;
}

/// Brings the tool back to the goal after a step along the self-motion, to a squared error of
/// `enough` or, if that is not reached, within the tolerance. Returns whether it is there.
HWY_INLINE bool return_to_goal(const NumericalProblem& problem, const double* goal, double enough,
                               const LaneOptions& options, GaussNewtonState& near) {
  constexpr int most = 6;
  constexpr double renewed_from = 1e-12;  // squared error; below, the last factors suffice
  const double tolerance = options.tolerance / problem.length;
  double before = HUGE_VAL;
  for (int i = 0; i < most; ++i) {
    double tool_position[3], dual[6];
    if (!evaluate(problem, goal, near, tool_position)) return false;
    const double* e = near.error;
    const double position = e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
    const double orientation = e[3] * e[3] + e[4] * e[4] + e[5] * e[5];
    const double cost = position + orientation;
    if (cost <= enough) return true;
    if (!(cost < before / 2)) {
      return position <= tolerance * tolerance &&
             orientation <= options.tolerance * options.tolerance && cost <= fine;
    }
    before = cost;
    if (cost > renewed_from || i > 1) {
      linearise(problem, tool_position, near);
      factorise(min_damping, near.normal);
    }
    for (int r = 0; r < 6; ++r) dual[r] = e[r];
    solve(near.normal, dual);
    for (size_t k = 0; k < near.q.size(); ++k) {
      const auto& coordinate = problem.coordinates[k];
      const double q = near.q[k] + along(near.column[k].lane, dual);
      near.q[k] = std::min(std::max(q, coordinate.lower), coordinate.upper);
      near.free[k] &= near.q[k] == q;
    }
  }
  return false;
}

/// The part of the step along near.move that stays within the bounds. The joint that reaches its
/// bound is no longer free.
HWY_INLINE double step_within(const NumericalProblem& problem, double step,
                              GaussNewtonState& near) {
  size_t stopped = near.q.size();
  for (size_t k = 0; k < near.q.size(); ++k) {
    const auto& coordinate = problem.coordinates[k];
    const double q = near.q[k] + step * near.move[k];
    if (q >= coordinate.lower && q <= coordinate.upper) continue;
    const double bound = q < coordinate.lower ? coordinate.lower : coordinate.upper;
    step = (bound - near.q[k]) / near.move[k];
    stopped = k;
  }
  if (stopped < near.q.size()) near.free[stopped] = false;
  return step;
}

/// The Jacobian at near.q with all joints free.
HWY_INLINE bool renew(const NumericalProblem& problem, const double* goal, GaussNewtonState& near) {
  double tool_position[3];
  for (char& free : near.free) free = true;
  if (!evaluate(problem, goal, near, tool_position)) return false;
  linearise(problem, tool_position, near);
  factorise(min_damping, near.normal);
  return true;
}

bool approach(const NumericalProblem& problem, const double* goal, const double* start,
              const double* weight, const LaneOptions& options, GaussNewtonState& near) {
  constexpr int most = 8;
  constexpr double longest = 0.3;      // radians or units of length
  constexpr double negligible = 1e-4;  // of the distance, which then changes by its square
  constexpr double last_step = 0.01;   // of the distance: the next step would be negligible
  constexpr double coarse = 1e-14;     // squared error between the steps
  double square = squared_distance(start, weight, near.q), scale = 1;
  double slope_before = 0, step = 0;
  bool renewed = false;
  std::fill(near.tangent.begin(), near.tangent.end(), 0.0);
  for (int i = 0; i < most; ++i) {
    if (!renewed && !renew(problem, goal, near)) return false;
    const Slope slope = slope_of_distance(start, weight, near);
    double curvature = slope.curvature;
    if (step != 0) {  // the secant has the curvature of the self-motion
      const double secant = (slope.value - slope_before) / step;
      curvature = std::min(std::max(secant, curvature / 10), curvature * 10);
    }
    slope_before = slope.value;
    step = std::min(std::max(-scale * slope.value / curvature, -longest), longest);
    const double change = std::abs(step) * std::sqrt(slope.curvature), distance = std::sqrt(square);
    if (change <= negligible * distance) break;
    const bool last = change <= last_step * distance;
    near.before = near.q;
    const double within = step_within(problem, step, near);
    for (size_t k = 0; k < near.q.size(); ++k) near.q[k] += within * near.move[k];
    near.tangent = near.move;
    const bool there =
        within != 0 && return_to_goal(problem, goal, last ? polished : coarse, options, near);
    const double now = squared_distance(start, weight, near.q);
    if (there && now < square) {
      if (last) return true;
      renewed = std::find(near.free.begin(), near.free.end(), false) == near.free.end();
      square = now;
      scale = 1;
      step = within;
      continue;
    }
    near.q = near.before;  // the step is too long, or leaves the bounds
    renewed = false;
    if (within == 0 || scale < 0.1) break;
    step = 0;
    scale /= 4;
  }
  near.before = near.q;
  if (renew(problem, goal, near) && return_to_goal(problem, goal, polished, options, near)) {
    return true;
  }
  near.q = near.before;  // next to a singularity the correction may be too long
  return return_to_goal(problem, goal, fine, options, near);
}

}  // namespace
}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace beeline {

HWY_EXPORT(approach);

namespace internal {

bool approach_start(const NumericalProblem& problem, const Pose& world_T_tool, const double* start,
                    const double* weights, const LaneOptions& options, GaussNewtonState& near) {
  for (std::size_t k = 0; k < near.q.size(); ++k) {
    const NumericalProblem::Coordinate& coordinate = problem.coordinates[k];
    near.start[k] = start[k] / coordinate.unit;
    near.weight[k] = weights[k] * coordinate.unit * coordinate.unit;
    if (coordinate.periodic && std::abs(near.q[k] - near.start[k]) > std::numbers::pi) {
      near.q[k] = std::clamp(
          nearest_angle_within(near.q[k], near.start[k], coordinate.lower, coordinate.upper),
          coordinate.lower, coordinate.upper);
    }
  }
  const Pose goal = last_link_goal(problem, world_T_tool);
  return HWY_DYNAMIC_DISPATCH(approach)(problem, goal.data(), near.start.data(), near.weight.data(),
                                        options, near);
}

}  // namespace internal
}  // namespace beeline

#endif
