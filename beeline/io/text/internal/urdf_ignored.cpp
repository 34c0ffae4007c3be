#include <algorithm>
#include <iterator>
#include <map>
#include <string_view>
#include <tinyxml2.h>

#include <beeline/internal/nearest_name.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/urdf_ignored.h>
#include <beeline/io/text/internal/xml_elements.h>

namespace beeline::internal {
namespace {

using Names = std::vector<std::string>;
using tinyxml2::XMLElement;

/// An element of a joint.
struct JointPart {
  std::string name;
  Names attributes;       ///< attributes that URDF defines; empty: the element is not read
  bool of_motion = true;  ///< it matters for joints with one degree of freedom only
};

const std::vector<JointPart>& joint_parts() {
  static const std::vector<JointPart> parts{
      {"origin", {"xyz", "rpy", "quat_xyzw"}, false},
      {"parent", {"link"}, false},
      {"child", {"link"}, false},
      {"axis", {"xyz"}},
      {"limit", {"lower", "upper", "velocity", "effort", "acceleration", "deceleration", "jerk"}},
      {"mimic", {"joint", "multiplier", "offset"}},
      {"dynamics", {}},
      {"safety_controller", {}},
      {"calibration", {}}};
  return parts;
}

const JointPart* part_called(std::string_view name) {
  const auto& parts = joint_parts();
  const auto found = std::find_if(parts.begin(), parts.end(),
                                  [&](const JointPart& part) { return part.name == name; });
  return found == parts.end() ? nullptr : &*found;
}

std::string in_brackets(std::string_view name) { return "<" + std::string(name) + ">"; }

/// Names of other programs: `drake:limit`, `xmlns`.
bool has_prefix(std::string_view name) {
  return name.find(':') != std::string_view::npos || name == "xmlns";
}

/// Appends the attributes that are not among the known ones.
void find_attributes(const XMLElement& element, const Names& known,
                     std::vector<ReadWarning>& found) {
  for (const auto* at = element.FirstAttribute(); at != nullptr; at = at->Next()) {
    const std::string_view name = at->Name();
    if (has_prefix(name) || std::find(known.begin(), known.end(), name) != known.end()) continue;
    found.push_back({.kind = ReadWarningKind::unknown_attribute,
                     .line = element.GetLineNum(),
                     .element = described(element),
                     .attribute = printable(name)});
  }
}

/// Appends the attributes of a part that are not among the known ones. If the part has all that
/// URDF asks for, an attribute that resembles none of URDF's is another program's.
void find_part_attributes(const XMLElement& element, const JointPart& part,
                          std::vector<ReadWarning>& found) {
  std::vector<ReadWarning> all;
  find_attributes(element, part.attributes, all);
  constexpr const char* of_limit[] = {"lower", "upper", "velocity", "effort"};
  const bool complete = part.name == "limit" &&
                        std::all_of(std::begin(of_limit), std::end(of_limit),
                                    [&](const char* name) { return element.Attribute(name); });
  for (ReadWarning& warning : all) {
    if (complete && nearest_name(warning.attribute, part.attributes) == nullptr) continue;
    found.push_back(std::move(warning));
  }
}

/// The attributes of a <joint>. Programs have some of their own, which resemble none of these.
void find_own_attributes(const XMLElement& joint, std::vector<ReadWarning>& found) {
  ReadWarning own{.kind = ReadWarningKind::unknown_attribute, .element = described(joint)};
  const Names known = names_like(own);
  std::vector<ReadWarning> all;
  find_attributes(joint, known, all);
  Names meant = known;
  for (const JointPart& part : joint_parts()) meant.push_back(part.name);
  for (ReadWarning& warning : all) {
    if (nearest_name(warning.attribute, meant) != nullptr) found.push_back(std::move(warning));
  }
}

}  // namespace

std::vector<ReadWarning> ignored_parts(const XMLElement& joint, bool moves) {
  std::vector<ReadWarning> found;
  find_own_attributes(joint, found);
  std::map<const JointPart*, ReadWarning> repeated;
  std::map<const JointPart*, std::size_t> count;
  for (const XMLElement* at = joint.FirstChildElement(); at != nullptr;
       at = at->NextSiblingElement()) {
    if (has_prefix(at->Name())) continue;
    const JointPart* part = part_called(at->Name());
    if (part == nullptr) {
      found.push_back({.kind = ReadWarningKind::unknown_element,
                       .line = at->GetLineNum(),
                       .element = described(*at)});
      continue;
    }
    if (part->attributes.empty() || (part->of_motion && !moves)) continue;
    if (++count[part] == 1) {
      find_part_attributes(*at, *part, found);
    } else {
      repeated.try_emplace(part, ReadWarning{.kind = ReadWarningKind::repeated_element,
                                             .line = at->GetLineNum(),
                                             .element = described(*at)});
    }
  }
  for (auto& [part, warning] : repeated) {
    warning.count = count.at(part);
    found.push_back(std::move(warning));
  }
  return found;
}

bool misspelt_part(const XMLElement& element) {
  const std::string_view tag = element.Name();
  return !has_prefix(tag) && element.Attribute("name") != nullptr &&
         nearest_name(tag, {"joint", "link"}) != nullptr;
}

bool is_ignored(ReadWarningKind kind) {
  return kind == ReadWarningKind::unknown_element || kind == ReadWarningKind::unknown_attribute ||
         kind == ReadWarningKind::repeated_element || kind == ReadWarningKind::zero_multiplier ||
         kind == ReadWarningKind::range_ignored || kind == ReadWarningKind::constraint_ignored;
}

std::vector<std::string> names_like(const ReadWarning& warning) {
  if (warning.kind == ReadWarningKind::unknown_element) {
    if (warning.joint.empty()) return {"<link>", "<joint>"};
    Names names;
    for (const JointPart& part : joint_parts()) names.push_back(in_brackets(part.name));
    return names;
  }
  if (warning.element == "<joint>") return {"name", "type"};
  const std::string_view element = warning.element;
  const JointPart* part = part_called(element.substr(1, element.size() - 2));
  return part == nullptr ? Names{} : part->attributes;
}

}  // namespace beeline::internal
