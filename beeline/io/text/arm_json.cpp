#include <algorithm>
#include <cmath>
#include <optional>

#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/arm_to_json.h>
#include <beeline/io/text/internal/joint_from_json.h>
#include <beeline/io/text/internal/joint_to_json.h>
#include <beeline/io/text/internal/json_write.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/name_json.h>
#include <beeline/io/text/internal/pose_json.h>
#include <beeline/io/text/internal/screws_from_json.h>
#include <beeline/io/text/internal/written_angles.h>
#include <beeline/io/text/pose_list.h>
#include <beeline/model/internal/ranges.h>

namespace beeline {
namespace {

using internal::check_name;

const std::vector<std::string> descriptions{"joints", "joint_string", "dh", "screws"};

std::vector<Joint> joints_from_list(const JsonDocument& document, const Json& list) {
  std::vector<Joint> joints;
  for (const Json& item : document.items(list)) {
    for (Joint& joint : internal::joints_from_json(document, item))
      joints.push_back(std::move(joint));
  }
  return joints;
}

std::vector<Joint> joints_from_dh(const JsonDocument& document, const Json& dh) {
  document.check_keys(dh, {"convention", "degrees", "rows"});
  const Json* convention = document.find(dh, "convention");
  const std::string text = convention == nullptr ? "" : document.text(*convention);
  if (text != "standard" && text != "modified") {
    document.refuse(convention == nullptr ? dh : *convention,
                    std::string(convention == nullptr ? "needs the key \"convention\": it must say "
                                                      : "must be ") +
                        "standard or modified, because the numbers do not determine which");
  }
  const double angle_unit = to_radians(1, internal::unit_of_dh(document));
  std::vector<Joint> joints;
  for (const Json& row : document.items(document.need(dh, "rows"))) {
    joints.push_back(internal::dh_joint_from_json(
        document, row, text == "modified" ? DhConvention::modified : DhConvention::standard,
        angle_unit, joints.size() + 1));
  }
  return joints;
}

/// The joints and the tool of a document.
struct Description {
  std::vector<Joint> joints;
  std::optional<Pose> tool;
};

/// The arm of "screws", whose rows and home pose are in the world.
Description description_of_screws(const JsonDocument& document, const Json& screws) {
  for (const char* key : {"base", "tool"}) {
    const Json* found = document.find(document.root(), key);
    if (found == nullptr) continue;
    document.refuse(*found,
                    "is not for screws: these and the home pose of the tool are in the world");
  }
  const Arm arm = internal::arm_from_screws_json(
      document, screws, document.text(document.need(document.root(), "name")));
  return {arm.joints(), arm.tool()};
}

std::optional<Pose> tool_of(const JsonDocument& document) {
  const Json* tool = document.find(document.root(), "tool");
  if (tool == nullptr) return std::nullopt;
  return internal::pose_from_json(document, *tool);
}

Description description_of(const JsonDocument& document) {
  const Json& root = document.root();
  std::vector<std::string> given;
  for (const std::string& key : descriptions) {
    if (document.find(root, key) != nullptr) given.push_back(key);
  }
  if (given.size() != 1) {
    document.refuse(root, "needs exactly one of the keys " + listed(descriptions) + "; it has " +
                              (given.empty() ? "none" : listed(given)));
  }
  const Json& description = document.need(root, given.front());
  if (given.front() == "screws") return description_of_screws(document, description);
  if (given.front() == "joints")
    return {joints_from_list(document, description), tool_of(document)};
  if (given.front() == "dh") return {joints_from_dh(document, description), tool_of(document)};
  try {
    return {arm_from_joint_string(document.text(description)).joints(), tool_of(document)};
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    document.refuse(description, std::string("is not readable: ") + error.what());
  }
}

/// Whether the frame of `key` is assumed: the document has none, or says so of the one that it has.
bool is_assumed(const JsonDocument& document, const char* key) {
  const Json* frame = document.find(document.root(), key);
  const Json* assumed = document.find(document.root(), std::string(key) + "_assumed");
  if (assumed == nullptr) return frame == nullptr;
  if (frame == nullptr) {
    document.refuse(*assumed, "is given without the key \"" + std::string(key) + "\"");
  }
  return document.truth(*assumed);
}

ControllerFrames controller_frames(const JsonDocument& document, const Pose& tool) {
  const Json* base = document.find(document.root(), "controller_base");
  const Json* flange = document.find(document.root(), "flange");
  return {.base = base == nullptr ? Pose::Identity() : internal::pose_from_json(document, *base),
          .base_assumed = is_assumed(document, "controller_base"),
          .flange = flange == nullptr ? tool : internal::pose_from_json(document, *flange),
          .flange_assumed = is_assumed(document, "flange")};
}

/// Adds a warning of the first angle in radians that is more than a revolution.
void warn_of_degrees(const JsonDocument& document, const std::vector<Joint>& joints,
                     std::vector<ReadWarning>& warnings) {
  const auto warns = [&](double angle, const std::string& joint, int line) {
    if (std::abs(angle) <= plausible_angle) return false;
    warnings.push_back({.kind = ReadWarningKind::likely_degrees,
                        .path = document.path(),
                        .line = line,
                        .joint = joint,
                        .numbers = {angle}});
    return true;
  };
  for (const internal::WrittenOrientation& each : internal::written_orientations(document)) {
    Eigen::Index largest = 0;
    each.rpy.cwiseAbs().maxCoeff(&largest);
    if (warns(each.rpy[largest], each.joint, each.line)) return;
  }
  if (internal::unit_of_dh(document) == AngleUnit::degrees) return;
  for (const internal::WrittenDhAngle& each : internal::written_dh_angles(document)) {
    if (warns(each.angle, joints[each.row].name, each.line)) return;
  }
}

/// Refuses lists of names that are none. They are for the catalogue, which an arm's name selects.
void check_joint_names(const JsonDocument& document, const Json& lists) {
  for (const Json& list : document.items(lists)) {
    if (document.items(list).empty()) document.refuse(list, "has no names");
    for (const Json& name : document.items(list)) internal::name_from_json(document, name);
  }
}

}  // namespace

Arm arm_from_json(std::string_view text, const std::string& path,
                  std::vector<ReadWarning>* warnings) {
  const JsonDocument document(text, path);
  const Json& root = document.root();
  document.check_keys(
      root, {"name", "maker", "model", "source", "note", "base", "tool", "controller_base",
             "controller_base_assumed", "flange", "flange_assumed", "joints", "joint_string", "dh",
             "screws", "joint_names", "shapes", "shapes_source", "$schema"});
  for (const char* key : {"$schema", "maker", "model", "source", "note", "shapes_source"}) {
    if (const Json* found = document.find(root, key)) document.text(*found);
  }
  if (const Json* names = document.find(root, "joint_names")) check_joint_names(document, *names);
  const Json* base = document.find(root, "base");
  const std::string& name = document.text(document.need(root, "name"));
  Description found = description_of(document);
  if (found.joints.size() > internal::max_joints) {
    document.refuse(root, "has " + std::to_string(found.joints.size()) + " joints; at most " +
                              std::to_string(internal::max_joints) + " are accepted");
  }
  if (warnings != nullptr) warn_of_degrees(document, found.joints, *warnings);
  const Pose base_pose =
      base == nullptr ? Pose::Identity() : internal::pose_from_json(document, *base);
  const Pose tool = found.tool.value_or(Pose::Identity());
  const ControllerFrames controller = controller_frames(document, tool);
  try {
    check_name(name, "the arm's name");
    return {name, std::move(found.joints), tool, base_pose, controller};
  } catch (const Error& error) {
    throw FileError(path, 0, error.what());
  }
}

Arm read_arm_json(const std::string& path) { return arm_from_json(read_file(path), path); }

namespace {

/// The keys of a frame of the controller; none for an assumed one where readers assume it.
std::string frame_to_json(const std::string& key, const Pose& frame, bool assumed,
                          const Pose& otherwise) {
  if (assumed && frame.matrix() == otherwise.matrix()) return "";
  return ",\n  \"" + key + "\": " + internal::pose_to_json(frame) +
         (assumed ? ",\n  \"" + key + "_assumed\": true" : "");
}

}  // namespace

std::string internal::arm_to_json_with(const Arm& arm, const std::string& members) {
  check_names(arm);
  std::string text = "{\n  \"name\": " + internal::json_string(arm.name());
  if (!arm.base().matrix().isIdentity(0))
    text += ",\n  \"base\": " + internal::pose_to_json(arm.base());
  const ControllerFrames& controller = arm.controller();
  text +=
      frame_to_json("controller_base", controller.base, controller.base_assumed, Pose::Identity());
  text += ",\n  \"joints\": [";
  for (std::size_t i = 0; i < arm.joints().size(); ++i) {
    text += (i == 0 ? "\n    " : ",\n    ") + internal::joint_to_json(arm.joints()[i]);
  }
  text += "\n  ]";
  if (!arm.tool().matrix().isIdentity(0))
    text += ",\n  \"tool\": " + internal::pose_to_json(arm.tool());
  text += frame_to_json("flange", controller.flange, controller.flange_assumed, arm.tool());
  return text + members + "\n}\n";
}

std::string arm_to_json(const Arm& arm) { return internal::arm_to_json_with(arm, ""); }

void write_arm_json(const std::string& path, const Arm& arm) { write_file(path, arm_to_json(arm)); }

}  // namespace beeline
