#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <tinyxml2.h>
#include <unordered_set>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/internal/utf8.h>
#include <beeline/io/text/internal/limit_numbers.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/urdf_file.h>
#include <beeline/io/text/internal/urdf_joint_faults.h>
#include <beeline/io/text/internal/xml.h>
#include <beeline/io/text/internal/xml_elements.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {
namespace {

using tinyxml2::XMLElement;

bool is_xacro(const XMLElement& element) {
  return std::string_view(element.Name()).starts_with("xacro:");
}

/// Refuses an element whose values stand elsewhere than in the attributes that are read, as in
/// `<axis>0 0 1</axis>` or `<axis x="0" y="0" z="1"/>`. An empty one has the defaults.
void check_attributes(const XmlElements& elements, const XMLElement& element,
                      std::initializer_list<const char*> known) {
  const bool written = std::any_of(known.begin(), known.end(), [&](const char* attribute) {
    return element.Attribute(attribute) != nullptr;
  });
  const bool empty = element.FirstAttribute() == nullptr &&
                     element.FirstChildElement() == nullptr && element.GetText() == nullptr;
  if (!written && !empty) {
    elements.refuse(element, *known.begin(), ElementFault::missing_attribute);
  }
}

/// The orientation of an origin: rpy, or the quaternion of URDF 1.2. Both are refused.
Rotation read_orientation(const XmlElements& elements, const XMLElement& origin,
                          UrdfFile::Joint& joint) {
  constexpr const char* quaternion = "quat_xyzw";
  joint.rpy = elements.vector(origin, "rpy", Vector3::Zero());
  const char* text = origin.Attribute(quaternion);
  if (text == nullptr) return rotation(RollPitchYaw{joint.rpy.x(), joint.rpy.y(), joint.rpy.z()});
  if (origin.Attribute("rpy") != nullptr) {
    elements.refuse(origin, quaternion, ElementFault::two_orientations);
  }
  const std::vector<double> q = elements.numbers(origin, quaternion);
  if (q.size() != 4) {
    throw XmlError({.path = elements.path(),
                    .line = origin.GetLineNum(),
                    .element = described(origin),
                    .element_fault = ElementFault::not_four_numbers,
                    .attribute = quaternion,
                    .count = q.size()});
  }
  try {
    return rotation_from_quaternion(q[3], q[0], q[1], q[2]);
  } catch (const Error&) {
    elements.refuse(origin, quaternion, ElementFault::not_unit_length, text);
  }
}

void read_origin(const XmlElements& elements, const XMLElement& element, UrdfFile::Joint& joint) {
  const XMLElement* origin = element.FirstChildElement("origin");
  if (origin == nullptr) return;
  check_attributes(elements, *origin, {"xyz", "rpy", "quat_xyzw"});
  const Vector3 position = elements.vector(*origin, "xyz", Vector3::Zero());
  joint.origin = make_pose(position, read_orientation(elements, *origin, joint));
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
  return {.leader = with_escaped_bytes(elements.needed_text(mimic, "joint")),
          .multiplier = elements.number_or(mimic, "multiplier", 1),
          .offset = elements.number_or(mimic, "offset", 0)};
}

/// The name in UTF-8 of the link that the joint connects.
std::string read_end(const XmlElements& elements, const XMLElement& joint, const char* end) {
  const XMLElement* element = joint.FirstChildElement(end);
  if (element == nullptr) {
    throw XmlError({.path = elements.path(),
                    .line = joint.GetLineNum(),
                    .joint = with_escaped_bytes(elements.needed_text(joint, "name")),
                    .element = "<" + std::string(end) + ">",
                    .element_fault = ElementFault::missing_end});
  }
  return with_escaped_bytes(elements.needed_text(*element, "link"));
}

/// Reads the joint's motion and origin.
void read_motion(const XmlElements& elements, const XMLElement& element, UrdfFile::Joint& joint) {
  read_origin(elements, element, joint);
  if (!has_one_dof(joint)) return;  // many files give a fixed joint an axis of zeros
  if (const XMLElement* axis = element.FirstChildElement("axis")) {
    check_attributes(elements, *axis, {"xyz"});
    joint.axis = elements.vector(*axis, "xyz", Vector3::UnitX());
    joint.axis_line = axis->GetLineNum();
  }
  if (const XMLElement* limit = element.FirstChildElement("limit")) {
    check_attributes(elements, *limit, {"lower", "upper", "velocity", "effort"});
    joint.limits = read_limits(elements, *limit, joint.type == "continuous");
    joint.limit_line = limit->GetLineNum();
  }
  if (const XMLElement* mimic = element.FirstChildElement("mimic")) {
    joint.mimic = read_mimic(elements, *mimic);
    joint.mimic_line = mimic->GetLineNum();
  }
}

constexpr std::size_t max_faults = 10'000;  // bounds the memory of those without a name

/// Reads the elements of a file. What cannot be read becomes a fault.
class Reader {
 public:
  explicit Reader(UrdfFile& file) : file_(file), elements_(file.path) {}

