#pragma once

#include <beeline/model/arm.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>

#include "record.h"

namespace beeline::python {

template <>
inline std::vector<JointKind> choices() {
  return {JointKind::revolute, JointKind::prismatic, JointKind::helical};
}

template <>
inline std::vector<DhConvention> choices() {
  return {DhConvention::standard, DhConvention::modified};
}
template <>
inline std::string spelling(DhConvention convention) {
  return convention == DhConvention::standard ? "standard" : "modified";
}

template <>
struct Fields<BuiltInArm> {
  static constexpr const char* name = "BuiltInArm";
  static constexpr const char* doc = "What a built-in arm is, and where its numbers come from.";
  static constexpr auto all() {
    return std::tuple(
        field("name", &BuiltInArm::name, "Of `beeline.arms` and `Arm.load`."),
        field("maker", &BuiltInArm::maker, "Who makes or has described it."),
        field("model", &BuiltInArm::model, "The maker's name of it."),
        field("source", &BuiltInArm::source, "The document of its lengths and limits."),
        field("note", &BuiltInArm::note, "Zero, signs and couplings; may be empty."),
        field("joint_names", &BuiltInArm::joint_names,
              "What descriptions for ROS call the joints, in the arm's order: a list for each "
              "description."));
  }
};

template <>
struct Fields<Limits> {
  static constexpr const char* name = "Limits";
  static constexpr const char* doc =
      "Limits of one joint, in rad, or m for a prismatic joint, and s. Infinite if there is no "
      "limit, or none is known.";
  static constexpr bool constructible = true;
  static void check(const Limits& limits) {  // as arms do
    Joint joint;
    joint.name = "of these limits";
    joint.screw << 0, 0, 0, 0, 0, 1;
    joint.limits = limits;
    Arm(joint.name, {joint});
  }
  static constexpr auto all() {
    return std::tuple(field("lower", &Limits::lower, "Of the position, at most `upper`."),
                      field("upper", &Limits::upper, "Of the position."),
                      field("velocity", &Limits::velocity, "Of abs(dq/dt), above 0."),
                      field("acceleration", &Limits::acceleration, "Of abs(d2q/dt2), above 0."),
                      field("jerk", &Limits::jerk, "Of abs(d3q/dt3), above 0."),
                      field("speed_scale", &Limits::speed_scale,
                            "The speed scale k that the limits have been multiplied by."));
  }
};

template <>
struct Fields<LimitOverrides> {
  static constexpr const char* name = "LimitOverrides";
  static constexpr const char* doc = "Limits that replace those of a joint; None keeps a limit.";
  static constexpr bool constructible = true;
  static constexpr auto all() {
    return std::tuple(field("lower", &LimitOverrides::lower, "Of the position, rad or m."),
                      field("upper", &LimitOverrides::upper, "Of the position, rad or m."),
                      field("velocity", &LimitOverrides::velocity, "Of abs(dq/dt)."),
                      field("acceleration", &LimitOverrides::acceleration, "Of abs(d2q/dt2)."),
                      field("jerk", &LimitOverrides::jerk, "Of abs(d3q/dt3)."));
  }
};

template <>
struct Fields<Mimic> {
  static constexpr const char* name = "Mimic";
  static constexpr const char* doc =
      "The coupling of a joint to another one: value = multiplier * leader + offset.";
  static constexpr bool constructible = true;
  static constexpr auto all() {
    return std::tuple(field("leader", &Mimic::leader, "Name of the joint that it follows."),
                      field("multiplier", &Mimic::multiplier, "Factor."),
                      field("offset", &Mimic::offset, "rad or m."));
  }
};

template <>
struct Fields<Joint> {
  static constexpr const char* name = "Joint";
  static constexpr const char* doc =
      "One degree of freedom between two links. The pose of link i in link i-1 is\n"
      "offset @ exp(screw * q) (Dellaert, *Serial Link Manipulators*, eq. 1.1).";
  static constexpr bool constructible = true;
  static constexpr auto all() {
    return std::tuple(
        field("name", &Joint::name, "Name."),
        field("offset", &Joint::offset, "Pose of link i in link i-1 at q = 0 (4, 4)."),
        field("screw", &Joint::screw,
              "Unit screw [vx vy vz wx wy wz] in the frame of link i, (6,)."),
        field("limits", &Joint::limits, "Limits."),
        field("mimic", &Joint::mimic, "The joint that it follows, or None."),
        field("link", &Joint::link, "Name of link i; empty where it has none."));
  }
};

template <>
struct Fields<DhRow> {
  static constexpr const char* name = "DhRow";
  static constexpr const char* doc =
      "One row of a Denavit-Hartenberg table, metres and radians. The joint's coordinate is added "
      "to theta (revolute) or d (prismatic).";
  static constexpr bool constructible = true;
  static constexpr auto all() {
    return std::tuple(field("a", &DhRow::a, "Link length, m."),
                      field("alpha", &DhRow::alpha, "Link twist, rad."),
                      field("d", &DhRow::d, "Link offset, m."),
                      field("theta", &DhRow::theta, "Joint angle, rad."),
                      field("kind", &DhRow::kind, "Kind of the joint."));
  }
};

}  // namespace beeline::python
