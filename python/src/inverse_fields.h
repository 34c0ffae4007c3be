#pragma once

#include <functional>

#include <beeline/batch/batch.h>
#include <beeline/inverse/inverse_kinematics.h>

#include "kept_array.h"
#include "kinematics_fields.h"
#include "reason.h"

namespace beeline::python {

/// InverseOptions::blocked_by: a CollisionModel, which the function keeps.
template <>
struct Value<std::function<Reason(const ConfigurationRef&)>> {
  using Function = std::function<Reason(const ConfigurationRef&)>;
  static std::string type() { return "CollisionModel | None"; }
  static nb::object to(const Function&) { return nb::none(); }
  static Function from(nb::handle value, const char* name);
};

/// The search of one pose has no known end.
template <>
inline constexpr bool reports<InverseOptions> = false;

template <>
struct Fields<InverseOptions>
    : Members<&InverseOptions::seed, &InverseOptions::task, &InverseOptions::method,
              &InverseOptions::all, &InverseOptions::every_turn, &InverseOptions::ignore_limits,
              &InverseOptions::blocked_by, &InverseOptions::lock, &InverseOptions::redundancy,
              &InverseOptions::pose_tolerance, &InverseOptions::weights, &InverseOptions::grid,
              &InverseOptions::tolerance, &InverseOptions::max_iterations,
              &InverseOptions::max_restarts, &InverseOptions::random_seed,
              &InverseOptions::budget> {};

template <>
struct Fields<NearestMiss>
    : Members<&NearestMiss::q, &NearestMiss::world_T_tool, &NearestMiss::error,
              &NearestMiss::blocking, &NearestMiss::excess> {};

template <>
struct Fields<BlockedSolution> : Members<&BlockedSolution::q, &BlockedSolution::reason> {};

template <>
struct Fields<SolutionGrid>
    : Members<&SolutionGrid::joint, &SolutionGrid::values, &SolutionGrid::complete> {};

template <>
struct Fields<InverseResult>
    : Members<&InverseResult::status, &InverseResult::solutions, &InverseResult::blocked,
              &InverseResult::complete, &InverseResult::branches_complete,
              &InverseResult::self_motion_dimension, &InverseResult::grid, &InverseResult::singular,
              &InverseResult::residual, &InverseResult::deviation, &InverseResult::nearest,
              &InverseResult::reason, &InverseResult::method, &InverseResult::iterations,
              &InverseResult::restarts> {
  /// Whether the member is found by explain(), when it is first used.
  static bool is_left(std::string_view member) {
    return member == "nearest" || member == "residual" || member == "reason";
  }
  static void complete(InverseResult& result) { explain(result); }
};

/// One solution for each pose of a batch.
struct BatchInverseResult {
  /// Configurations (..., n). NaN where no solution was found, or the budget ended the batch
  /// before.
  KeptArray<double> q;
  Ending ending = Ending::complete;  ///< whether the budget ended the batch
  Index computed = 0;                ///< number of poses computed
  Index solved = 0;                  ///< number of poses with a solution

  /// Whether every pose has a solution.
  explicit operator bool() const { return solved == poses(); }
  /// The number of poses.
  Index poses() const {
    Index count = 1;
    for (Index size : q.shape().first(q.shape().size() - 1)) count *= size;
    return count;
  }
};

template <>
struct Fields<BatchInverseResult>
    : Members<&BatchInverseResult::q, &BatchInverseResult::ending, &BatchInverseResult::computed,
              &BatchInverseResult::solved> {
  static void check(const BatchInverseResult& value) {
    if (value.q.shape().empty()) throw Error("q has no rows");
  }
};

}  // namespace beeline::python
