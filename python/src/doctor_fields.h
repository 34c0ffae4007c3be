#pragma once

#include <beeline/doctor/comparison.h>
#include <beeline/doctor/diagnosis.h>

#include "kinematics_fields.h"

namespace beeline::python {

template <>
inline std::vector<DifferenceKind> choices() {
  using Kind = DifferenceKind;
  return {Kind::convention, Kind::unit,  Kind::columns, Kind::joint_order,  Kind::joint_count,
          Kind::joint_kind, Kind::mount, Kind::tool,    Kind::joint_offset, Kind::joint_sign,
          Kind::length,     Kind::angle, Kind::axis,    Kind::orientation,  Kind::mimic,
          Kind::name,       Kind::limit};
}

template <>
inline std::vector<ModelComparison> choices() {
  return {ModelComparison::same, ModelComparison::reconciled, ModelComparison::different};
}

template <>
inline std::vector<FindingKind> choices() {
  using Kind = FindingKind;
  return {Kind::length_unit,      Kind::angle_unit,   Kind::rounded_angle, Kind::nearly_special,
          Kind::coincident_axes,  Kind::missing_axis, Kind::axis_length,   Kind::no_range,
          Kind::unknown_velocity, Kind::fault};
}

template <>
struct Fields<Finding> {
  static constexpr const char* name = "Finding";
  static constexpr const char* doc = "A suspicious number of a model.";
  static constexpr auto all() {
    return std::tuple(field("kind", &Finding::kind, "What is suspicious."),
                      field("joint", &Finding::joint, "From 0; -1: several, or the whole arm."),
                      field("place", &Finding::place, "Such as `joint 3 (elbow)`."),
                      field("what", &Finding::what, "The value, and why it is suspicious."),
                      field("cost", &Finding::cost, "What it costs; empty where nothing is."),
                      field("remedy", &Finding::remedy, "What to write instead."));
  }
};

template <>
struct Fields<Diagnosis> {
  static constexpr const char* name = "Diagnosis";
  static constexpr const char* doc = "The suspicious numbers of a model.";
  static constexpr const char* truth = "True if nothing is suspicious.";
  static constexpr auto all() {
    return std::tuple(field("findings", &Diagnosis::findings, "In the order of the checks."));
  }
};

template <>
struct Fields<ModelDifference> {
  static constexpr const char* name = "ModelDifference";
  static constexpr const char* doc =
      "One difference of two models, and what to change in A so that it describes B.";
  static constexpr auto all() {
    using Difference = ModelDifference;
    return std::tuple(
        field("kind", &Difference::kind, "What differs."),
        field("joint", &Difference::joint, "From 0, in A; -1: of the whole arm."),
        field("parameter", &Difference::parameter, "Such as d, alpha, `upper limit`."),
        field("a", &Difference::a, "The value in A, rad or m."),
        field("b", &Difference::b, "The value in B."),
        field("pose", &Difference::pose,
              "Of a mount world_T_mount, of a tool tool_T_tcp: to be added to A."),
        field("what", &Difference::what, "One clause."),
        field("remedy", &Difference::remedy, "What to write, as an option of the command."));
  }
};

template <>
struct Fields<ComparisonOptions> {
  static constexpr auto all() {
    return std::tuple(
        field("tolerance", &ComparisonOptions::tolerance,
              "Smaller differences are rounding, m and rad, above 0."),
        field("configurations", &ComparisonOptions::configurations,
              "Number of random configurations at which the kinematics are compared."));
  }
};

template <>
struct Fields<ArmComparison> {
  static constexpr const char* name = "ArmComparison";
  static constexpr const char* doc = "What two descriptions of an arm have different.";
  static constexpr const char* truth =
      "True if the two move alike as they are, and have equal limits.";
  static constexpr auto all() {
    using Comparison = ArmComparison;
    return std::tuple(
        field("status", &Comparison::status, "Whether they are the same arm."),
        field("explained", &Comparison::explained,
              "Whether the differences explain B completely, verified by forward kinematics."),
        field("verdict", &Comparison::verdict, "One sentence."),
        field("differences", &Comparison::differences, "What makes A equal to B."),
        field("alternative", &Comparison::alternative, "Another explanation with as few."),
        field("gain", &Comparison::gain, "q of B = gain * q of A + offset,"),
        field("offset", &Comparison::offset, "one for each joint."),
        field("before", &Comparison::before, "Largest difference of the tool's pose."),
        field("residual", &Comparison::residual, "The same, with the differences applied to A."),
        field("configurations", &Comparison::configurations, "Number of those compared."),
        field("others", &Comparison::others,
              "Differences that do not change the tool's pose: limits, names, mimic joints."));
  }
};

}  // namespace beeline::python
