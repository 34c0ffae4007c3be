#pragma once

#include <beeline/io/text/pose_list.h>

#include "record.h"

namespace beeline::python {

template <>
inline std::vector<AngleUnit> choices() {
  return {AngleUnit::radians, AngleUnit::degrees};
}
template <>
inline std::string spelling(AngleUnit unit) {
  return unit == AngleUnit::radians ? "radians" : "degrees";
}

template <>
inline std::vector<Triple> choices() {
  return {Triple::planar, Triple::position};
}
template <>
inline std::string spelling(Triple triple) {
  return triple == Triple::planar ? "planar" : "position";
}

template <>
inline std::vector<PoseForm> choices() {
  return {PoseForm::rpy, PoseForm::rotvec, PoseForm::abc, PoseForm::quaternion, PoseForm::matrix};
}

template <>
struct Fields<PoseList> {
  static constexpr const char* name = "PoseList";
  static constexpr const char* doc = "Poses of a CSV file.";
  static constexpr auto all() {
    return std::tuple(
        field("poses", &PoseList::poses, "(N, 4, 4), at least one."),
        field("lines", &PoseList::lines, "The line of the file of each pose."),
        field("planar", &PoseList::planar, "Given as x,y,theta or x,y."),
        field("max_angle", &PoseList::max_angle,
              "The theta, roll, pitch or yaw, or the length of a rotation vector, that is largest "
              "by magnitude, rad; 0 in the other forms."),
        field("oriented", &PoseList::oriented, "False: positions, given as x,y,z or x,y."),
        field("columns", &PoseList::columns, "Of the form."),
        field("has_header", &PoseList::has_header,
              "False: the form follows from the number of columns."),
        field("form", &PoseList::form, "None: planar or positions."));
  }
};

}  // namespace beeline::python
