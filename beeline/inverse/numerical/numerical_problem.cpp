#include <algorithm>
#include <cmath>

#include <beeline/inverse/numerical/numerical_problem.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/math/revolution.h>
#include <beeline/model/internal/chain.h>

namespace beeline::internal {
namespace {

/// Expresses the chain's lengths and its prismatic coordinates in units of `length`.
Chain in_units(Chain chain, double length, const std::vector<NumericalProblem::Coordinate>& units) {
  chain.base.translation() /= length;
  chain.tool.translation() /= length;
  for (Chain::Link& link : chain.links) {
    const double unit = units[link.coordinate].unit;
    link.translation /= length;
    link.theta_per_q *= unit;
    link.d_per_q *= unit / length;
  }
  return chain;
}

}  // namespace

NumericalProblem numerical_problem(const Arm& arm, const Task& task, const Bounds& bounds) {
  check_task(arm, task, bounds);
  NumericalProblem problem{task, bounds, 1, {}, {}, {}};
  problem.length = std::exp2(std::round(std::log2(unit_of_length(arm))));
  const Chain& chain = chain_of(arm);
  for (int k = 0; k < arm.dof(); ++k) {
    NumericalProblem::Coordinate coordinate;
    coordinate.slides = kind(arm.joint_of(k)) == JointKind::prismatic;
    if (coordinate.slides) coordinate.unit = problem.length;
    coordinate.lower = coordinate.lowest = bounds.lower[k] / coordinate.unit;
    coordinate.upper = coordinate.highest = bounds.upper[k] / coordinate.unit;
    coordinate.periodic = arm.periodic(k);
    if (coordinate.periodic && coordinate.upper - coordinate.lower >= revolution) {
      coordinate.wraps = std::isfinite(coordinate.lower) || std::isfinite(coordinate.upper);
      coordinate.lowest = -HUGE_VAL;
      coordinate.highest = HUGE_VAL;
    }
    coordinate.first_link = static_cast<int>(problem.links.size());
    for (std::size_t i = 0; i < chain.links.size(); ++i) {
      if (chain.links[i].coordinate == k) problem.links.push_back(static_cast<int>(i));
    }
    coordinate.end_link = static_cast<int>(problem.links.size());
    problem.coordinates.push_back(coordinate);
  }
  problem.chain = in_units(chain, problem.length, problem.coordinates);
  return problem;
}

NumericalProblem NumericalProblem::make(const Arm& arm, const Key& key) {
  return numerical_problem(arm, key.task, key.ignore_limits ? no_bounds(arm) : bounds_of(arm));
}

std::size_t NumericalProblem::heap_bytes() const {
  return internal::heap_bytes(chain.links) + internal::heap_bytes(coordinates) +
         internal::heap_bytes(links) + 2 * sizeof(double) * coordinates.size();
}

Pose last_link_goal(const NumericalProblem& problem, const Pose& world_T_tool) {
  Pose goal = world_T_tool;
  goal.linear() = world_T_tool.linear() * problem.chain.tool.linear().transpose();
  goal.translation() /= problem.length;
  return goal;
}

}  // namespace beeline::internal
