#include <algorithm>
#include <unordered_set>

#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/arm_format.h>
#include <beeline/io/text/internal/arm_to_json.h>
#include <beeline/io/text/internal/built_in_shapes.h>
#include <beeline/io/text/internal/json_write.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/name_json.h>
#include <beeline/io/text/internal/shape_json.h>
#include <beeline/io/text/scene.h>
#include <beeline/model/internal/ranges.h>

namespace beeline {
namespace {

/// Sets the link that carries the body, and the default of its name.
void set_link(const JsonDocument& document, const Json* joint, const Arm& arm, LinkShapes& body) {
  body.name = "base";
  if (joint == nullptr) return;
  const std::string& name = document.text(*joint);
  std::vector<std::string> known;
  for (const Joint& of_arm : arm.joints()) {
    known.push_back(of_arm.name);
    if (of_arm.name != name) continue;
    body.link = known.size();
    body.name = of_arm.link.empty() ? name : of_arm.link;
    return;
  }
  document.refuse(*joint,
                  std::string("is not known: ") + unknown_name("joint", name, known).what());
}

LinkShapes body_from_json(const JsonDocument& document, const Json& json, const Arm& arm) {
  document.check_keys(json, {"joint", "name", "shapes", "attached"});
  LinkShapes body;
  set_link(document, document.find(json, "joint"), arm, body);
  if (const Json* name = document.find(json, "name")) {
    body.name = internal::name_from_json(document, *name);
  }
  if (const Json* attached = document.find(json, "attached")) {
    body.at_proximal_joint = body.at_distal_joint = !document.truth(*attached);
  }
  body.shapes = internal::shapes_from_json(document, json);
  return body;
}

std::string body_to_json(const Arm& arm, const LinkShapes& body) {
  internal::check_name(body.name, "the name of a body");
  if (body.link > arm.joints().size()) {
    throw Error(internal::in_quotes(body.name) + " is on link " + std::to_string(body.link) + "; " +
                arm.name() + " has links 0 to " + std::to_string(arm.joints().size()));
  }
  std::string text = "{";
  if (body.link > 0) {
    const Joint& joint = arm.joints()[body.link - 1];
    text += "\"joint\": " + internal::json_string(joint.name) + ", ";
  }
  text += "\"name\": " + internal::json_string(body.name);
  if (internal::is_attached_in_file(arm, body)) text += ", \"attached\": true";
  text += ", \"shapes\": [";
  for (std::size_t i = 0; i < body.shapes.size(); ++i) {
    text += (i == 0 ? "\n      " : ",\n      ") + internal::shape_to_json(body.shapes[i]);
  }
  return text + "]}";
}

}  // namespace

void internal::refuse_hold(const ShapeOptions& options) {
  if (options.hold.empty()) return;
  throw Error::of("hold", "only a URDF file has joints beside the chain that can be held");
}

ArmShapes internal::shapes_from_arm_json(std::string_view text, const std::string& path,
                                         const ChainEnds& /*ends*/, const ShapeOptions& options,
                                         const std::vector<Srdf::State>& /*states*/) {
  refuse_hold(options);
  const Arm arm = arm_from_json(text, path);
  const JsonDocument document(text, path);
  ArmShapes read;
  const Json* const bodies = document.find(document.root(), "shapes");
  if (bodies == nullptr) return read;
  std::unordered_set<std::string> names;
  for (const Json& json : document.items(*bodies)) {
    read.links.push_back(body_from_json(document, json, arm));
    const std::string& name = read.links.back().name;
    if (!names.insert(name).second) {
      document.refuse(json, "has the name " + internal::in_quotes(name) + " of another body");
    }
  }
  return read;
}

bool internal::is_attached_in_file(const Arm& arm, const LinkShapes& body) {
  const bool at_proximal = body.link == 0 || body.at_proximal_joint;
  const bool at_distal = body.link == arm.joints().size() || body.at_distal_joint;
  return !at_proximal || !at_distal;
}

ArmShapes arm_shapes_from_text(std::string_view text, const std::string& path,
                               const ChainEnds& ends, const ShapeOptions& options) {
  Srdf srdf;
  if (!options.srdf.empty()) srdf = read_srdf(options.srdf);
  const internal::ArmFormat& format = internal::arm_format_of_file(path, ends);
  ArmShapes read = format.shapes(text, path, ends, options, srdf.states);
  const std::vector<NamedPair> exempted = exempted_pairs(srdf, read.links);
  read.allowed_pairs.insert(read.allowed_pairs.end(), exempted.begin(), exempted.end());
  return read;
}

ArmShapes read_arm_shapes(const std::string& text, const ChainEnds& ends,
                          const ShapeOptions& options) {
  if (internal::arm_format_of(text) != nullptr) {
    return arm_shapes_from_text(read_file(text), text, ends, options);
  }
  const std::string name = read_arm(text, ends).name();  // refuses what is no arm
  const std::string_view built_in = internal::built_in_shapes(name);
  if (!built_in.empty()) return arm_shapes_from_text(built_in, name + ".json", ends, options);
  internal::refuse_hold(options);
  return {};
}

std::string planes_note(const std::string& path, const std::vector<std::string>& links) {
  return path + ": planes are obstacles, not shapes of the arm; they are left out of " +
         listed(links) + ", and a scene may have a half_space for each";
}

std::vector<LinkShapes> behind_joints(std::vector<LinkShapes> links, std::size_t joints,
                                      const std::vector<std::string>& standing) {
  if (joints > internal::max_joints) {
    throw Error::of("joints", std::to_string(joints) + " joints are too many; at most " +
                                  std::to_string(internal::max_joints) + " are accepted");
  }
  if (joints == 0) return links;
  for (LinkShapes& body : links) {
    const bool stands =
        body.link == 0 && std::find(standing.begin(), standing.end(), body.name) != standing.end();
    if (stands) {
      body.at_distal_joint = false;  // which now is the first of these joints, at the carriage
      continue;
    }
    if (body.link == 0 && body.at_distal_joint) body.at_proximal_joint = true;
    body.link += joints;
  }
  return links;
}

std::string arm_to_json(const Arm& arm, const std::vector<LinkShapes>& links) {
  std::string bodies;
  std::unordered_set<std::string> names;
  for (const LinkShapes& body : links) {
    if (body.shapes.empty()) continue;
    bodies += (bodies.empty() ? "\n    " : ",\n    ") + body_to_json(arm, body);
    if (!names.insert(body.name).second) {
      throw Error("two bodies have the name " + internal::in_quotes(body.name));
    }
  }
  if (bodies.empty()) return arm_to_json(arm);
  return internal::arm_to_json_with(arm, ",\n  \"shapes\": [" + bodies + "\n  ]");
}

LinkShapes read_tool_shapes(const std::string& path, const Arm& arm) {
  const JsonDocument document(read_file(path), path);
  document.check_keys(document.root(), {"name", "shapes"});
  LinkShapes tool{.name = "tool", .link = arm.joints().size(), .shapes = {}};
  if (const Json* name = document.find(document.root(), "name")) {
    tool.name = internal::name_from_json(document, *name);
  }
  tool.at_proximal_joint = tool.at_distal_joint = false;
  tool.shapes = internal::shapes_from_json(document, document.root());
  if (tool.shapes.empty()) {
    document.refuse(document.need(document.root(), "shapes"), "has no shape");
  }
  for (Shape& shape : tool.shapes) shape.pose = arm.tool() * shape.pose;
  return tool;
}

}  // namespace beeline
