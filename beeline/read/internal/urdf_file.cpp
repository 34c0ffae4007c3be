#include <filesystem>
#include <tinyxml2.h>
#include <unordered_set>

#include <beeline/error.h>
#include <beeline/pose/orientation.h>
#include <beeline/read/internal/limit_numbers.h>
#include <beeline/read/internal/name.h>
#include <beeline/read/internal/urdf_file.h>
#include <beeline/read/internal/xml.h>
#include <beeline/read/internal/xml_elements.h>

namespace beeline::internal {
namespace {

using tinyxml2::XMLElement;

bool is_xacro(const XMLElement& element) {
  return std::string_view(element.Name()).starts_with("xacro:");
}

void read_origin(const XmlElements& elements, const XMLElement& element, UrdfFile::Joint& joint) {
  const XMLElement* origin = element.FirstChildElement("origin");
  if (origin == nullptr) return;
  joint.rpy = elements.vector(*origin, "rpy", Vector3::Zero());
  joint.origin = make_pose(elements.vector(*origin, "xyz", Vector3::Zero()),
                           rotation(RollPitchYaw{joint.rpy.x(), joint.rpy.y(), joint.rpy.z()}));
}

/// A missing <limit> means no limit, although the format requires one; a missing lower or upper is
/// 0, as the format defines. Many files write velocity="0" for an unknown velocity limit, Isaac Sim
/// and Gazebo -1. Other numbers for no limit: see no_lower_limit().
Limits read_limits(const XmlElements& elements, const XMLElement& limit, bool continuous) {
  Limits limits;
  if (!continuous) {
    const double lower = elements.limit_or(limit, "lower", 0);
    const double upper = elements.limit_or(limit, "upper", 0);
    if (!no_lower_limit(lower)) limits.lower = lower;
    if (!no_upper_limit(upper)) limits.upper = upper;
  }
  const double velocity = elements.limit_or(limit, "velocity", 0);
  if (velocity != 0 && velocity != -1 && !no_rate_limit(velocity)) limits.velocity = velocity;
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

/// Reads what a tree of links needs.
UrdfFile::Joint read_connection(const XmlElements& elements, const XMLElement& element) {
  UrdfFile::Joint joint;
  joint.name = elements.needed_name(element, "name");
  joint.type = elements.needed_text(element, "type");
  joint.line = element.GetLineNum();
  joint.parent = read_end(elements, element, "parent");
  joint.child = read_end(elements, element, "child");
  return joint;
}

/// Reads the remainder of a joint.
void read_motion(const XmlElements& elements, const XMLElement& element, UrdfFile::Joint& joint) {
  for (const XMLElement* at = element.FirstChildElement(); at; at = at->NextSiblingElement()) {
    if (!is_xacro(*at)) continue;
    elements.refuse(at->GetLineNum(), "joint " + joint.name + " contains " + described(*at) +
                                          "; run xacro first and pass the URDF that it writes");
  }
  read_origin(elements, element, joint);
  if (!has_one_dof(joint)) return;  // many files give a fixed joint an axis of zeros
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
}

constexpr std::size_t max_faults = 10'000;  // bounds their memory

/// Reads the elements of a file. What cannot be read becomes a fault.
class Reader {
 public:
  explicit Reader(UrdfFile& file) : file_(file), elements_(file.path) {}

  void read(const XMLElement& element) {
    if (file_.faults.size() > max_faults) {
      elements_.refuse(element.GetLineNum(), "has more than 10,000 faults");
    }
    if (is_xacro(element)) return add_xacro(element);
    const std::string_view tag = element.Name();
    if (tag != "link" && tag != "joint") return;
    try {
      tag == "link" ? add_link(element) : add_joint(element);
    } catch (const XmlError& error) {  // without its ends a joint has no place in the tree
      const char* type = element.Attribute("type");
      const bool moves = tag == "joint" && (type == nullptr || std::string_view(type) != "fixed");
      file_.faults.push_back({.line = error.line, .clause = error.clause, .moves = moves});
    }
  }

 private:
  void add_xacro(const XMLElement& element) {
    file_.faults.push_back({.kind = ReadWarningKind::xacro_tag,
                            .line = element.GetLineNum(),
                            .element = described(element),
                            .clause = "is a xacro file (it contains " + described(element) +
                                      "); run xacro first and pass the URDF that it writes"});
  }

  void add_link(const XMLElement& element) {
    const std::string name = elements_.needed_name(element, "name");
    const int line = element.GetLineNum();
    if (links_.insert(name).second) {
      file_.links.push_back({name, line});
    } else {
      file_.faults.push_back({.kind = ReadWarningKind::repeated_name,
                              .line = line,
                              .link = name,
                              .clause = "two links have the name " + name});
    }
  }

  void add_joint(const XMLElement& element) {
    UrdfFile::Joint joint = read_connection(elements_, element);
    const std::size_t index = file_.joints.size();
    if (!joints_.insert(joint.name).second) {
      file_.faults.push_back({.kind = ReadWarningKind::repeated_name,
                              .line = joint.line,
                              .joint = joint.name,
                              .clause = "two joints have the name " + joint.name,
                              .index = index});
    }
    try {
      read_motion(elements_, element, joint);
    } catch (const XmlError& error) {
      file_.faults.push_back(
          {.line = error.line, .joint = joint.name, .clause = error.clause, .index = index});
    }
    file_.joints.push_back(std::move(joint));
  }

  UrdfFile& file_;
  const XmlElements elements_;
  std::unordered_set<std::string> links_, joints_;
};

}  // namespace

bool has_one_dof(const UrdfFile::Joint& joint) {
  return joint.type == "revolute" || joint.type == "continuous" || joint.type == "prismatic";
}

bool is_free(const UrdfFile::Joint& joint) {
  return joint.type == "floating" || joint.type == "planar";
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
  UrdfFile file{.path = path, .name = "", .links = {}, .joints = {}, .faults = {}};
  const char* name = robot->Attribute("name");
  file.name = name == nullptr || *name == 0 ? printable(std::filesystem::path(path).stem().string())
                                            : elements.needed_name(*robot, "name");
  Reader reader(file);
  for (const XMLElement* at = robot->FirstChildElement(); at; at = at->NextSiblingElement()) {
    reader.read(*at);
  }
  return file;
}

}  // namespace beeline::internal
