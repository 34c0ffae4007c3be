#pragma once

#include <beeline/path/joint_path.h>

#include "record.h"

namespace beeline::python {

template <>
struct Fields<JointPath> : Members<&JointPath::s, &JointPath::q, &JointPath::dq, &JointPath::ddq> {
  static constexpr std::size_t required = 4;
  static constexpr auto check = [](const JointPath& path) { check_path(path); };
};

template <>
struct Fields<PathPoint>
    : Members<&PathPoint::q, &PathPoint::dq, &PathPoint::ddq, &PathPoint::dddq> {};

template <>
struct Fields<RefineOptions> : Members<&RefineOptions::min_steps, &RefineOptions::max_change,
                                       &RefineOptions::max_parts, &RefineOptions::budget> {};

}  // namespace beeline::python
