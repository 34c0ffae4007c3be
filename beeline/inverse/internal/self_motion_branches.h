#pragma once

#include <functional>
#include <vector>

#include <beeline/inverse/internal/request.h>

namespace beeline::internal {

/// One solution of a closed form at given values of the free coordinates.
struct FreeSolution {
  double miss = 0;    ///< 0 within limits; else the excess over the limits or, without a solution,
                      ///< no_solution plus the residual
  Configuration q{};  ///< the representative within limits, if `miss` is 0
};
inline constexpr double no_solution = 1e6;

/// Whether a local minimum of `miss` may reach zero between its neighbours: it is below twice the
/// step to a neighbour of the same kind, within no_solution or beyond.
bool may_reach_zero(double here, double before, double after);

/// A function that evaluates a closed form at given values of its free coordinates. It writes the
/// solution for each combination of the signs of the roots, always the same number of them in the
/// same order.
using SolutionsAt =
    std::function<void(const std::vector<double>& values, std::vector<FreeSolution>& solutions)>;

/// At a singular pose an arm can move with the tool at rest, and coordinates of the closed form are
/// free. Returns one solution of every branch: a branch is a connected set of solutions within
/// limits with the same signs of the roots. Evaluates the closed form on a grid over the free
/// coordinates, one revolution from `seed_values` each; neighbours on the grid between which the
/// joints move continuously belong to one branch. Its solution is the nearest to the seed: with one
/// free coordinate by golden-section search, else on the grid. With one free coordinate, a branch
/// that lies between two points of the grid is found where `miss` has a local minimum of zero.
/// Returns nothing if the budget ends it.
std::vector<Configuration> self_motion_branches(const Request& request,
                                                const std::vector<double>& seed_values,
                                                const SolutionsAt& solutions_at);

}  // namespace beeline::internal
