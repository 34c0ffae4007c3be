#include <algorithm>
#include <filesystem>
#include <tinyxml2.h>
#include <unordered_set>

#include <beeline/error.h>
#include <beeline/pose/orientation.h>
#include <beeline/read/internal/name.h>
#include <beeline/read/internal/numbers.h>
#include <beeline/read/internal/urdf_file.h>
#include <beeline/read/internal/xml.h>

namespace beeline::internal {
namespace {

using tinyxml2::XMLElement;

/// Reads elements of one file; every error names the file and the element's line.
class Elements {
 public:
  explicit Elements(const std::string& path) : path_(path) {}

  [[noreturn]] void refuse(int line, const std::string& message) const {
    throw FileError(path_, line, message);
  }

  std::string needed_text(const XMLElement& element, const char* attribute) const {
    const char* text = element.Attribute(attribute);
    if (text == nullptr) {
      refuse(element.GetLineNum(), described(element) + " needs the attribute " + attribute);
    }
    return text;
  }

  std::string needed_name(const XMLElement& element, const char* attribute) const {
    std::string name = needed_text(element, attribute);
    try {
      check_name(name, described(element) + ": " + attribute);
    } catch (const Error& error) {
      refuse(element.GetLineNum(), error.what());
    }
    return name;
  }

  /// Reads three numbers separated by blanks; returns `otherwise` when the attribute is missing.
  Vector3 vector(const XMLElement& element, const char* attribute, const Vector3& otherwise) const {
    const char* text = element.Attribute(attribute);
    if (text == nullptr) return otherwise;
    constexpr std::string_view blanks = " \t\r\n";
    std::string_view rest = text;
    std::vector<double> values;
    for (;;) {
      rest.remove_prefix(std::min(rest.size(), rest.find_first_not_of(blanks)));
      if (rest.empty()) break;
      const std::string_view item = rest.substr(0, rest.find_first_of(blanks));
      values.push_back(number(element, attribute, item));
      rest.remove_prefix(item.size());
    }
    if (values.size() != 3) {
      refuse(element.GetLineNum(), described(element) + ": " + attribute + " has " +
                                       std::to_string(values.size()) +
                                       " numbers; it must have three, as in \"0 0 1\"");
    }
    return {values[0], values[1], values[2]};
  }

  double number_or(const XMLElement& element, const char* attribute, double otherwise) const {
    const char* text = element.Attribute(attribute);
    return text == nullptr ? otherwise : number(element, attribute, text);
  }

  static std::string described(const XMLElement& element) {
    return "<" + printable(element.Name()) + ">";
  }

 private:
  double number(const XMLElement& element, const char* attribute, std::string_view text) const {
    try {
      return parse_number(text, described(element) + ": " + attribute);
    } catch (const Error& error) {
      const bool macro = text.find("${") != std::string_view::npos;
      refuse(element.GetLineNum(), std::string(error.what()) + (macro ? "; run xacro first" : ""));
    }
  }

  const std::string& path_;
};

Pose read_origin(const Elements& elements, const XMLElement& joint) {
  const XMLElement* origin = joint.FirstChildElement("origin");
  if (origin == nullptr) return Pose::Identity();
  const Vector3 rpy = elements.vector(*origin, "rpy", Vector3::Zero());
  return make_pose(elements.vector(*origin, "xyz", Vector3::Zero()),
                   rotation(RollPitchYaw{rpy.x(), rpy.y(), rpy.z()}));
}

/// A missing <limit> means no limit, although the format requires one; a missing lower or upper is
/// 0, as the format defines. Many files write velocity="0" for an unknown velocity limit.
Limits read_limits(const Elements& elements, const XMLElement& limit, bool continuous) {
  Limits limits;
  if (!continuous) {
    limits.lower = elements.number_or(limit, "lower", 0);
    limits.upper = elements.number_or(limit, "upper", 0);
  }
  const double velocity = elements.number_or(limit, "velocity", 0);
  if (velocity != 0) limits.velocity = velocity;
  return limits;
}

Mimic read_mimic(const Elements& elements, const XMLElement& mimic) {
  return {.leader = elements.needed_text(mimic, "joint"),
          .multiplier = elements.number_or(mimic, "multiplier", 1),
          .offset = elements.number_or(mimic, "offset", 0)};
}

std::string read_end(const Elements& elements, const XMLElement& joint, const char* end) {
  const XMLElement* element = joint.FirstChildElement(end);
  if (element == nullptr) {
    elements.refuse(joint.GetLineNum(), "joint " + in_quotes(joint.Attribute("name")) +
                                            " needs a <" + end + " link=...>");
  }
  return elements.needed_text(*element, "link");
}

UrdfFile::Joint read_joint(const Elements& elements, const XMLElement& element) {
  UrdfFile::Joint joint;
  joint.name = elements.needed_name(element, "name");
  joint.type = elements.needed_text(element, "type");
  joint.line = element.GetLineNum();
  joint.parent = read_end(elements, element, "parent");
  joint.child = read_end(elements, element, "child");
  joint.origin = read_origin(elements, element);
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
  const Elements elements(path);
  tinyxml2::XMLDocument document;
  parse_xml(document, text, path);
  const XMLElement* robot = document.RootElement();
  if (robot == nullptr || std::string_view(robot->Name()) != "robot") {
    const std::string found = robot == nullptr ? "nothing" : Elements::described(*robot);
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
      elements.refuse(line, "is a xacro file (it contains " + Elements::described(*at) +
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
