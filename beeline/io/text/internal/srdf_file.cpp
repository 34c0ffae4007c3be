#include <tinyxml2.h>
#include <unordered_set>

#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/xml.h>
#include <beeline/io/text/internal/xml_elements.h>
#include <beeline/io/text/urdf.h>

namespace beeline {
namespace {

using internal::XmlElements;
using tinyxml2::XMLElement;

Srdf::Group read_group(const XmlElements& elements, const XMLElement& element) {
  Srdf::Group group;
  group.name = elements.needed_name(element, "name");
  group.line = element.GetLineNum();
  for (const XMLElement* at = element.FirstChildElement(); at; at = at->NextSiblingElement()) {
    const std::string_view tag = at->Name();
    if (tag == "chain") {
      group.chains.push_back({.base = elements.needed_name(*at, "base_link"),
                              .tip = elements.needed_name(*at, "tip_link")});
    } else if (tag == "joint") {
      group.joints.push_back(elements.needed_name(*at, "name"));
    } else if (tag == "link") {
      group.links.push_back(elements.needed_name(*at, "name"));
    } else if (tag == "group") {
      group.groups.push_back(elements.needed_name(*at, "name"));
    }
  }
  return group;
}

Srdf::State read_state(const XmlElements& elements, const XMLElement& element) {
  Srdf::State state;
  state.name = elements.needed_name(element, "name");
  if (const char* group = element.Attribute("group")) state.group = group;  // some files lack it
  state.line = element.GetLineNum();
  for (const XMLElement* at = element.FirstChildElement("joint"); at;
       at = at->NextSiblingElement("joint")) {
    const std::string joint = elements.needed_name(*at, "name");
    if (!state.joints.emplace(joint, elements.numbers(*at, "value")).second) {
      elements.refuse(at->GetLineNum(), "state " + state.name + " gives joint " + joint + " twice");
    }
  }
  return state;
}

NamedPair read_pair(const XmlElements& elements, const XMLElement& element) {
  return {elements.needed_name(element, "link1"), elements.needed_name(element, "link2")};
}

}  // namespace

Srdf srdf_from_text(std::string_view text, const std::string& path) {
  const XmlElements elements(path);
  tinyxml2::XMLDocument document;
  internal::parse_xml(document, text, path);
  const XMLElement* robot = document.RootElement();
  if (robot == nullptr || std::string_view(robot->Name()) != "robot") {
    elements.refuse(robot == nullptr ? 0 : robot->GetLineNum(),
                    "is not SRDF: its root must be <robot>, not " +
                        (robot == nullptr ? "nothing" : internal::described(*robot)));
  }
  Srdf srdf;
  srdf.path = path;
  std::unordered_set<std::string> groups, states;
  for (const XMLElement* at = robot->FirstChildElement(); at; at = at->NextSiblingElement()) {
    const std::string_view tag = at->Name();
    if (tag.starts_with("xacro:")) {
      elements.refuse(at->GetLineNum(), "is a xacro file; run xacro first");
    } else if (tag == "link") {
      elements.refuse(at->GetLineNum(), "is a URDF file, not an SRDF file: it has links");
    } else if (tag == "group") {
      srdf.groups.push_back(read_group(elements, *at));
      if (groups.insert(srdf.groups.back().name).second) continue;
      elements.refuse(at->GetLineNum(), "two groups have the name " + srdf.groups.back().name);
    } else if (tag == "group_state") {
      srdf.states.push_back(read_state(elements, *at));
      const Srdf::State& state = srdf.states.back();
      if (states.insert(state.name + '\n' + state.group).second) continue;
      elements.refuse(at->GetLineNum(), "two states of one group have the name " + state.name);
    } else if (tag == "virtual_joint") {
      srdf.virtual_joints.push_back(elements.needed_name(*at, "name"));
    } else if (tag == "disable_collisions") {
      srdf.disabled_collisions.push_back(read_pair(elements, *at));
    } else if (tag == "enable_collisions") {
      srdf.enabled_collisions.push_back(read_pair(elements, *at));
    } else if (tag == "disable_default_collisions") {
      srdf.disabled_links.push_back(elements.needed_name(*at, "link"));
    }
  }
  return srdf;
}

Srdf read_srdf(const std::string& path) { return srdf_from_text(read_file(path), path); }

}  // namespace beeline
