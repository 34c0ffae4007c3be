#include <algorithm>
#include <cmath>

#include <beeline/error.h>
#include <beeline/inverse/numerical/levenberg_marquardt_lanes.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "beeline/inverse/numerical/levenberg_marquardt_lanes.cpp"
#include <beeline/math/revolution.h>

#include <hwy/foreach_target.h>

#include <beeline/kinematics/task-inl.h>
#include <beeline/math/symmetric6_lanes-inl.h>

HWY_BEFORE_NAMESPACE();
namespace beeline::HWY_NAMESPACE {
namespace {

using namespace internal;

// The factors and the patience were chosen by trial over random poses of the built-in arms, for the
// shortest time to the first solution; the optimum is flat. levenberg_marquardt() has more damping
// and patience, because it has one start and the lanes have restarts.
constexpr double first_factor = 0.05;  // damping over squared error
constexpr double min_factor = 1e-3;    // the same, after steps that were all accepted
constexpr double min_damping = 1e-13;  // keeps J J^T regular at singularities
constexpr double largest_step = 1;     // radians, or units of length; range of the linear model
constexpr int patience = 5;            // max steps in which the squared error must halve
constexpr double polished = 1e-26;     // squared error at the level of rounding
constexpr double fine = 1e-21;  // squared error that suffices once a step reduces it by less than 4
constexpr double near_goal = 0.1;  // squared error above which joints at bounds are not solved
                                   // again: the step is inaccurate there in any case

HWY_INLINE Lanes load(const EightNumbers& numbers) { return Lanes::load(numbers.lane); }
HWY_INLINE void store(Lanes lanes, EightNumbers& numbers) { lanes.store(numbers.lane); }

/// The task at the trial configurations.
struct Evaluation {
  Vector tool;   ///< its position
  Motion error;  ///< goal minus tool, in the task's axes
  PartialTask part;
};

HWY_INLINE bool whole(const Task& task) {
  for (const bool row : task.rows) {
    if (!row) return false;
  }
  return true;
}

/// `goal`: four columns of four, the tool's position and the last link's orientation.
HWY_INLINE void evaluate(const NumericalProblem& problem, const double* goal,
                         LevenbergMarquardtLanes& lanes, Evaluation& at) {
  const LanePose frame = last_frame(problem.chain, lanes.trial[0].lane, lanes.axes[0].lane);
  const double* tool = problem.chain.tool.data();
  at.tool = frame.origin + from_axes(frame, {tool[12], tool[13], tool[14]});
  at.error.linear = Vector{goal[12], goal[13], goal[14]} - at.tool;
  // goal * frame^T, row by row
  const Vector x{goal[0], goal[1], goal[2]}, y{goal[4], goal[5], goal[6]},
      z{goal[8], goal[9], goal[10]};
  const Vector row0 = from_axes(frame, {x.x, y.x, z.x});
  const Vector row1 = from_axes(frame, {x.y, y.y, z.y});
  const Vector row2 = from_axes(frame, {x.z, y.z, z.z});
  at.error.angular = rotation_log(row0, row1, row2, lanes.active);
  if (whole(problem.task)) return;
  const LanePose world_T_tool{from_axes(frame, {tool[0], tool[1], tool[2]}),
                              from_axes(frame, {tool[4], tool[5], tool[6]}),
                              from_axes(frame, {tool[8], tool[9], tool[10]}), at.tool};
  at.part = partial_task(problem.task, world_T_tool, at.error);
  at.error = weighted(at.part.weight, at.part.error);
}

/// Accepts the trial's error in the lanes where it is smaller, adapts the damping, ends lanes that
/// have converged, stagnated or used up their iterations, and returns where the trial is accepted.
HWY_INLINE LaneMask accept_error(const NumericalProblem& problem, const Evaluation& at,
                                 const LaneOptions& options, LevenbergMarquardtLanes& lanes) {
  const LaneMask active = mask_of(lanes.active);
  const Vector &linear = at.error.linear, &angular = at.error.angular;
  const Lanes position = dot(linear, linear), orientation = dot(angular, angular);
  const Lanes cost = position + orientation, before = load(lanes.cost);
  const LaneMask better = (cost < before) & active;
  const Lanes error[6] = {linear.x, linear.y, linear.z, angular.x, angular.y, angular.z};
  for (int r = 0; r < 6; ++r) {
    store(choose(better, error[r], load(lanes.error[r])), lanes.error[r]);
  }
  const Lanes now = choose(better, cost, before);
  const Lanes factor = load(lanes.factor);
  const Lanes next = choose(better, max(factor * Lanes(0.5), Lanes(min_factor)), factor * Lanes(4));
  store(now, lanes.cost);
  store(choose(before == Lanes(HUGE_VAL), Lanes(first_factor), next), lanes.factor);

  const double tolerance = options.tolerance / problem.length;
  const LaneMask close = better & (position <= Lanes(tolerance * tolerance)) &
                         (orientation <= Lanes(options.tolerance * options.tolerance));
  const LaneMask was_within = mask_of(lanes.within), within = close | (was_within & !better);
  const LaneMask slow = was_within & (now <= Lanes(fine)) & !(now < before * Lanes(0.25));
  const Lanes iterations = load(lanes.iterations) + Lanes(1), due = load(lanes.due);
  const Lanes milestone = load(lanes.milestone);
  const LaneMask spent = iterations >= Lanes(options.max_iterations);
  const LaneMask judged = iterations >= due;
  const LaneMask stuck = judged & !(now < milestone * Lanes(0.5));
  const LaneMask finished = (now <= Lanes(polished)) | slow;
  const LaneMask converged = options.polish ? within & finished : within;
  const LaneMask ended = converged | stuck | spent;
  store(choose(active, iterations, load(lanes.iterations)), lanes.iterations);
  store(choose(judged, now, milestone), lanes.milestone);
  store(choose(judged, due + Lanes(patience), due), lanes.due);
  lanes.within = (bits(within) & lanes.active) | (lanes.within & ~lanes.active);
  lanes.converged |= bits(within & ended) & lanes.active;
  lanes.coarse |= bits(within & ended & !converged) & lanes.active;
  lanes.active &= ~bits(ended);
  return better;
}

HWY_INLINE void accept_configuration(LaneMask better, LevenbergMarquardtLanes& lanes) {
  for (size_t k = 0; k < lanes.q.size(); ++k) {
    store(choose(better, load(lanes.trial[k]), load(lanes.q[k])), lanes.q[k]);
  }
}

HWY_INLINE Lanes dot6(const Lanes (&column)[6], const Lanes (&y)[6]) {
  return fma(column[0], y[0], fma(column[1], y[1], column[2] * y[2])) +
         fma(column[3], y[3], fma(column[4], y[4], column[5] * y[5]));
}

HWY_INLINE void load_column(const LevenbergMarquardtLanes& lanes, size_t k, Lanes (&column)[6]) {
#pragma GCC unroll 6
  for (size_t r = 0; r < 6; ++r) column[r] = load(lanes.column[6 * k + r]);
}

/// Accepts the trial's Jacobian where `better`, fixes joints that are at a bound and whose gradient
/// points out of it, and adds J J^T of the others to `normal`.
HWY_INLINE void linearise(const NumericalProblem& problem, const Evaluation& at, LaneMask better,
                          const Lanes (&error)[6], LevenbergMarquardtLanes& lanes,
                          Symmetric6& normal) {
  const bool partial = !whole(problem.task);
  const bool all_better = (lanes.active & ~bits(better)) == 0;
  const int* links = problem.links.data();
  for (size_t k = 0; k < problem.coordinates.size(); ++k) {
    const auto& coordinate = problem.coordinates[k];
    Motion motion{{0, 0, 0}, {0, 0, 0}};
    for (int i = coordinate.first_link; i < coordinate.end_link; ++i) {
      const auto link = static_cast<size_t>(links[i]);
      const Motion one = link_motion(problem.chain.links[link], lanes.axes[6 * link].lane, at.tool);
      motion = {motion.linear + one.linear, motion.angular + one.angular};
    }
    if (partial) motion = in_task(at.part, motion);
    const Vector &v = motion.linear, &w = motion.angular;
    Lanes column[6] = {v.x, v.y, v.z, w.x, w.y, w.z};
#pragma GCC unroll 6
    for (size_t r = 0; r < 6; ++r) {
      if (!all_better) column[r] = choose(better, column[r], load(lanes.column[6 * k + r]));
      store(column[r], lanes.column[6 * k + r]);
    }
    const Lanes q = load(lanes.q[k]), pull = dot6(column, error);
    const LaneMask held = ((q >= Lanes(coordinate.highest)) & (pull > Lanes(0))) |
                          ((q <= Lanes(coordinate.lowest)) & (pull < Lanes(0)));
    const Lanes free = choose(held, Lanes(0), Lanes(1));
    store(free, lanes.free[k]);
    for (Lanes& c : column) c *= free;
    add_square(normal, column);
  }
}

HWY_INLINE void normal_equations(const LevenbergMarquardtLanes& lanes, Symmetric6& normal) {
  for (Lanes& entry : normal.entry) entry = Lanes(0);
  for (size_t k = 0; k < lanes.q.size(); ++k) {
    const Lanes free = load(lanes.free[k]);
    Lanes column[6];
    load_column(lanes, k, column);
    for (Lanes& c : column) c *= free;
    add_square(normal, column);
  }
}

/// Computes the damped step of the free joints for the error `left`. Joints that would pass a bound
/// stop there. Near the goal these are then fixed, and their contribution is subtracted from
/// `left`; returns the lanes in which this happens.
HWY_INLINE unsigned damped_step(const NumericalProblem& problem, Symmetric6& normal,
                                Lanes (&left)[6], bool again, LevenbergMarquardtLanes& lanes) {
  const Lanes damping = fma(load(lanes.factor), load(lanes.cost), Lanes(min_damping));
  const LaneMask near = load(lanes.cost) < Lanes(near_goal);
  Lanes dual[6];
  for (int r = 0; r < 6; ++r) dual[r] = left[r];
  solve_damped(normal, damping, dual);
  unsigned stopped = 0;
  for (size_t k = 0; k < problem.coordinates.size(); ++k) {
    const auto& coordinate = problem.coordinates[k];
    Lanes column[6];
    load_column(lanes, k, column);
    const Lanes q = load(lanes.q[k]), free = load(lanes.free[k]), wanted = dot6(column, dual);
    const Lanes possible =
        min(max(wanted, Lanes(coordinate.lowest) - q), Lanes(coordinate.highest) - q);
    const LaneMask moves = free > Lanes(0), stops = near & moves & !(possible == wanted);
    store(choose(moves, possible, again ? load(lanes.step[k]) : Lanes(0)), lanes.step[k]);
    const unsigned which = bits(stops) & lanes.active;
    if (which == 0) continue;
    stopped |= which;
    store(choose(stops, Lanes(0), free), lanes.free[k]);
    const Lanes used = choose(stops, possible, Lanes(0));
    for (int r = 0; r < 6; ++r) left[r] = fnma(column[r], used, left[r]);
  }
  return stopped;
}

HWY_INLINE void set_trial(const NumericalProblem& problem, LevenbergMarquardtLanes& lanes) {
  Lanes longest(largest_step);
  for (const EightNumbers& one : lanes.step) longest = max(longest, abs(load(one)));
  const Lanes scale = Lanes(largest_step) / longest;
  for (size_t k = 0; k < problem.coordinates.size(); ++k) {
    const auto& coordinate = problem.coordinates[k];
    const Lanes lower(coordinate.lower), upper(coordinate.upper), period(revolution);
    Lanes q = fma(load(lanes.step[k]), scale, load(lanes.q[k]));
    if (coordinate.wraps) {
      q = choose(q > upper, q - period, choose(q < lower, q + period, q));
    }
    store(min(max(q, lower), upper), lanes.trial[k]);
  }
}

void run(const NumericalProblem& problem, const double* goal, const LaneOptions& options,
         int max_steps, LevenbergMarquardtLanes& lanes) {
  const unsigned started = lanes.active;
  Evaluation at{};
  for (int steps = 0; steps < max_steps && lanes.active == started; ++steps) {
    evaluate(problem, goal, lanes, at);
    const LaneMask better = accept_error(problem, at, options, lanes);
    accept_configuration(better, lanes);
    if (lanes.active == 0 || (options.first_is_enough && (lanes.converged & ~lanes.coarse) != 0))
      return;
    Lanes left[6];
    for (int r = 0; r < 6; ++r) left[r] = load(lanes.error[r]);
    Symmetric6 normal;
    for (Lanes& entry : normal.entry) entry = Lanes(0);
    linearise(problem, at, better, left, lanes, normal);
    if (damped_step(problem, normal, left, false, lanes) != 0) {
      normal_equations(lanes, normal);
      damped_step(problem, normal, left, true, lanes);
    }
    set_trial(problem, lanes);
  }
}

}  // namespace
}  // namespace beeline::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace beeline {

