#pragma once

#include <functional>

#include <beeline/planning/move_along.h>

#include "certificate_fields.h"
#include "timing_fields.h"

namespace beeline::python {

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

/// PathMotionOptions::blocked_by: a CollisionModel, which the function keeps.
template <>
struct Value<BlockedMotions> {
  static std::string type() { return "CollisionModel | None"; }
  static nb::object to(const BlockedMotions&) { return nb::none(); }
  static BlockedMotions from(nb::handle value, const char* name);
};

/// BranchOptions::spare_clearance: a CollisionModel, which the function keeps.
template <>
struct Value<std::function<double(const ConfigurationRef&)>> {
  using Function = std::function<double(const ConfigurationRef&)>;
  static std::string type() { return "CollisionModel | None"; }
  static nb::object to(const Function&) { return nb::none(); }
  static Function from(nb::handle value, const char* name);
};

template <>
struct Fields<TrackedSegment>
    : Members<&TrackedSegment::samples, &TrackedSegment::fractions, &TrackedSegment::deviation> {
  static void check(const TrackedSegment& segment) {
    if (segment.fractions.empty()) throw Error("a tracked segment needs fractions");
  }
};

template <>
struct Fields<Branch>
    : Members<&Branch::start, &Branch::status, &Branch::reason, &Branch::path_parameter,
              &Branch::limit_margin, &Branch::inverse_condition, &Branch::spare_clearance,
              &Branch::segments> {};

template <>
struct Fields<BranchOptions>
    : Members<&BranchOptions::task, &BranchOptions::tolerance, &BranchOptions::max_samples,
              &BranchOptions::max_grid, &BranchOptions::reasons, &BranchOptions::guide,
              &BranchOptions::spare_clearance, &BranchOptions::budget> {};

template <>
struct Fields<NearbyPath>
    : Members<&NearbyPath::translation, &NearbyPath::rotation, &NearbyPath::path,
              &NearbyPath::start, &NearbyPath::description> {};

template <>
struct Fields<PathMotionOptions>
    : Members<&PathMotionOptions::task, &PathMotionOptions::tolerance,
              &PathMotionOptions::orientation_tolerance, &PathMotionOptions::profile,
              &PathMotionOptions::interpolation, &PathMotionOptions::tool_speed,
              &PathMotionOptions::rate, &PathMotionOptions::duration,
              &PathMotionOptions::max_samples, &PathMotionOptions::recover,
              &PathMotionOptions::blocked_by, &PathMotionOptions::recover_clearance,
              &PathMotionOptions::suggest, &PathMotionOptions::budget> {};

template <>
struct Fields<BlockedBranch> : Members<&BlockedBranch::start, &BlockedBranch::status,
                                       &BlockedBranch::reason, &BlockedBranch::path_parameter> {};

template <>
struct Fields<PathMotion>
    : Members<&PathMotion::status, &PathMotion::reason, &PathMotion::path_parameter,
              &PathMotion::nearby, &PathMotion::blocked, &PathMotion::trajectory, &PathMotion::path,
              &PathMotion::path_parameters, &PathMotion::arrivals, &PathMotion::deviation,
              &PathMotion::limits, &PathMotion::recovery, &PathMotion::limit_margin,
              &PathMotion::inverse_condition> {};

}  // namespace beeline::python