  void read(const XMLElement& element) {
    if (is_xacro(element)) return add(xacro_fault(element));
    const std::string_view tag = element.Name();
    if (tag != "link" && tag != "joint") return;
    try {
      tag == "link" ? add_link(element) : add_joint(element);
    } catch (const XmlError& error) {  // without its ends a joint has no place in the tree
      const char* type = element.Attribute("type");
      const bool moves = tag == "joint" && (type == nullptr || std::string_view(type) != "fixed");
      add({.warning = error.fault, .moves = moves});
    }
  }

 private:
  static UrdfFault xacro_fault(const XMLElement& element) {
    return {.warning = {.kind = ReadWarningKind::xacro_tag,
                        .line = element.GetLineNum(),
                        .element = described(element)}};
  }

  /// Beyond max_faults one that no chain can have, and that changes no answer, is only counted.
  void add(UrdfFault fault) {
    fault.warning.path.clear();  // all have the same
    const bool on_chain = fault.index || !fault.warning.link.empty();
    const bool first_move = fault.moves && !moves_;
    moves_ = moves_ || fault.moves;
    if (file_.faults.size() < max_faults || on_chain || first_move) {
      file_.faults.push_back(std::move(fault));
    } else {
      ++file_.further_faults;
    }
  }

  /// Returns the name in UTF-8. Another encoding is a fault of the link or the joint of that name.
  std::string read_name(const XMLElement& element, std::optional<std::size_t> joint) {
    const std::string bytes = elements_.needed_text(element, "name");
    const std::string name = elements_.checked_name(element, "name", with_escaped_bytes(bytes));
    if (is_utf8(bytes)) return name;
    ReadWarning warning{.line = element.GetLineNum(),
                        .element = described(element),
                        .element_fault = ElementFault::not_utf8,
                        .attribute = "name",
                        .value = name};
    (joint ? warning.joint : warning.link) = name;
    add({.warning = std::move(warning), .index = joint});
    return name;
  }

  void add_link(const XMLElement& element) {
    const std::string name = read_name(element, std::nullopt);
    const int line = element.GetLineNum();
    if (links_.insert(name).second) {
      file_.links.push_back({name, line});
    } else if (repeated_.insert(name).second || file_.faults.size() < max_faults) {
      add({.warning = {.kind = ReadWarningKind::repeated_name, .line = line, .link = name}});
    } else {
      ++file_.further_faults;
    }
  }

  void add_joint(const XMLElement& element) {
    const std::size_t index = file_.joints.size();
    UrdfFile::Joint joint;
    joint.line = element.GetLineNum();
    elements_.needed_text(element, "name");  // a joint without a name is no fault of its ends
    joint.type = elements_.needed_text(element, "type");
    joint.parent = read_end(elements_, element, "parent");
    joint.child = read_end(elements_, element, "child");
    joint.name = read_name(element, index);
    if (!joints_.insert(joint.name).second) {
      add({.warning = {.kind = ReadWarningKind::repeated_name,
                       .line = joint.line,
                       .joint = joint.name},
           .index = index});
    }
    read_remainder(element, joint, index);
    file_.joints.push_back(std::move(joint));
  }

  /// Reads the properties of a joint besides its place in the tree.
  void read_remainder(const XMLElement& element, UrdfFile::Joint& joint, std::size_t index) {
    for (const XMLElement* at = element.FirstChildElement(); at; at = at->NextSiblingElement()) {
      if (!is_xacro(*at)) continue;
      UrdfFault fault = xacro_fault(*at);
      fault.warning.joint = joint.name;
      fault.index = index;
      return add(std::move(fault));
    }
    try {
      read_motion(elements_, element, joint);
    } catch (const XmlError& error) {
      UrdfFault fault{.warning = error.fault, .index = index};
      fault.warning.joint = joint.name;
      add(std::move(fault));
    }
  }

  UrdfFile& file_;
  const XmlElements elements_;
  std::unordered_set<std::string> links_, joints_, repeated_;
  bool moves_ = false;  ///< a fault that moves has been added
};

/// Refuses a file without links whose links are spelled otherwise, as in `<Link>` or `<u:link>`, or
/// are inside another element than `<robot>`.
void refuse_misplaced_links(const XmlElements& elements, const XMLElement& robot) {
  std::vector<const XMLElement*> pending{&robot};
  while (!pending.empty()) {
    const XMLElement* const parent = pending.back();
    pending.pop_back();
    for (const XMLElement* at = parent->FirstChildElement(); at; at = at->NextSiblingElement()) {
      const std::string tag = lower_case(at->Name());
      if (tag == "link" || tag.ends_with(":link")) {
        elements.refuse(at->GetLineNum(), "has no <link> directly in <robot>, but " +
                                              described(*at) + " in " + described(*parent));
      }
      pending.push_back(at);
    }
  }
}

}  // namespace

bool has_one_dof(const UrdfFile::Joint& joint) {
  return joint.type == "revolute" || joint.type == "continuous" || joint.type == "prismatic";
}

bool is_free(const UrdfFile::Joint& joint) {
  return joint.type == "floating" || joint.type == "planar";
}

const std::vector<std::string>& urdf_joint_types() {
  static const std::vector<std::string> types{"fixed",     "revolute", "continuous",
                                              "prismatic", "planar",   "floating"};
  return types;
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
  if (file.links.empty() && file.faults.empty()) refuse_misplaced_links(elements, *robot);
  find_joint_faults(file);
  return file;
}

}  // namespace beeline::internal
