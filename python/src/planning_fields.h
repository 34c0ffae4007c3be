#pragma once

#include <functional>

#include <beeline/planning/move_along.h>

#include "certificate_fields.h"
#include "timing_fields.h"

namespace beeline::python {

template <>
inline std::vector<MotionStatus> choices() {
  using enum MotionStatus;
  return {reached,          unreachable,   not_found,  outside_limits, singular,  not_proved,
          too_many_samples, not_converged, time_limit, cancelled,      work_limit};
}

template <>
inline std::vector<BranchOptions::Reasons> choices() {
  return {BranchOptions::Reasons::all, BranchOptions::Reasons::best, BranchOptions::Reasons::none};
}
template <>
inline std::string spelling(BranchOptions::Reasons reasons) {
  if (reasons == BranchOptions::Reasons::none) return "none";
  return reasons == BranchOptions::Reasons::all ? "all" : "best";
}

/// A function of Python that returns a configuration.
template <>
struct Value<std::function<Configuration(double)>> {
  using Function = std::function<Configuration(double)>;
  static std::string type() {
    return "collections.abc.Callable[[float], numpy.typing.ArrayLike] | None";
  }
  static nb::object to(const Function&) { return nb::none(); }
  static Function from(nb::handle value, const char* name);
};

template <>
struct Fields<TrackedSegment> {
  static constexpr const char* name = "TrackedSegment";
  static constexpr const char* doc =
      "The samples of an arm along one segment of a path, up to the point where it can no longer "
      "track it.";
  static constexpr auto all() {
    return std::tuple(field("samples", &TrackedSegment::samples,
                            "The first is at the segment's beginning, (N, n)."),
                      field("fractions", &TrackedSegment::fractions,
                            "Of the segment, at each sample: 0 first, (N,)."),
                      field("deviation", &TrackedSegment::deviation, "From the path."));
  }
  static void check(const TrackedSegment& segment) {
    if (segment.fractions.empty()) throw Error("a tracked segment needs fractions");
  }
};

template <>
struct Fields<Branch> {
  static constexpr const char* name = "Branch";
  static constexpr const char* doc =
      "One continuous motion of the arm along a path, without times: a solution of inverse "
      "kinematics at its beginning, tracked as far as possible.";
  static constexpr const char* truth = "True if it reaches the end of the path.";
  static constexpr auto all() {
    return std::tuple(
        field("start", &Branch::start, "Configuration at the path's beginning, (n,)."),
        field("status", &Branch::status, "`reached`, or why it ends."),
        field("reason", &Branch::reason, "Where and why it ends before the path does."),
        field("path_parameter", &Branch::path_parameter, "That it reaches."),
        field("limit_margin", &Branch::limit_margin,
              "Smallest distance of a joint to a position limit, as a fraction of half its range."),
        field("inverse_condition", &Branch::inverse_condition,
              "Smallest inverse condition number of the task's Jacobian, from 0 at a singularity "
              "to 1."),
        field("segments", &Branch::segments, "Samples along each segment."));
  }
};

template <>
struct Fields<BranchOptions> {
  static constexpr const char* name = "BranchOptions";
  static constexpr auto all() {
    return std::tuple(
        field("task", &BranchOptions::task, "Rows that matter."),
        field("tolerance", &BranchOptions::tolerance,
              "m and rad, above 0, between samples too; default: 1e-4 of both."),
        field("max_samples", &BranchOptions::max_samples, "Of one branch."),
        field("max_grid", &BranchOptions::max_grid,
              "For redundant arms: max approximate number of solutions per pose in the layered "
              "graph."),
        field("reasons", &BranchOptions::reasons,
              "The branches whose reason for ending is determined, which takes milliseconds for "
              "each."),
        field("guide", &BranchOptions::guide,
              "Returns the preferred configuration at a path parameter, for poses with several "
              "solutions."),
        field("budget", &BranchOptions::budget, ""));
  }
};

template <>
struct Fields<NearbyPath> {
  static constexpr const char* name = "NearbyPath";
  static constexpr const char* doc =
      "A rigidly moved path that the arm can follow where it cannot follow the original one.";
  static constexpr auto all() {
    return std::tuple(
        field("moved", &NearbyPath::moved, "Translation of the path, m, in world axes, (3,)."),
        field("turned", &NearbyPath::turned,
              "Rotation vector of all its poses, rad, in tool axes, (3,)."),
        field("path", &NearbyPath::path, "The moved path."),
        field("start", &NearbyPath::start,
              "Joint values in place of the start that was given, or None."),
        field("description", &NearbyPath::description,
              "Such as `with every waypoint moved by 0.012 m along -z; the start stays`."));
  }
};

template <>
struct Fields<PathMotionOptions> {
  using T = PathMotionOptions;
  static constexpr const char* name = "PathMotionOptions";
  static constexpr auto all() {
    return std::tuple(
        field("task", &T::task,
              "Rows that matter; None: planar for a planar arm, else spatial. Lines allow any "
              "task; other segments need all orientation rows or none."),
        field("tolerance", &T::tolerance, "Max deviation in position, m, 1e-8 or more."),
        field("orientation_tolerance", &T::orientation_tolerance,
              "Max deviation in orientation, rad, 1e-8 or more."),
        field("profile", &T::profile,
              "The time scaling from stop to stop; None: `jerk`. Every profile keeps known jerk "
              "limits; "
              "`fastest` and `trapezoidal` leave jerk free where it is not known."),
        field("interpolation", &T::interpolation, "Of the trajectory."),
        field("tool_speed", &T::tool_speed, "Limit of the tool origin's speed, m/s."),
        field("rate", &T::rate,
              "Samples per second; 0: as many as interpolation and tolerance need."),
        field("duration", &T::duration,
              "Seconds to which the quickest motion is slowed down, without a rate; None: the "
              "shortest."),
        field("max_samples", &T::max_samples, "Of the whole path, 2 or more."),
        field("suggest", &T::suggest,
              "Where the path cannot be followed, search for paths near it."),
        field("budget", &T::budget, ""));
  }
};

template <>
struct Fields<PathMotion> {
  static constexpr const char* name = "PathMotion";
  static constexpr const char* doc =
      "A trajectory along a path, with its proof. Only status, reason, path_parameter and nearby "
      "are set unless reached.";
  static constexpr const char* truth = "True if reached.";
  static constexpr auto all() {
    return std::tuple(
        field("status", &PathMotion::status, "`reached`, or why not."),
        field("reason", &PathMotion::reason,
              "One sentence, with the position; empty when reached."),
        field("path_parameter", &PathMotion::path_parameter,
              "Up to which the plan follows the path."),
        field("nearby", &PathMotion::nearby, "Paths that work, with the option `suggest`."),
        field("trajectory", &PathMotion::trajectory, "From rest to rest."),
        field("path", &PathMotion::path, "The path that it follows."),
        field("path_parameters", &PathMotion::path_parameters, "Of each sample, (N,)."),
        field("arrivals", &PathMotion::arrivals,
              "The sample at the end of each segment of `path`, or the first after it."),
        field("deviation", &PathMotion::deviation, "Of the finished trajectory, proved."),
        field("limits", &PathMotion::limits, "Of the finished trajectory."),
        field("limit_margin", &PathMotion::limit_margin,
              "Smallest distance of a joint to a position limit, as a fraction of half its range."),
        field("inverse_condition", &PathMotion::inverse_condition,
              "Smallest inverse condition number of the task's Jacobian, from 0 to 1."));
  }
};

}  // namespace beeline::python
