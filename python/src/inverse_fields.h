#pragma once

#include <beeline/batch/batch.h>
#include <beeline/inverse/inverse_kinematics.h>

#include "kept_array.h"
#include "kinematics_fields.h"

namespace beeline::python {

template <>
inline std::vector<InverseMethod> choices() {
  return {InverseMethod::automatic, InverseMethod::closed_form, InverseMethod::numerical};
}

template <>
inline std::vector<Redundancy> choices() {
  return {Redundancy::any, Redundancy::nearest, Redundancy::centred};
}

template <>
inline std::vector<InverseStatus> choices() {
  using enum InverseStatus;
  return {solved,    unreachable, orientation_unreachable, outside_limits, not_found, time_limit,
          cancelled, work_limit};
}

/// The search of one pose has no known end.
template <>
inline constexpr bool reports<InverseOptions> = false;

template <>
struct Fields<InverseOptions> {
  static constexpr const char* name = "InverseOptions";
  static constexpr auto all() {
    return std::tuple(
        field("seed", &InverseOptions::seed,
              "Solutions are sorted by their distance from it, (n,); default: arm.middle. It may "
              "be outside the limits."),
        field("task", &InverseOptions::task,
              "Components of the pose: spatial, position, planar, or a mask such as 111110, with "
              ":tool in the tool's axes; default: planar for a planar arm, else spatial."),
        field("method", &InverseOptions::method, "`automatic`: a closed form where there is one."),
        field(
            "all", &InverseOptions::all,
            "All solutions instead of one. Closed form: all that exist; of a redundant arm, all "
            "on a grid of values of the redundant joint. Numerical: those found in all restarts."),
        field("every_turn", &InverseOptions::every_turn,
              "With `all`: also solutions that differ by multiples of 2 pi."),
        field("ignore_limits", &InverseOptions::ignore_limits, "Ignore the joint limits."),
        field("lock", &InverseOptions::lock,
              "A coordinate, from 0 to n - 1, that keeps the seed's value."),
        field("redundancy", &InverseOptions::redundancy,
              "Of infinitely many solutions, `any`: the first that is found; `nearest` to the "
              "seed; `centred`: the least margin of a joint to its limits is largest."),
        field(
            "pose_tolerance", &InverseOptions::pose_tolerance,
            "How far the tool may deviate from the pose where that has no solution, in the pose's "
            "axes: x, y, z (m), roll, pitch, yaw (rad), or x, y, theta for a planar arm. One "
            "solution is given, of locally least deviation."),
        field("weights", &InverseOptions::weights,
              "Weight of each coordinate in distances from the seed, (n,), 1e-6 to 1e6; default: 1 "
              "each."),
        field("grid", &InverseOptions::grid,
              "Number of values of the redundant joint tried first, 2 to 10000."),
        field("tolerance", &InverseOptions::tolerance,
              "Largest error of a solution, metres and radians, above 0."),
        field("max_iterations", &InverseOptions::max_iterations,
              "Maximum number of steps of the numerical solver from one start."),
        field("max_restarts", &InverseOptions::max_restarts,
              "Maximum number of random starts after the first."),
        field("random_seed", &InverseOptions::random_seed, "The same value gives the same result."),
        field("budget", &InverseOptions::budget, ""));
  }
};

template <>
struct Fields<NearestMiss> {
  static constexpr const char* name = "NearestMiss";
  static constexpr const char* doc = "The configuration nearest to the requested pose.";
  static constexpr auto all() {
    return std::tuple(
        field("q", &NearestMiss::q,
              "Status outside_limits: the solution that is least outside the limits. not_found, or "
              "ended by the budget: the configuration of least error that was found. Otherwise one "
              "of least position error and, among those, of least orientation error, limits "
              "ignored."),
        field("world_T_tool", &NearestMiss::world_T_tool, "The tool's pose at q (4, 4)."),
        field("error", &NearestMiss::error, "Of that pose from the requested one."),
        field("blocking", &NearestMiss::blocking,
              "outside_limits: the coordinate that is farthest outside; else -1."),
        field("excess", &NearestMiss::excess,
              "outside_limits: how far it is outside, radians or metres."));
  }
};

template <>
struct Fields<SolutionGrid> {
  static constexpr const char* name = "SolutionGrid";
  static constexpr const char* doc =
      "The values of the redundant joint at which all solutions were sought.";
  static constexpr auto all() {
    return std::tuple(field("joint", &SolutionGrid::joint, "The coordinate, from 0 to n - 1."),
                      field("values", &SolutionGrid::values, "Ascending, radians or metres."),
                      field("complete", &SolutionGrid::complete,
                            "Those of the values at which no solution is missing."));
  }
};

template <>
struct Fields<InverseResult> {
  static constexpr const char* name = "InverseResult";
  static constexpr const char* doc = "Solutions of inverse kinematics, or why there are none.";
  static constexpr const char* truth = "Whether there is a solution.";
  static constexpr auto all() {
    return std::tuple(
        field("status", &InverseResult::status,
              "`solved`: every solution is checked by forward kinematics. `unreachable`, "
              "`orientation_unreachable`, `outside_limits`: none exists, or none of many searches "
              "found one; `reason` says which. `not_found` proves nothing. `time_limit`, "
              "`cancelled`, `work_limit`: the budget ended the search."),
        field("solutions", &InverseResult::solutions,
              "By distance from the seed, (S, n). Empty unless solved, or ended by the budget."),
        field("complete", &InverseResult::complete,
              "With `all`: these are all solutions, which are finitely many."),
        field("branches_complete", &InverseResult::branches_complete,
              "With `all`: every branch is represented, also where a branch has infinitely many "
              "solutions."),
        field("self_motion_dimension", &InverseResult::self_motion_dimension,
              "With `all`: the dimension of the set of solutions, limits ignored. 0: each solution "
              "is isolated. 1 or more: there are infinitely many, connected by self-motions of the "
              "arm, of which `solutions` are samples; `lock` keeps a joint, `redundancy` selects "
              "one. At a singular configuration 1 stands for 1 or more."),
        field("grid", &InverseResult::grid,
              "With `all`, for a redundant arm that has a closed form once one joint is locked."),
        field("singular", &InverseResult::singular,
              "Solved by a closed form at a singular configuration: each solution represents "
              "infinitely many, and is the nearest of them to the seed."),
        field("residual", &InverseResult::residual,
              "Metres or radians, the larger of both. solved: the largest error of a solution. "
              "unreachable: the least position error. orientation_unreachable: the nearest miss's "
              "angle. outside_limits: its excess."),
        field("deviation", &InverseResult::deviation,
              "With `pose_tolerance`, of the solution: the tool's deviation from the pose, in the "
              "order of that option; `residual` is what exceeds it."),
        field("nearest", &InverseResult::nearest, "The nearest miss, if there are no solutions."),
        field("reason", &InverseResult::reason,
              "One sentence; empty when solved and not singular."),
        field("method", &InverseResult::method,
              "Such as `closed form: three axes meet (joints 4, 5, 6)`."),
        field("iterations", &InverseResult::iterations,
              "Of the numerical solver, over all starts."),
        field("restarts", &InverseResult::restarts, "Random starts."));
  }
};

struct BatchInverseResult {
  KeptArray<double> q;
  Ending ending = Ending::complete;
  Index computed = 0, solved = 0;

  explicit operator bool() const { return solved == poses(); }
  /// The number of poses.
  Index poses() const {
    Index count = 1;
    for (Index size : q.shape().first(q.shape().size() - 1)) count *= size;
    return count;
  }
};

template <>
struct Fields<BatchInverseResult> {
  static constexpr const char* name = "BatchInverseResult";
  static constexpr const char* doc = "One solution for each pose of a batch.";
  static constexpr const char* truth = "Whether every pose has a solution.";
  static constexpr auto all() {
    return std::tuple(
        field("q", &BatchInverseResult::q,
              "Configurations (..., n). NaN where no solution was found, or the budget ended the "
              "batch before."),
        field("ending", &BatchInverseResult::ending, "Whether the budget ended the batch."),
        field("computed", &BatchInverseResult::computed, "Number of poses computed."),
        field("solved", &BatchInverseResult::solved, "Number of poses with a solution."));
  }
  static void check(const BatchInverseResult& value) {
    if (value.q.shape().empty()) throw Error("q has no rows");
  }
};

}  // namespace beeline::python