HWY_EXPORT(run);

namespace internal {

void run_lanes(const NumericalProblem& problem, const Pose& world_T_tool,
               const LaneOptions& options, int max_steps, LevenbergMarquardtLanes& lanes) {
  const Pose goal = last_link_goal(problem, world_T_tool);
  HWY_DYNAMIC_DISPATCH(run)(problem, goal.data(), options, max_steps, lanes);
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
  lanes.converged &= ~bit;
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
  if (!(options.tolerance > 0) || !std::isfinite(options.tolerance) || options.max_iterations < 0) {
    throw Error("tolerance must be above zero, and max_iterations zero or more; not " +
                number(options.tolerance) + " and " + std::to_string(options.max_iterations));
  }
}

void levenberg_marquardt_lanes(const NumericalProblem& problem, const Pose& world_T_tool,
                               const Eigen::Ref<const Eigen::MatrixXd>& starts,
                               const LaneOptions& options, LevenbergMarquardtLanes& lanes) {
  check_lane_options(world_T_tool, options);
  const auto dof = static_cast<Eigen::Index>(problem.coordinates.size());
  if (starts.rows() != dof || starts.cols() > solver_lane_count) {
    throw Error("starts need " + std::to_string(dof) + " rows and at most " +
                std::to_string(solver_lane_count) + " columns");
  }
  if (!starts.allFinite()) throw Error("a start has a number that is not finite");
  lanes.active = lanes.converged = lanes.coarse = 0;
  for (int i = 0; i < starts.cols(); ++i) start_lane(problem, starts.col(i).data(), i, lanes);
  while (lanes.active != 0 &&
         !(options.first_is_enough && (lanes.converged & ~lanes.coarse) != 0)) {
    run_lanes(problem, world_T_tool, options, options.max_iterations + 1, lanes);
  }
}

}  // namespace internal
}  // namespace beeline

#endif
