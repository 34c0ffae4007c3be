#include <algorithm>
#include <cmath>

#include <beeline/inverse/numerical/gauss_newton.h>

// 256-bit registers are faster here: one configuration leaves a 512-bit register nearly empty, and
// stores of single numbers delay the wide loads that follow them.
#undef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3 | HWY_AVX3_DL)
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beeline/inverse/numerical/gauss_newton.cpp"
#include <beeline/math/revolution.h>

#include <hwy/foreach_target.h>

#include <beeline/inverse/numerical/gauss_newton-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

using namespace internal;
using namespace gauss_newton;

// The tolerances are equal to the tolerances in levenberg_marquardt_lanes.cpp. The damping is
// smaller: a start near the pose needs it at singularities only.
constexpr double damping_factor = 0.01;     // damping over squared error
constexpr double acceleration_from = 1e-6;  // squared error; a plain step suffices below
constexpr double largest_step = 1;          // radians, or units of length

/// Computes half the second derivative of the tool's motion along `near.move`,
///   1/2 sum_jk d2f / (dq_j dq_k) move_j move_k:
/// A joint rotates its own column and the columns of all joints after it.
HWY_INLINE void half_second_derivative(const GaussNewtonState& near, double (&half)[6]) {
  double rotation[3] = {0, 0, 0}, linear[3] = {0, 0, 0}, angular[3] = {0, 0, 0};
  for (size_t k = 0; k < near.move.size(); ++k) {
    const double *v = near.column[k].lane, *w = v + 3, move = near.move[k];
    const double own[3] = {move * w[0], move * w[1], move * w[2]};
    const double t[3] = {rotation[0] + own[0] / 2, rotation[1] + own[1] / 2,
                         rotation[2] + own[2] / 2};
    linear[0] += move * (t[1] * v[2] - t[2] * v[1]);
    linear[1] += move * (t[2] * v[0] - t[0] * v[2]);
    linear[2] += move * (t[0] * v[1] - t[1] * v[0]);
    angular[0] += rotation[1] * own[2] - rotation[2] * own[1];
    angular[1] += rotation[2] * own[0] - rotation[0] * own[2];
    angular[2] += rotation[0] * own[1] - rotation[1] * own[0];
    for (int r = 0; r < 3; ++r) rotation[r] += own[r];
  }
  for (int r = 0; r < 3; ++r) {
    half[r] = linear[r];
    half[3 + r] = angular[r] / 2;
  }
}

/// Takes the step given by the factors in `near.normal`. Returns its largest component. A joint
/// that reaches its bound stays there.
HWY_INLINE double step(const NumericalProblem& problem, bool accelerated, bool wraps,
                       GaussNewtonState& near) {
  double dual[6];
  for (int r = 0; r < 6; ++r) dual[r] = near.error[r];
  solve(near.normal, dual);
  double longest = 0;
  for (size_t k = 0; k < near.q.size(); ++k) {
    near.move[k] = along(near.column[k].lane, dual);
    longest = std::max(longest, std::abs(near.move[k]));
  }
  if (accelerated) {  // geodesic acceleration gives cubic convergence
    half_second_derivative(near, dual);
    solve(near.normal, dual);
    for (size_t k = 0; k < near.q.size(); ++k) near.move[k] -= along(near.column[k].lane, dual);
  }
  for (size_t k = 0; k < near.q.size(); ++k) {
    const auto& coordinate = problem.coordinates[k];
    double q = near.q[k] + near.move[k];
    if (wraps && coordinate.wraps) {
      if (q > coordinate.upper) q -= revolution;
      if (q < coordinate.lower) q += revolution;
    }
    near.before[k] = near.q[k];
    near.q[k] = std::min(std::max(q, coordinate.lower), coordinate.upper);
    near.free[k] &= near.q[k] == q;
  }
  return longest;
}

bool iterate(const NumericalProblem& problem, const double* goal, const LaneOptions& options,
             GaussNewtonState& near) {
  const double tolerance = options.tolerance / problem.length;
  const bool in_order = problem.links.size() == problem.coordinates.size();
  const double enough = options.polish ? polished : tolerance * tolerance;
  double before = HUGE_VAL, longest = HUGE_VAL, error_before[6];
  bool within = false;
  for (near.iterations = 0;; ++near.iterations) {
    double tool_position[3];
    for (int r = 0; r < 6; ++r) error_before[r] = near.error[r];
    if (!evaluate(problem, goal, near, tool_position)) return false;
    const double* e = near.error;
    const double position = e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
    const double orientation = e[3] * e[3] + e[4] * e[4] + e[5] * e[5];
    const double cost = position + orientation;
    if (!(cost < before / 2)) {
      if (!within || before > fine) return false;
      if (!(cost < before)) {  // at the level of rounding, the previous step was as good
        near.q.swap(near.before);
        for (int r = 0; r < 6; ++r) near.error[r] = error_before[r];
      }
      return true;
    }
    within =
        position <= tolerance * tolerance && orientation <= options.tolerance * options.tolerance;
    if (within && (!options.polish || cost <= polished)) return true;
    if (near.iterations >= options.max_iterations) return within && cost <= fine;
    before = cost;
    // The last Jacobian differs from the present one by about the last step. If that error leaves
    // the next step accurate enough, its factors are used again.
    const bool again = cost * longest * longest < enough / 4;
    if (!again) {
      linearise(problem, tool_position, near);
      factorise(damping_factor * cost + min_damping, near.normal);
    }
    const bool accelerated = !again && in_order && cost > acceleration_from;
    longest = step(problem, accelerated, options.wraps, near);
    if (!(longest <= largest_step)) return false;
  }
}

}  // namespace
}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace beeline {

HWY_EXPORT(iterate);

namespace internal {

bool gauss_newton(const NumericalProblem& problem, const Pose& world_T_tool, const double* start,
                  const LaneOptions& options, GaussNewtonState& near) {
  for (const bool row : problem.task.rows) {
    if (!row) return false;
  }
  const std::size_t dof = problem.coordinates.size(), links = problem.links.size();
  if (near.q.size() != dof || near.axes.size() != 8 * links) {
    near.q.resize(dof);
    near.before.resize(dof);
    near.free.resize(dof);
    near.move.resize(dof);
    near.tangent.resize(dof);
    near.start.resize(dof);
    near.weight.resize(dof);
    near.column.assign(dof, {});
    near.axes.resize(8 * links);
    near.angle.assign((links + 7) / 8, {});
    near.sine.assign((links + 7) / 8, {});
    near.cosine.assign((links + 7) / 8, {});
  }
  for (std::size_t k = 0; k < dof; ++k) {
    const NumericalProblem::Coordinate& coordinate = problem.coordinates[k];
    near.free[k] = true;
    near.q[k] = std::clamp(start[k] / coordinate.unit, coordinate.lower, coordinate.upper);
  }
  const Pose goal = last_link_goal(problem, world_T_tool);
  return HWY_DYNAMIC_DISPATCH(iterate)(problem, goal.data(), options, near);
}

}  // namespace internal
}  // namespace beeline

#endif
