#include <cmath>

#include <beeline/io/text/internal/joint_to_json.h>
#include <beeline/io/text/internal/json_write.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/internal/pose_json.h>
#include <beeline/io/text/internal/rounded.h>
#include <beeline/io/text/numbers.h>

namespace beeline::internal {
namespace {

/// Returns `"axis": ..., "point": ..., "pitch": ...` with the fewest digits that give exactly this
/// screw. Where no digits do, because the screw itself was rounded, returns its six numbers.
std::string screw_to_json(const Joint& joint) {
  const bool prismatic = kind(joint) == JointKind::prismatic;
  const bool helical = kind(joint) == JointKind::helical;
  const Vector3 v = joint.screw.head<3>();
  const Vector3 axis = prismatic ? v : joint.screw.tail<3>();
  const Vector3 nearest = prismatic ? Vector3::Zero() : axis.cross(v);  // to the origin
  const double exact_pitch = helical ? pitch(joint) : 0;
  for (const int digits : readable_digits) {
    const Vector3 point = rounded(nearest, digits);
    const double short_pitch = rounded(exact_pitch, digits);
    const Twist read_back =
        prismatic ? translation_screw(axis) : rotation_screw(axis, point, short_pitch);
    if (read_back != joint.screw) continue;
    std::string text = "\"axis\": " + json_numbers(rounded(axis, 17).eval().data(), 3);
    if (!point.isZero(0)) text += ", \"point\": " + json_numbers(point.data(), 3);
    if (helical) text += ", \"pitch\": " + exact(short_pitch);
    return text;
  }
  return "\"screw\": " + json_numbers(joint.screw.data(), 6);
}

std::string limits_to_json(const Limits& limits) {
  std::string text;
  const auto add = [&text](const char* key, double value) {
    if (!std::isfinite(value)) return;
    text += (text.empty() ? "{\"" : ", \"") + std::string(key) + "\": " + exact(value);
  };
  add("lower", limits.lower);
  add("upper", limits.upper);
  add("velocity", limits.velocity);
  add("acceleration", limits.acceleration);
  add("jerk", limits.jerk);
  return text.empty() ? text : text + "}";
}

}  // namespace

std::string joint_to_json(const Joint& joint) {
  std::string text =
      "{\"name\": " + json_string(joint.name) + ", \"type\": \"" + name(kind(joint)) + '"';
  if (!joint.link.empty()) text += ", \"link\": " + json_string(joint.link);
  const auto add_line = [&text](const std::string& members) { text += ",\n     " + members; };
  if (!joint.offset.matrix().isIdentity(0)) {
    add_line("\"origin\": " + pose_to_json(joint.offset));
  }
  add_line(screw_to_json(joint));
  const std::string limits = limits_to_json(joint.limits);
  if (!limits.empty()) add_line("\"limits\": " + limits);
  if (joint.mimic) {
    add_line("\"mimic\": {\"joint\": " + json_string(joint.mimic->leader) + ", \"multiplier\": " +
             exact(joint.mimic->multiplier) + ", \"offset\": " + exact(joint.mimic->offset) + "}");
  }
  return text + "}";
}

}  // namespace beeline::internal
