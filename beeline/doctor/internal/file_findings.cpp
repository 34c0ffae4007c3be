#include <algorithm>
#include <cmath>

#include <beeline/doctor/internal/findings.h>
#include <beeline/doctor/internal/reconciliation.h>
#include <beeline/read/internal/file.h>
#include <beeline/read/internal/json.h>
#include <beeline/read/internal/urdf_file.h>

namespace beeline::internal {
namespace {

constexpr double one_turn = 6.4;  // rad

std::string in_line(const std::string& path, int line) { return path + ":" + std::to_string(line); }

void find_in_urdf(const std::string& path, const Arm& arm, std::vector<Finding>& found) {
  const UrdfFile file = parse_urdf(read_file(path), path);
  for (const UrdfFile::Joint& joint : file.joints) {
    if (joint.rpy.cwiseAbs().maxCoeff() > one_turn) {
      found.push_back({.kind = FindingKind::angle_unit,
                       .place = "joint " + joint.name,
                       .what = "rpy " + number(joint.rpy.x()) + " " + number(joint.rpy.y()) + " " +
                               number(joint.rpy.z()) + " rad (" + in_line(path, joint.line) +
                               "): degrees?",
                       .remedy = "write radians"});
    }
    const auto place = std::find_if(arm.joints().begin(), arm.joints().end(),
                                    [&](const Joint& own) { return own.name == joint.name; });
    if (place == arm.joints().end()) continue;
    const auto index = static_cast<std::size_t>(place - arm.joints().begin());
    if (joint.axis_line == 0) {
      found.push_back({.kind = FindingKind::missing_axis,
                       .joint = static_cast<int>(index),
                       .place = joint_text(arm, index),
                       .what = "no <axis> (" + in_line(path, joint.line) + "): taken as 1 0 0",
                       .remedy = "write the axis, also where it is 1 0 0"});
    } else if (std::abs(joint.axis.norm() - 1) > 1e-3) {
      found.push_back({.kind = FindingKind::axis_length,
                       .joint = static_cast<int>(index),
                       .place = joint_text(arm, index),
                       .what = "axis of length " + number(joint.axis.norm()) + " (" +
                               in_line(path, joint.axis_line) + "), not 1",
                       .cost = "readers that do not normalise it scale the joint's motion",
                       .remedy = "write it with unit length"});
    }
  }
}

void find_in_json(const std::string& path, const Arm& arm, std::vector<Finding>& found) {
  const JsonDocument document(read_file(path), path);
  const Json* dh = document.find(document.root(), "dh");
  if (dh == nullptr) return;
  std::size_t i = 0;
  for (const Json& row : document.items(document.need(*dh, "rows"))) {
    for (const char* key : {"alpha", "theta"}) {
      const Json* angle = document.find(row, key);
      if (angle == nullptr || std::abs(document.number(*angle)) <= one_turn) continue;
      found.push_back(
          {.kind = FindingKind::angle_unit,
           .joint = static_cast<int>(i),
           .place = joint_text(arm, i),
           .what = std::string(key) + " " + number(document.number(*angle)) + " rad (" +
                   in_line(path, angle->line) + "): degrees?",
           .remedy = "in radians: " + number(document.number(*angle) * std::acos(-1.0) / 180)});
    }
    ++i;
  }
}

}  // namespace

void find_in_file(const std::string& path, const Arm& arm, std::vector<Finding>& found) {
  const std::string ending = extension(path);
  if (ending == "urdf" || ending == "xml") find_in_urdf(path, arm, found);
  if (ending == "json") find_in_json(path, arm, found);
}

}  // namespace beeline::internal
