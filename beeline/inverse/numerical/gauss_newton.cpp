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

#include <beeline/kinematics/chain_one-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

using namespace internal;

// The tolerances are equal to the tolerances in levenberg_marquardt_lanes.cpp. The damping is
// smaller: a start near the pose needs it at singularities only.
constexpr double min_damping = 1e-13;       // keeps J J^T regular at singularities
constexpr double damping_factor = 0.01;     // damping over squared error
constexpr double acceleration_from = 1e-6;  // squared error; a plain step suffices below
constexpr double largest_step = 1;          // radians, or units of length
constexpr double polished = 1e-26;          // squared error at the level of rounding
constexpr double fine = 1e-21;              // squared error that suffices once it stops decreasing

/// Computes the error to the goal (four columns of four) and the tool's position. Returns false if
/// the orientation error is 90 degrees or more.
HWY_INLINE bool evaluate(const NumericalProblem& problem, const double* goal,
                         GaussNewtonState& near, double* tool_position) {
  double frame[16], relative[3][3];
  last_frame_of_one(problem.chain, near.q.data(), near.angle[0].lane, near.sine[0].lane,
                    near.cosine[0].lane, near.axes.data(), frame);
  const double* tool = problem.chain.tool.data() + 12;
  for (int r = 0; r < 3; ++r) {
    tool_position[r] =
        frame[12 + r] + frame[r] * tool[0] + frame[4 + r] * tool[1] + frame[8 + r] * tool[2];
    near.error[r] = goal[12 + r] - tool_position[r];
    for (int c = 0; c < 3; ++c) {
      relative[r][c] = goal[r] * frame[c] + goal[4 + r] * frame[4 + c] + goal[8 + r] * frame[8 + c];
    }
  }
  // The rotation axis times sin(angle).
  const double v[3] = {(relative[2][1] - relative[1][2]) / 2, (relative[0][2] - relative[2][0]) / 2,
                       (relative[1][0] - relative[0][1]) / 2};
  const double u = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  const double twice_cosine = relative[0][0] + relative[1][1] + relative[2][2] - 1;
  if (!(twice_cosine > 0)) return false;
  double scale = 1;
  if (u < 0.01) {  // asin(s) / s in powers of s^2
    scale += u * (1.0 / 6 +
                  u * (3.0 / 40 +
                       u * (5.0 / 112 +
                            u * (35.0 / 1152 +
                                 u * (63.0 / 2816 + u * (231.0 / 13312 + u * (143.0 / 10240)))))));
  } else {
    const double s = std::sqrt(u);
    scale = std::atan2(s, twice_cosine / 2) / s;
  }
  for (int r = 0; r < 3; ++r) near.error[3 + r] = v[r] * scale;
  return true;
}

/// The Jacobian's columns, and J J^T row by row (rows of eight, six of them used).
HWY_INLINE void linearise(const NumericalProblem& problem, const double* tool_position,
                          GaussNewtonState& near) {
  Lanes sum[6];
  for (Lanes& row : sum) row = Lanes(0);
  const int* links = problem.links.data();
  for (size_t k = 0; k < problem.coordinates.size(); ++k) {
    double* column = near.column[k].lane;
    for (int r = 0; r < 6; ++r) column[r] = 0;
    if (!near.free[k]) continue;
    for (int i = problem.coordinates[k].first_link; i < problem.coordinates[k].end_link; ++i) {
      const auto at = static_cast<size_t>(links[i]);
      const internal::Chain::Link& link = problem.chain.links[at];
      const double *z = &near.axes[8 * at], *p = z + 4;
      const double arm[3] = {tool_position[0] - p[0], tool_position[1] - p[1],
                             tool_position[2] - p[2]};
      column[0] += link.theta_per_q * (z[1] * arm[2] - z[2] * arm[1]) + link.d_per_q * z[0];
      column[1] += link.theta_per_q * (z[2] * arm[0] - z[0] * arm[2]) + link.d_per_q * z[1];
      column[2] += link.theta_per_q * (z[0] * arm[1] - z[1] * arm[0]) + link.d_per_q * z[2];
      for (int r = 0; r < 3; ++r) column[3 + r] += link.theta_per_q * z[r];
    }
  }
  for (size_t k = 0; k < problem.coordinates.size(); ++k) {
    const double* column = near.column[k].lane;
    const Lanes all = Lanes::load(column);
#pragma GCC unroll 6
    for (int r = 0; r < 6; ++r) sum[r] = fma(all, Lanes(column[r]), sum[r]);
  }
  for (int r = 0; r < 6; ++r) sum[r].store(near.normal + r * lane_count);
}

/// Factorises a + damping I = L D L^T in place: L^T above the diagonal, 1 / D on it. This is the
/// elimination of solve_damped() (symmetric6_lanes-inl.h) for one matrix, in rows of eight numbers
/// as linearise() sums them. It is separate from the solution because its factors are used up to
/// three times.
HWY_INLINE void factorise(double damping, double (&a)[6 * lane_count]) {
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) a[j * lane_count + j] += damping;
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) {
    double* row = a + j * lane_count;
    const double pivot = 1 / std::max(row[j], damping);
    row[j] = pivot;
    double scaled[6];
#pragma GCC unroll 6
    for (int i = j + 1; i < 6; ++i) {
      scaled[i] = row[i] * pivot;
#pragma GCC unroll 6
      for (int k = i; k < 6; ++k) a[i * lane_count + k] -= scaled[i] * row[k];
    }
#pragma GCC unroll 6
    for (int i = j + 1; i < 6; ++i) row[i] = scaled[i];
  }
}

HWY_INLINE void solve(const double (&a)[6 * lane_count], double (&y)[6]) {
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) {
#pragma GCC unroll 6
    for (int i = j + 1; i < 6; ++i) y[i] -= a[j * lane_count + i] * y[j];
  }
#pragma GCC unroll 6
  for (int j = 0; j < 6; ++j) y[j] *= a[j * lane_count + j];
#pragma GCC unroll 6
  for (int i = 5; i >= 0; --i) {  // by columns, so that each step depends on one product only
#pragma GCC unroll 6
    for (int j = i - 1; j >= 0; --j) y[j] -= a[j * lane_count + i] * y[i];
  }
}

HWY_INLINE double along(const double* c, const double (&y)[6]) {
  return (c[0] * y[0] + c[1] * y[1] + c[2] * y[2]) + (c[3] * y[3] + c[4] * y[4] + c[5] * y[5]);
}

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
HWY_INLINE double step(const NumericalProblem& problem, bool accelerated, GaussNewtonState& near) {
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
    if (coordinate.wraps) {
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
    longest = step(problem, !again && in_order && cost > acceleration_from, near);
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
  Pose goal = world_T_tool;
  goal.linear() = world_T_tool.linear() * problem.chain.tool.linear().transpose();
  goal.translation() /= problem.length;
  return HWY_DYNAMIC_DISPATCH(iterate)(problem, goal.data(), options, near);
}

}  // namespace internal
}  // namespace beeline

#endif
