#include <cmath>

#include <beeline/read/joint_json.h>
#include <beeline/read/numbers.h>
#include <beeline/read/pose_json.h>
#include <beeline/read/rounded.h>

namespace beeline {
namespace {

/// `"axis": ..., "point": ..., "pitch": ...`, in the roundest numbers that give exactly this
/// screw; where none do, because of rounding on the way here, its six numbers.
std::string screw_to_json(const Joint& joint) {
  const bool slides = kind(joint) == JointKind::prismatic;
  const bool travels = kind(joint) == JointKind::helical;
  const Vector3 v = joint.screw.head<3>();
  const Vector3 axis = slides ? v : joint.screw.tail<3>();
  const Vector3 nearest = slides ? Vector3::Zero() : axis.cross(v);  // the axis' point at the foot
  const Vector3 along(travels ? pitch(joint) : 0, 0, 0);             // as a vector, to be rounded
  for (const int digits : readable_digits) {
    const Vector3 point = rounded(nearest, digits);
    const double travel = rounded(along, digits).x();
    const Twist read_back = slides ? translation_screw(axis) : rotation_screw(axis, point, travel);
    if (read_back != joint.screw) continue;
    std::string text = "\"axis\": " + json_numbers(rounded(axis, 17).eval().data(), 3);
    if (!point.isZero(0)) text += ", \"point\": " + json_numbers(point.data(), 3);
    if (travels) text += ", \"pitch\": " + exact(travel);
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
      "{\"name\": " + json_text(joint.name) + ", \"type\": \"" + name(kind(joint)) + '"';
  if (!joint.link.empty()) text += ", \"link\": " + json_text(joint.link);
  const auto add_line = [&text](const std::string& members) { text += ",\n     " + members; };
  if (!joint.offset.matrix().isIdentity(0)) {
    add_line("\"origin\": " + pose_to_json(joint.offset));
  }
  add_line(screw_to_json(joint));
  const std::string limits = limits_to_json(joint.limits);
  if (!limits.empty()) add_line("\"limits\": " + limits);
  if (joint.mimic) {
    add_line("\"mimic\": {\"joint\": " + json_text(joint.mimic->leader) + ", \"multiplier\": " +
             exact(joint.mimic->multiplier) + ", \"offset\": " + exact(joint.mimic->offset) + "}");
  }
  return text + "}";
}

}  // namespace beeline
