#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/error.h>
#include <beeline/inverse/numerical/levenberg_marquardt_lanes.h>
#include <beeline/inverse/numerical/representative.h>

namespace beeline::internal {
namespace {

/// The chain with lengths, and the coordinates that slide, in units of `length`.
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
  NumericalProblem problem{arm, task, bounds, 1, {}, {}, {}};
  problem.length = std::exp2(std::round(std::log2(unit_of_length(arm))));
  const Chain& chain = arm.chain();
  for (int k = 0; k < arm.dof(); ++k) {
    NumericalProblem::Coordinate coordinate;
    coordinate.slides = kind(arm.joint_of(k)) == JointKind::prismatic;
    if (coordinate.slides) coordinate.unit = problem.length;
    coordinate.lower = coordinate.lowest = bounds.lower[k] / coordinate.unit;
    coordinate.upper = coordinate.highest = bounds.upper[k] / coordinate.unit;
    coordinate.turns_around = turns_around(arm, k);
    if (coordinate.turns_around && coordinate.upper - coordinate.lower >= 2 * std::numbers::pi) {
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

void start_lane(const NumericalProblem& problem, const double* q, int lane,
                LevenbergMarquardtLanes& lanes) {
  const std::size_t dof = problem.coordinates.size(), links = problem.links.size();
  if (lanes.q.size() != dof || lanes.axes.size() != 6 * links) {
    lanes = {};
    lanes.q.resize(dof);
    lanes.trial.resize(dof);
    lanes.step.resize(dof);
    lanes.free.resize(dof);
    lanes.column.resize(6 * dof);
    lanes.axes.resize(6 * links);
  }
  for (std::size_t k = 0; k < dof; ++k) {
    const NumericalProblem::Coordinate& coordinate = problem.coordinates[k];
    const double within = std::clamp(q[k] / coordinate.unit, coordinate.lower, coordinate.upper);
    lanes.q[k].lane[lane] = lanes.trial[k].lane[lane] = within;
  }
  lanes.cost.lane[lane] = lanes.milestone.lane[lane] = HUGE_VAL;
  lanes.iterations.lane[lane] = -1;
  lanes.due.lane[lane] = 0;
  const unsigned bit = 1u << lane;
  lanes.active |= bit;
  lanes.arrived &= ~bit;
  lanes.coarse &= ~bit;
  lanes.within &= ~bit;
}

void lane_configuration(const NumericalProblem& problem, const LevenbergMarquardtLanes& lanes,
                        int lane, double* q) {
  for (std::size_t k = 0; k < problem.coordinates.size(); ++k) {
    q[k] = lanes.q[k].lane[lane] * problem.coordinates[k].unit;
  }
}

Deviation lane_deviation(const NumericalProblem& problem, const LevenbergMarquardtLanes& lanes,
                         int lane) {
  const auto length = [&](int first) {
    return std::hypot(lanes.error[first].lane[lane], lanes.error[first + 1].lane[lane],
                      lanes.error[first + 2].lane[lane]);
  };
  return {length(0) * problem.length, length(3)};
}

void check_lane_options(const Pose& world_T_tool, const LaneOptions& options) {
  if (!world_T_tool.matrix().allFinite()) throw Error("the pose has a number that is not finite");
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance) || options.iterations < 0) {
    throw Error("tolerance must be above zero, and iterations zero or more; not " +
                number(options.tolerance) + " and " + std::to_string(options.iterations));
  }
}

void levenberg_marquardt_lanes(const NumericalProblem& problem, const Pose& world_T_tool,
                               const Eigen::Ref<const Eigen::MatrixXd>& starts,
                               const LaneOptions& options, LevenbergMarquardtLanes& lanes) {
  check_lane_options(world_T_tool, options);
  if (starts.rows() != problem.arm.dof() || starts.cols() > solver_lane_count) {
    throw Error("starts for arm " + problem.arm.name() + " need " +
                std::to_string(problem.arm.dof()) + " rows and at most " +
                std::to_string(solver_lane_count) + " columns");
  }
  if (!starts.allFinite()) throw Error("a start has a number that is not finite");
  lanes.active = lanes.arrived = lanes.coarse = 0;
  for (int i = 0; i < starts.cols(); ++i) start_lane(problem, starts.col(i).data(), i, lanes);
  while (lanes.active != 0 && !(options.first_is_enough && (lanes.arrived & ~lanes.coarse) != 0)) {
    run_lanes(problem, world_T_tool, options, options.iterations + 1, lanes);
  }
}

}  // namespace beeline::internal
