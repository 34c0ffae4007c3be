#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <tinyxml2.h>
#include <unordered_set>
#include <utility>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/internal/nearest_name.h>
#include <beeline/internal/utf8.h>
#include <beeline/io/text/internal/limit_numbers.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/urdf_file.h>
#include <beeline/io/text/internal/urdf_ignored.h>
#include <beeline/io/text/internal/urdf_joint_faults.h>
#include <beeline/io/text/internal/urdf_origin.h>
#include <beeline/io/text/internal/xml.h>
#include <beeline/io/text/internal/xml_elements.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {
namespace {

using tinyxml2::XMLElement;

bool is_xacro(const XMLElement& element) {
  return std::string_view(element.Name()).starts_with("xacro:");
}

/// The limit of a rate. Many files write 0 for an unknown limit, Isaac Sim and Gazebo -1.
double read_rate(const XmlElements& elements, const XMLElement& limit, const char* attribute) {
  const double rate = elements.limit_or(limit, attribute, 0);
  return rate == 0 || rate == -1 || no_rate_limit(rate) ? Limits::none : rate;
}

/// A missing <limit> means no limit, although the format requires one; a missing lower or upper is
/// 0, as the format defines. Other numbers for no limit: see no_lower_limit(). Acceleration,
/// deceleration and jerk are extensions; the smaller of the first two bounds both directions.
Limits read_limits(const XmlElements& elements, const XMLElement& limit, bool continuous) {
  Limits limits;
  if (!continuous) {
    const double lower = elements.limit_or(limit, "lower", 0);
    const double upper = elements.limit_or(limit, "upper", 0);
    if (!no_lower_limit(lower)) limits.lower = lower;
    if (!no_upper_limit(upper)) limits.upper = upper;
  }
  limits.velocity = read_rate(elements, limit, "velocity");
  limits.acceleration = std::min(read_rate(elements, limit, "acceleration"),
                                 std::abs(read_rate(elements, limit, "deceleration")));
  limits.jerk = read_rate(elements, limit, "jerk");
  return limits;
}

Mimic read_mimic(const XmlElements& elements, const XMLElement& mimic) {
  return {.leader = with_escaped_bytes(elements.needed_text(mimic, "joint")),
          .multiplier = elements.number_or(mimic, "multiplier", 1),
          .offset = elements.number_or(mimic, "offset", 0)};
}

/// The tag of an element of the joint that is nearly of this name; empty if there is none.
std::string element_like(const XMLElement& joint, const std::string& name) {
  for (const XMLElement* at = joint.FirstChildElement(); at; at = at->NextSiblingElement()) {
    if (nearest_name(at->Name(), {name}) != nullptr) return described(*at);
  }
  return "";
}

/// The name in UTF-8 of the link that the joint connects.
std::string read_end(const XmlElements& elements, const XMLElement& joint, const char* end) {
  const XMLElement* element = joint.FirstChildElement(end);
  if (element == nullptr) {
    throw XmlError({.path = elements.path(),
                    .line = joint.GetLineNum(),
                    .joint = with_escaped_bytes(elements.needed_text(joint, "name")),
                    .element = "<" + std::string(end) + ">",
                    .element_fault = ElementFault::missing_end,
                    .value = element_like(joint, end)});
  }
  return with_escaped_bytes(elements.needed_text(*element, "link"));
}

/// Reads the joint's motion and origin.
void read_motion(const XmlElements& elements, const XMLElement& element, UrdfFile::Joint& joint) {
  const UrdfOrigin origin = read_origin(elements, element);
  joint.origin = origin.pose;
  joint.rpy = origin.rpy;
  if (!has_one_dof(joint)) return;  // many files give a fixed joint an axis of zeros
  if (const XMLElement* axis = element.FirstChildElement("axis")) {
    check_attributes(elements, *axis, {"xyz"});
    joint.axis = elements.vector(*axis, "xyz", Vector3::UnitX());
    joint.axis_line = axis->GetLineNum();
  }
  if (const XMLElement* limit = element.FirstChildElement("limit")) {
    check_attributes(
        elements, *limit,
        {"lower", "upper", "velocity", "effort", "acceleration", "deceleration", "jerk"});
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
    if (tag != "link" && tag != "joint") {
      if (misspelt_part(element)) add(misspelt_fault(element));
      return;
    }
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

  static UrdfFault misspelt_fault(const XMLElement& element) {
    const char* type = element.Attribute("type");
    return {.warning = {.kind = ReadWarningKind::unknown_element,
                        .line = element.GetLineNum(),
                        .element = described(element)},
            .moves = type != nullptr && std::string_view(type) != "fixed"};
  }

  /// Adds what the joint has that is not read. The same of further joints is counted.
  void add_ignored(const XMLElement& element, const UrdfFile::Joint& joint, std::size_t index) {
    for (ReadWarning& warning : ignored_parts(element, has_one_dof(joint))) {
      const bool own = warning.kind == ReadWarningKind::repeated_element;
      const auto [known, first] =
          own ? std::pair(ignored_.end(), true)
              : ignored_.try_emplace({warning.element, warning.attribute}, file_.faults.size());
      if (!first) {
        ReadWarning& before = file_.faults[known->second].warning;
        if (before.joint != joint.name) ++before.count;
        continue;
      }
      warning.joint = joint.name;
      add({.warning = std::move(warning), .index = index});
    }
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
    add_ignored(element, joint, index);
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
  std::map<std::pair<std::string, std::string>, std::size_t> ignored_;  ///< names to the fault
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

Twist screw_of(const UrdfFile::Joint& joint) {
  return joint.type == "prismatic" ? translation_screw(joint.axis)
                                   : rotation_screw(joint.axis, joint.point);
}

const std::string& path_of(const UrdfFile& file, const UrdfFile::Joint& joint) {
  return joint.included_from.empty() ? file.path : joint.included_from;
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
    const bool is_part = robot != nullptr && std::string_view(robot->Name()) == "mujocoinclude";
    elements.refuse(robot == nullptr ? 0 : robot->GetLineNum(),
                    is_part ? "is a part of an MJCF model; pass the model that includes it"
                            : "is not URDF: its root must be <robot>, not " + found);
  }
  UrdfFile file{.path = path, .name = "", .links = {}, .joints = {}, .faults = {}};
  const char* name = robot->Attribute("name");
  file.name = name == nullptr || *name == 0 ? printable(std::filesystem::path(path).stem().string())
                                            : elements.needed_name(*robot, "name");
  Reader reader(file);
  for (const XMLElement* at = robot->FirstChildElement(); at; at = at->NextSiblingElement()) {
    reader.read(*at);
  }
  const bool unexplained =
      std::all_of(file.faults.begin(), file.faults.end(),
                  [](const UrdfFault& fault) { return is_ignored(fault.warning.kind); });
  if (file.links.empty() && unexplained) refuse_misplaced_links(elements, *robot);
  find_joint_faults(file);
  return file;
}

}  // namespace beeline::internal
