// Compiled once for each instruction set (Highway's foreach_target.h), so there is no #pragma once.
#if defined(BEELINE_INVERSE_GAUSS_NEWTON_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef BEELINE_INVERSE_GAUSS_NEWTON_INL_H
#undef BEELINE_INVERSE_GAUSS_NEWTON_INL_H
#else
#define BEELINE_INVERSE_GAUSS_NEWTON_INL_H
#endif

#include <algorithm>
#include <cmath>

#include <beeline/inverse/numerical/gauss_newton.h>

#include <beeline/kinematics/chain_one-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace gauss_newton {

using namespace internal;

constexpr double min_damping = 1e-13;  // keeps J J^T regular at singularities
constexpr double polished = 1e-26;     // squared error at the level of rounding
constexpr double fine = 1e-21;         // squared error that suffices once it stops decreasing

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

}  // namespace gauss_newton
}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
