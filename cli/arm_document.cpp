#include "arm_document.h"

#include <cmath>
#include <numbers>

namespace beeline::command {
namespace {

constexpr double Limits::*rates[] = {&Limits::velocity, &Limits::acceleration, &Limits::jerk};
constexpr const char* rate_names[] = {"velocity", "acceleration", "jerk"};

Json joint_document(const Arm& arm, std::size_t i, bool degrees) {
  const Joint& joint = arm.joints()[i];
  const bool prismatic = kind(joint) == JointKind::prismatic;
  const auto value = [&](double number) {
    return prismatic || !degrees ? number : number * 180 / std::numbers::pi;
  };
  const Limits& known = joint_limits(arm, i);
  Json limits = Json::object();
  const auto add = [&](const char* key, double limit) {
    limits.add(key, value(limit));  // null where it is infinite
  };
  add("lower", known.lower);
  add("upper", known.upper);
  add("velocity", known.velocity);
  add("acceleration", known.acceleration);
  add("jerk", known.jerk);
  const Limits kept = motion_limits(known);
  Json assumed = Json::object();
  for (std::size_t k = 0; k < 3; ++k) {
    if (!std::isfinite(known.*rates[k])) assumed.add(rate_names[k], value(kept.*rates[k]));
  }
  Json document{{"name", joint.name}, {"type", name(kind(joint))}};
  if (!joint.link.empty()) document.add("link", joint.link);
  document.add("limits", limits);
  document.add("assumed", assumed);
  if (joint.mimic) {
    document.add("mimic", Json{{"joint", joint.mimic->leader},
                               {"multiplier", joint.mimic->multiplier},
                               {"offset", value(joint.mimic->offset)}});
  }
  return document;
}

}  // namespace

Json arm_document(const Arm& arm, bool degrees) {
  Json joints = Json::list();
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    joints.append(joint_document(arm, i, degrees));
  }
  return {{"name", arm.name()},
          {"joints", joints},
          {"dof", arm.dof()},
          {"planar", arm.planar()},
          {"reach",
           Json{{"centre", Eigen::VectorXd(arm.reach().centre)}, {"radius", arm.reach().radius}}}};
}

}  // namespace beeline::command
