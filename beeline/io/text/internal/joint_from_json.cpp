#include <cmath>

#include <beeline/error.h>
#include <beeline/io/text/internal/joint_from_json.h>
#include <beeline/io/text/internal/name_json.h>
#include <beeline/io/text/internal/pose_json.h>
#include <beeline/model/internal/ranges.h>
#include <beeline/model/joint.h>

namespace beeline::internal {
namespace {

double number_or(const JsonDocument& document, const Json& object, const char* key,
                 double otherwise) {
  const Json* found = document.find(object, key);
  return found == nullptr ? otherwise : document.number(*found);
}

Limits limits_from_json(const JsonDocument& document, const Json& json) {
  return overridden({}, limit_overrides_from_json(document, json));
}

Mimic mimic_from_json(const JsonDocument& document, const Json& json) {
  document.check_keys(json, {"joint", "multiplier", "offset"});
  return {.leader = document.text(document.need(json, "joint")),
          .multiplier = number_or(document, json, "multiplier", 1),
          .offset = number_or(document, json, "offset", 0)};
}

Vector3 vector_or(const JsonDocument& document, const Json& object, const char* key,
                  const Vector3& otherwise) {
  const Json* found = document.find(object, key);
  return found == nullptr ? otherwise : vector_from_json(document, *found);
}

/// Reads a screw from its six numbers, without change, so that every joint can be written exactly.
Twist whole_screw(const JsonDocument& document, const Json& object, const Json& json) {
  for (const char* key : {"axis", "point", "pitch"}) {
    if (document.find(object, key) != nullptr) {
      document.refuse(object, std::string("has both screw and ") + key + "; give one of them");
    }
  }
  const std::vector<double> values = document.numbers(json, 6);
  const Twist screw = Eigen::Map<const Twist>(values.data());
  const double rotation = screw.tail<3>().norm();
  const double length = rotation == 0 ? screw.head<3>().norm() : rotation;
  if (std::abs(length - 1) > 1e-9) {
    document.refuse(json, "must have an axis of length 1, not " + number(length));
  }
  return screw;
}

Twist screw_from_json(const JsonDocument& document, const Json& json, const std::string& type) {
  if (const Json* whole = document.find(json, "screw")) {
    return whole_screw(document, json, *whole);
  }
  const Vector3 axis = vector_or(document, json, "axis", Vector3::UnitZ());
  const Vector3 point = vector_or(document, json, "point", Vector3::Zero());
  const Json* pitch = document.find(json, "pitch");
  if (type == name(JointKind::prismatic) && document.find(json, "point") != nullptr) {
    document.refuse(json, "has a point; a prismatic joint has an axis only");
  }
  if ((pitch != nullptr) != (type == name(JointKind::helical))) {
    document.refuse(json, pitch != nullptr ? "has a pitch; only a helical joint has one"
                                           : "is helical and needs the key \"pitch\"");
  }
  try {
    if (type == name(JointKind::prismatic)) return translation_screw(axis);
    return rotation_screw(axis, point, pitch == nullptr ? 0 : document.number(*pitch));
  } catch (const Error& error) {
    document.refuse(json, std::string("is not a screw axis: ") + error.what());
  }
}

/// Returns the letter of a composite type, 0 for a single joint. Refuses unknown types.
char composite_letter(const JsonDocument& document, const Json& json) {
  const std::string& text = document.text(json);
  std::vector<std::string> names;
  for (const JointType& type : joint_types()) {
    if (type.name == text) return type.composite ? type.letter : '\0';
    names.push_back(type.name);
  }
  document.refuse(
      json, std::string("is an ") + unknown_name("joint type", printable(text), names).what());
}

std::vector<Joint> composite_from_json(const JsonDocument& document, const Json& json,
                                       char letter) {
  for (const char* key : {"limits", "mimic", "axis", "point", "pitch", "screw"}) {
    if (const Json* found = document.find(json, key)) {
      document.refuse(*found, "is not for composite joints; describe the joints one by one");
    }
  }
  return composite_joint(letter, name_from_json(document, document.need(json, "name")));
}

Joint single_from_json(const JsonDocument& document, const Json& json) {
  Joint joint;
  const Json& type = document.need(json, "type");
  joint.name = name_from_json(document, document.need(json, "name"));
  joint.screw = screw_from_json(document, json, document.text(type));
  if (const Json* screw = document.find(json, "screw")) {
    if (std::abs(joint.screw.head<3>().dot(joint.screw.tail<3>())) > max_length) {
      document.refuse(*screw, "has a pitch above " + number(max_length) + " m/rad");
    }
  }
  if (const Json* pitch = document.find(json, "pitch")) {
    if (std::abs(document.number(*pitch)) > max_length) {
      document.refuse(*pitch, "is a pitch above " + number(max_length) + " m/rad");
    }
    if (kind(joint) == JointKind::revolute) {
      document.refuse(*pitch, "is a pitch of 0 to rounding; such a joint is revolute");
    }
  }
  if (document.text(type) != name(kind(joint))) {
    document.refuse(type,
                    std::string("contradicts the joint's screw, which is ") + name(kind(joint)));
  }
  if (const Json* limits = document.find(json, "limits")) {
    joint.limits = limits_from_json(document, *limits);
  }
  if (const Json* mimic = document.find(json, "mimic")) {
    joint.mimic = mimic_from_json(document, *mimic);
  }
  return joint;
}

}  // namespace

LimitOverrides limit_overrides_from_json(const JsonDocument& document, const Json& json) {
  document.check_keys(json, {"lower", "upper", "velocity", "acceleration", "jerk"});
  const auto position = [&](const char* key) -> std::optional<double> {
    const Json* found = document.find(json, key);
    if (found == nullptr) return std::nullopt;
    return document.number(*found);
  };
  const auto rate = [&](const char* key) {
    const std::optional<double> value = position(key);
    if (value && !(*value >= Limits::min_rate)) {
      document.refuse(*document.find(json, key), "must be at least " + number(Limits::min_rate) +
                                                     "; omit it when it is not known");
    }
    return value;
  };
  const LimitOverrides limits{.lower = position("lower"),
                              .upper = position("upper"),
                              .velocity = rate("velocity"),
                              .acceleration = rate("acceleration"),
                              .jerk = rate("jerk")};
  if (limits.lower && limits.upper && *limits.lower > *limits.upper) {
    document.refuse(json, "are inconsistent: lower " + number(*limits.lower) + " exceeds upper " +
                              number(*limits.upper));
  }
  return limits;
}

std::vector<Joint> joints_from_json(const JsonDocument& document, const Json& json) {
  document.check_keys(json, {"name", "type", "origin", "axis", "point", "pitch", "screw", "limits",
                             "mimic", "link"});
  const char letter = composite_letter(document, document.need(json, "type"));
  std::vector<Joint> joints;
  if (letter == 0) {
    joints.push_back(single_from_json(document, json));
  } else {
    joints = composite_from_json(document, json, letter);
  }
  if (const Json* origin = document.find(json, "origin")) {
    joints.front().offset = pose_from_json(document, *origin);
  }
  if (const Json* link = document.find(json, "link")) {
    joints.back().link = name_from_json(document, *link);
  }
  return joints;
}

Joint dh_joint_from_json(const JsonDocument& document, const Json& json, DhConvention convention,
                         double angle_unit, std::size_t number) {
  document.check_keys(json, {"name", "type", "a", "alpha", "d", "theta", "limits"});
  DhRow row{.a = number_or(document, json, "a", 0),
            .alpha = number_or(document, json, "alpha", 0) * angle_unit,
            .d = number_or(document, json, "d", 0),
            .theta = number_or(document, json, "theta", 0) * angle_unit};
  if (const Json* type = document.find(json, "type")) {
    const std::string& text = document.text(*type);
    if (text != "revolute" && text != "prismatic") {
      document.refuse(*type, "must be revolute or prismatic in a DH table");
    }
    if (text == "prismatic") row.kind = JointKind::prismatic;
  }
  Joint joint = dh_joint(row, convention);
  const Json* name = document.find(json, "name");
  joint.name = name == nullptr ? "joint" + std::to_string(number) : name_from_json(document, *name);
  if (const Json* limits = document.find(json, "limits")) {
    joint.limits = limits_from_json(document, *limits);
    if (row.kind == JointKind::revolute) {
      for (double* value : {&joint.limits.lower, &joint.limits.upper, &joint.limits.velocity,
                            &joint.limits.acceleration, &joint.limits.jerk}) {
        *value *= angle_unit;
      }
    }
  }
  return joint;
}

}  // namespace beeline::internal
