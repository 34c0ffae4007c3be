#include <filesystem>
#include <tinyxml2.h>
#include <unordered_set>

#include <beeline/error.h>
#include <beeline/pose/orientation.h>
#include <beeline/read/internal/name.h>
#include <beeline/read/internal/urdf_file.h>
#include <beeline/read/internal/xml.h>
#include <beeline/read/internal/xml_elements.h>

namespace beeline::internal {
namespace {

using tinyxml2::XMLElement;

void read_origin(const XmlElements& elements, const XMLElement& element, UrdfFile::Joint& joint) {
  const XMLElement* origin = element.FirstChildElement("origin");
  if (origin == nullptr) return;
  joint.rpy = elements.vector(*origin, "rpy", Vector3::Zero());
  joint.origin = make_pose(elements.vector(*origin, "xyz", Vector3::Zero()),
                           rotation(RollPitchYaw{joint.rpy.x(), joint.rpy.y(), joint.rpy.z()}));
}

/// A missing <limit> means no limit, although the format requires one; a missing lower or upper is
/// 0, as the format defines. Many files write velocity="0" for an unknown velocity limit. Gazebo
/// writes -1e16 and 1e16 for no limit, the defaults of SDFormat (joint, axis, limit).
Limits read_limits(const XmlElements& elements, const XMLElement& limit, bool continuous) {
  Limits limits;
  if (!continuous) {
    constexpr double none = 1e16;
    const double lower = elements.number_or(limit, "lower", 0);
    const double upper = elements.number_or(limit, "upper", 0);
    if (lower != -none) limits.lower = lower;
    if (upper != none) limits.upper = upper;
  }
  const double velocity = elements.number_or(limit, "velocity", 0);
  if (velocity != 0) limits.velocity = velocity;
  return limits;
}

Mimic read_mimic(const XmlElements& elements, const XMLElement& mimic) {
  return {.leader = elements.needed_text(mimic, "joint"),
          .multiplier = elements.number_or(mimic, "multiplier", 1),
          .offset = elements.number_or(mimic, "offset", 0)};
}

std::string read_end(const XmlElements& elements, const XMLElement& joint, const char* end) {
  const XMLElement* element = joint.FirstChildElement(end);
  if (element == nullptr) {
    elements.refuse(joint.GetLineNum(), "joint " + in_quotes(joint.Attribute("name")) +
                                            " needs a <" + end + " link=...>");
  }
  return elements.needed_text(*element, "link");
}

UrdfFile::Joint read_joint(const XmlElements& elements, const XMLElement& element) {
  UrdfFile::Joint joint;
  joint.name = elements.needed_name(element, "name");
  joint.type = elements.needed_text(element, "type");
  joint.line = element.GetLineNum();
  joint.parent = read_end(elements, element, "parent");
  joint.child = read_end(elements, element, "child");
  read_origin(elements, element, joint);
  if (!has_one_dof(joint)) return joint;  // many files give a fixed joint an axis of zeros
  if (const XMLElement* axis = element.FirstChildElement("axis")) {
    joint.axis = elements.vector(*axis, "xyz", Vector3::UnitX());
    joint.axis_line = axis->GetLineNum();
  }
  if (const XMLElement* limit = element.FirstChildElement("limit")) {
    joint.limits = read_limits(elements, *limit, joint.type == "continuous");
    joint.limit_line = limit->GetLineNum();
  }
  if (const XMLElement* mimic = element.FirstChildElement("mimic")) {
    joint.mimic = read_mimic(elements, *mimic);
    joint.mimic_line = mimic->GetLineNum();
  }
  return joint;
}

}  // namespace

bool has_one_dof(const UrdfFile::Joint& joint) {
  return joint.type == "revolute" || joint.type == "continuous" || joint.type == "prismatic";
}

UrdfFile parse_urdf(std::string_view text, const std::string& path) {
  const XmlElements elements(path);
  tinyxml2::XMLDocument document;
  parse_xml(document, text, path);
  const XMLElement* robot = document.RootElement();
  if (robot == nullptr || std::string_view(robot->Name()) != "robot") {
    const std::string found = robot == nullptr ? "nothing" : described(*robot);
    elements.refuse(robot == nullptr ? 0 : robot->GetLineNum(),
                    "is not URDF: its root must be <robot>, not " + found);
  }
  UrdfFile file{.path = path, .name = "", .links = {}, .joints = {}};
  const char* name = robot->Attribute("name");
  file.name = name == nullptr || *name == 0 ? printable(std::filesystem::path(path).stem().string())
                                            : elements.needed_name(*robot, "name");
  std::unordered_set<std::string> links, joints;
  for (const XMLElement* at = robot->FirstChildElement(); at; at = at->NextSiblingElement()) {
    const std::string_view tag = at->Name();
    const int line = at->GetLineNum();
    if (tag.starts_with("xacro:")) {
      elements.refuse(line, "is a xacro file (it contains " + described(*at) +
                                "); run xacro first and pass the URDF that it writes");
    }
    if (tag == "link") {
      file.links.push_back({elements.needed_name(*at, "name"), line});
      const std::string& link = file.links.back().name;
      if (!links.insert(link).second) elements.refuse(line, "two links have the name " + link);
    } else if (tag == "joint") {
      file.joints.push_back(read_joint(elements, *at));
      const std::string& joint = file.joints.back().name;
      if (!joints.insert(joint).second) elements.refuse(line, "two joints have the name " + joint);
    }
  }
  return file;
}

}  // namespace beeline::internal
