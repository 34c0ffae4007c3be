#pragma once

#include <beeline/inverse/numerical/levenberg_marquardt_lanes.h>

namespace beeline::internal {

/// The state of one run of gauss_newton(). Each thread needs its own; the first call sizes it.
struct GaussNewtonState {
  std::vector<double> q;  ///< in the coordinates' units, within the bounds
  double error[6] = {};   ///< error of the task at q; lengths in units
  int iterations = 0;
  std::vector<double> before;         ///< q before the last step
  std::vector<double> move;           ///< the last step
  std::vector<double> tangent;        ///< of the last step along the self-motion
  std::vector<double> start, weight;  ///< of the distance that is minimised, in units
  std::vector<char> free;             ///< whether a coordinate has not reached a bound
  std::vector<double> axes;           ///< eight numbers for each link: direction and origin
  std::vector<EightNumbers> angle, sine, cosine;  ///< angles of the links, eight at a time
  double normal[6 * solver_lane_count] = {};      ///< the factors of J J^T, rows of eight
  std::vector<EightNumbers> column;  ///< for each coordinate, the six numbers of its column
};

/// Solves a task with all six rows by Gauss-Newton with geodesic acceleration (Transtrum & Sethna
/// 2012) from `start`, clamped to the bounds: two or three steps from a tenth of a radian away, as
/// when a path is tracked. One configuration is then faster than eight lanes. Returns whether it
/// converges; it gives up when |e|^2 does not halve in a step or the orientation error is 90
/// degrees or more, where run_lanes() may still converge. A joint that reaches a bound stays there.
/// Requires a finite pose and a start that fits the arm.
bool gauss_newton(const NumericalProblem& problem, const Pose& world_T_tool, const double* start,
                  const LaneOptions& options, GaussNewtonState& near);

}  // namespace beeline::internal
