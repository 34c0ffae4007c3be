#pragma once

#include <beeline/certificate/verify.h>

#include "path_fields.h"
#include "reason.h"
#include "trajectory_fields.h"

namespace beeline::python {

template <>
inline std::vector<Fault> choices() {
  return {Fault::none,      Fault::limits,      Fault::flip,     Fault::deviation,
          Fault::backwards, Fault::not_through, Fault::velocity, Fault::acceleration,
          Fault::jerk,      Fault::moving,      Fault::dwell,    Fault::tool_speed};
}

template <>
struct Fields<MovingEnds> {
  static constexpr const char* name = "MovingEnds";
  static constexpr const char* doc =
      "The ends of a trajectory at which the joints may move; at the others they start from rest, "
      "or come to rest.";
  static constexpr std::size_t required = 2;
  static constexpr bool as_tuple = true;
  static constexpr auto all() {
    return std::tuple(field("start", &MovingEnds::start, "At the start."),
                      field("end", &MovingEnds::end, "At the end."));
  }
};

template <>
struct Fields<JointFault> {
  static constexpr const char* name = "JointFault";
  static constexpr const char* doc = "A fault of a trajectory's joints.";
  static constexpr auto all() {
    return std::tuple(field("kind", &JointFault::kind, "Kind of fault."),
                      field("sample", &JointFault::sample,
                            "The fault is at this sample, or between it and the next."),
                      field("reason", &JointFault::reason, "One sentence: joint, value, limit."));
  }
};

template <>
struct Fields<PathDeviation> {
  static constexpr const char* name = "PathDeviation";
  static constexpr const char* doc =
      "Deviation of a joint motion from its path: sampled <= measured <= bound.";
  static constexpr auto all() {
    return std::tuple(
        field("sampled", &PathDeviation::sampled, "Largest deviation at the samples."),
        field("measured", &PathDeviation::measured,
              "Largest deviation at the samples and at some times between them."),
        field("bound", &PathDeviation::bound, "Proved upper bound at all times."),
        field("interval_bounds", &PathDeviation::interval_bounds,
              "Proved from sample k to the next: position, m, and orientation, rad, (N - 1, 2)."),
        field("ending", &PathDeviation::ending,
              "`complete`, or what ended the computation: then `bound` is infinite."));
  }
};

template <>
inline constexpr bool reports<VerifyOptions> = false;
template <>
struct Fields<VerifyOptions> {
  static constexpr const char* name = "VerifyOptions";
  static constexpr auto all() {
    return std::tuple(
        field("moving", &VerifyOptions::moving,
              "The ends at which the joints may move; default: at rest at both."),
        field("task", &VerifyOptions::task,
              "Rows that matter; None: planar for a planar arm, else spatial."),
        field("tolerance", &VerifyOptions::tolerance, "Max deviation in position, m, above 0."),
        field("orientation_tolerance", &VerifyOptions::orientation_tolerance,
              "Max deviation in orientation, rad, above 0."),
        field(
            "limit_tolerance", &VerifyOptions::limit_tolerance,
            "Fraction, 0 to 0.1, by which velocity, acceleration and jerk may exceed their limits, "
            "for the rounding of other planners."),
        field("budget", &VerifyOptions::budget, ""));
  }
};

template <>
struct Fields<Verification> {
  static constexpr const char* name = "Verification";
  static constexpr const char* doc =
      "The proof that a trajectory follows a path within the arm's limits, or the first fault.";
  static constexpr const char* truth = "True if proved.";
  static constexpr auto all() {
    return std::tuple(
        field("fault", &Verification::fault, "The first in time; `none` if there is none."),
        field("reason", &Verification::reason,
              "One sentence: time, sample, what, by how much; empty if proved."),
        field("sample", &Verification::sample,
              "The fault is at this sample, or between it and the next."),
        field("time", &Verification::time, "Of that sample, s."),
        field("deviation", &Verification::deviation,
              "Over the whole trajectory, or up to the fault."),
        field("path", &Verification::path, "Of the route."),
        field("path_parameters", &Verification::path_parameters,
              "Of the samples, as far as they are on the path."),
        field("arrivals", &Verification::arrivals,
              "The sample at the end of each segment, or the first after it, as far as the "
              "trajectory follows the path; of a program, at the end of each move."),
        field("ending", &Verification::ending,
              "Unless `complete`, the rest of the trajectory has not been checked, and nothing is "
              "proved."));
  }
};

}  // namespace beeline::python
