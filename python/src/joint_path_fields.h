#pragma once

#include <beeline/path/joint_path.h>

#include "record.h"

namespace beeline::python {

template <>
struct Fields<JointPath> {
  static constexpr const char* name = "JointPath";
  static constexpr const char* doc =
      "A path in joint space without time: q and its derivatives with respect to the path "
      "parameter s at N grid points. Between them it is the quintic Hermite polynomial.";
  static constexpr std::size_t required = 4;
  static constexpr auto check = [](const JointPath& path) { check_path(path); };
  static constexpr auto all() {
    return std::tuple(field("s", &JointPath::s, "Path parameter, strictly increasing, (N,)."),
                      field("q", &JointPath::q, "rad or m, (N, n)."),
                      field("dq", &JointPath::dq, "dq/ds, (N, n)."),
                      field("ddq", &JointPath::ddq, "d2q/ds2, (N, n)."));
  }
};

template <>
struct Fields<PathPoint> {
  static constexpr const char* name = "PathPoint";
  static constexpr const char* doc =
      "The configuration and its derivatives with respect to s at one path parameter.";
  static constexpr auto all() {
    return std::tuple(field("q", &PathPoint::q, "rad or m, (n,)."),
                      field("dq", &PathPoint::dq, "dq/ds, (n,)."),
                      field("ddq", &PathPoint::ddq, "d2q/ds2, (n,)."),
                      field("dddq", &PathPoint::dddq, "d3q/ds3, (n,)."));
  }
};

template <>
struct Fields<RefineOptions> {
  static constexpr const char* name = "RefineOptions";
  static constexpr auto all() {
    return std::tuple(
        field("min_steps", &RefineOptions::min_steps,
              "Above 0: no step is longer than the path divided by this."),
        field("max_change", &RefineOptions::max_change,
              "Above 0: of dq/ds over a step, relative to abs(dq/ds)."),
        field("max_parts", &RefineOptions::max_parts, "1 or more: into which one step is divided."),
        field("budget", &RefineOptions::budget, ""));
  }
};

}  // namespace beeline::python
