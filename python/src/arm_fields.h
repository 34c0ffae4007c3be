#pragma once

#include <beeline/io/text/urdf.h>
#include <beeline/model/arm.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>

#include "record.h"

namespace beeline::python {

/// The keyword `xacro` of functions that read an arm's file.
constexpr const char* xacro_type = "collections.abc.Mapping[str, object]";
constexpr const char* xacro_text =
    "Values of the arguments of a .xacro file, by name, such as {'ur_type': 'ur5e'}.";

/// The values as texts, as str() makes them.
XacroArguments xacro_arguments(nb::handle values);

template <>
struct Fields<BuiltInArm>
    : Members<&BuiltInArm::name, &BuiltInArm::maker, &BuiltInArm::model, &BuiltInArm::source,
              &BuiltInArm::note, &BuiltInArm::shapes_source, &BuiltInArm::joint_names> {};

template <>
struct Fields<Limits> : Members<&Limits::lower, &Limits::upper, &Limits::velocity,
                                &Limits::acceleration, &Limits::jerk, &Limits::speed_scale> {
  static constexpr bool constructible = true;
  static void check(const Limits& limits) {  // as arms do
    Joint joint;
    joint.name = "of these limits";
    joint.screw << 0, 0, 0, 0, 0, 1;
    joint.limits = limits;
    Arm(joint.name, {joint});
  }
};

template <>
struct Fields<LimitOverrides>
    : Members<&LimitOverrides::lower, &LimitOverrides::upper, &LimitOverrides::velocity,
              &LimitOverrides::acceleration, &LimitOverrides::jerk> {
  static constexpr bool constructible = true;
};

template <>
struct Fields<Mimic> : Members<&Mimic::leader, &Mimic::multiplier, &Mimic::offset> {
  static constexpr bool constructible = true;
};

template <>
struct Fields<Joint> : Members<&Joint::name, &Joint::offset, &Joint::screw, &Joint::limits,
                               &Joint::mimic, &Joint::link> {
  static constexpr bool constructible = true;
};

template <>
struct Fields<DhRow> : Members<&DhRow::a, &DhRow::alpha, &DhRow::d, &DhRow::theta, &DhRow::kind> {
  static constexpr bool constructible = true;
};

}  // namespace beeline::python
