#pragma once

#include <vector>

#include <beeline/inverse/numerical/bounds.h>
#include <beeline/model/internal/kept.h>

namespace beeline::internal {

/// The number of configurations that the kernels process together.
inline constexpr int solver_lane_count = 8;

/// One number for each lane, aligned for the widest registers.
struct alignas(64) EightNumbers {
  double lane[solver_lane_count] = {};
};

/// Arm, task and bounds in the form that the iterative solvers use, computed once for many poses.
/// Lengths and the coordinates of prismatic joints are in units of `length`, so that they are
/// comparable with radians. `length` is a power of two, so the conversion is exact.
struct NumericalProblem {
  Task task;
  Bounds bounds;
  double length = 1;  ///< metres; unit_of_length(arm) rounded to a power of two
  Chain chain;        ///< in units of length
  struct Coordinate {
    double unit = 1;                   ///< radians or metres
    double lower = 0, upper = 0;       ///< the bounds, in units
    bool wraps = false;                ///< whether a step beyond a bound continues one turn away
    double lowest = 0, highest = 0;    ///< the bounds of a step: infinite if it wraps
    bool slides = false;               ///< whether the joint is prismatic
    bool periodic = false;             ///< see Arm::periodic()
    int first_link = 0, end_link = 0;  ///< its links are links[first_link] to links[end_link - 1]
  };
  std::vector<Coordinate> coordinates;
  std::vector<int> links;  ///< indices into chain.links, ordered by coordinate

  // As an arm keeps it: see Kept.
  struct Key {
    Task task;
    bool ignore_limits = false;
    bool operator==(const Key&) const = default;
  };
  static constexpr SharedBy shared_by = SharedBy::copies;
  static NumericalProblem make(const Arm& arm, const Key& key);
  std::size_t heap_bytes() const;
};

/// Throws Error for a task and bounds that check_task() refuses.
NumericalProblem numerical_problem(const Arm& arm, const Task& task, const Bounds& bounds);

/// Returns the goal in the form of the kernels: the position of the tool, in units of length, with
/// the orientation of the last link.
Pose last_link_goal(const NumericalProblem& problem, const Pose& world_T_tool);

}  // namespace beeline::internal
