#include <algorithm>
#include <cmath>
#include <filesystem>
#include <tinyxml2.h>

#include <beeline/error.h>
#include <beeline/io/text/internal/limit_numbers.h>
#include <beeline/io/text/internal/mjcf_file.h>
#include <beeline/io/text/internal/mjcf_names.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/urdf_joint_faults.h>
#include <beeline/model/internal/axis_direction.h>

namespace beeline::internal {
namespace {

using tinyxml2::XMLElement;

/// Where an element stands.
struct MjcfPlace {
  std::size_t link = 0;           ///< in UrdfFile::links
  Pose frame = Pose::Identity();  ///< of the frames around the element, in that link
  std::size_t of_class = MjcfDefaults::main_class;
};

/// A joint's element and the pose, in its body, of the frames around it.
struct MjcfJoint {
  const XMLElement* element;
  MjcfPlace place;
};

bool is_tag(const XMLElement& element, std::string_view tag) { return element.Name() == tag; }

/// Reads the bodies.
class MjcfReader {
 public:
  explicit MjcfReader(MjcfModel& model)
      : model_(model), file_(model.file), names_(model.document) {}

  void read() {
    const XMLElement& root = model_.document.root();
    file_.path = model_.document.path();
    file_.is_mjcf = true;
    const char* const name = root.Attribute("model");
    file_.name = name == nullptr || *name == 0
                     ? printable(std::filesystem::path(file_.path).stem().string())
                     : MjcfDocument::reader_of(root).needed_name(root, "model");
    bool has_world = false;
    for (const XMLElement* at : model_.document.children(root)) {
      refuse_misspelt_tag(
          *at, {"compiler", "option", "size", "visual", "statistic", "default", "custom",
                "extension", "asset", "worldbody", "contact", "deformable", "equality", "tendon",
                "actuator", "sensor", "keyframe"});
      if (!is_tag(*at, "worldbody")) continue;
      if (!has_world) file_.links.push_back({.name = "world", .line = at->GetLineNum()});
      has_world = true;
      read_contents(*at, {}, true);
    }
    if (!has_world) throw FileError(file_.path, root.GetLineNum(), "has no <worldbody>");
    for (const auto& [element, place] : sites_) add_site(*element, place);
  }

  const std::vector<double>& refs() const { return refs_; }

 private:
  MjcfAttributes attributes_of(const XMLElement& element, const MjcfPlace& place) const {
    return {element, &model_.defaults, model_.defaults.class_of(element, "class", place.of_class)};
  }

  /// Refuses the attribute of geoms and sites that sets the pose of two ends.
  static void refuse_ends(const XMLElement& element) {
    if (element.Attribute("fromto") == nullptr) return;
    MjcfDocument::reader_of(element).refuse(
        element.GetLineNum(), described(element) + " has no attribute fromto, as in MuJoCo");
  }

  /// The place inside a <frame>.
  MjcfPlace inside(const XMLElement& frame, const MjcfPlace& place) const {
    refuse_misspelt_attribute(
        frame, {"name", "childclass", "pos", "quat", "axisangle", "xyaxes", "zaxis", "euler"});
    refuse_ends(frame);
    return {.link = place.link,
            .frame = place.frame * mjcf_pose(MjcfAttributes(frame), model_.settings),
            .of_class = model_.defaults.class_of(frame, "childclass", place.of_class)};
  }

  /// Reads what a body, a frame or the world contains, except joints.
  void read_contents(const XMLElement& parent, const MjcfPlace& place, bool in_world) {
    for (const XMLElement* at : model_.document.children(parent)) {
      refuse_misspelt_tag(
          *at, {"body", "frame", "joint", "freejoint", "geom", "site", "inertial", "camera",
                "light", "plugin", "replicate", "attach", "composite", "flexcomp"});
      if (is_tag(*at, "body")) {
        read_body(*at, place);
      } else if (is_tag(*at, "frame")) {
        read_contents(*at, inside(*at, place), in_world);
      } else if (is_tag(*at, "geom")) {
        model_.geoms.push_back(
            {at, model_.defaults.class_of(*at, "class", place.of_class), place.frame, place.link});
      } else if (is_tag(*at, "site")) {
        sites_.push_back({at, place});
      } else if (in_world && (is_tag(*at, "joint") || is_tag(*at, "freejoint"))) {
        refuse(*at, "is in the world, which has no joints");
      } else if (is_tag(*at, "replicate") || is_tag(*at, "attach") || is_tag(*at, "composite") ||
                 is_tag(*at, "flexcomp")) {
        refuse(*at,
               "is not supported; MuJoCo writes the model without it by "
               "mj_saveLastXML()");
      }
    }
  }

  [[noreturn]] static void refuse(const XMLElement& element, const std::string& message) {
    MjcfDocument::reader_of(element).refuse(element.GetLineNum(),
                                            described(element) + " " + message);
  }

  void read_body(const XMLElement& element, const MjcfPlace& place) {
    refuse_misspelt_attribute(
        element, {"axisangle", "childclass", "euler", "fuse", "gravcomp", "mocap", "name", "pos",
                  "quat", "simple", "sleep", "user", "xyaxes", "zaxis"});
    refuse_ends(element);
    const std::string index = std::to_string(++bodies_);
    std::string name = MjcfNames::given(element);
    if (name.empty()) name = names_.new_link("body" + index);
    const std::size_t of_class = model_.defaults.class_of(element, "childclass", place.of_class);
    const Pose pose = place.frame * mjcf_pose(MjcfAttributes(element), model_.settings);
    std::vector<MjcfJoint> joints;
    collect_joints(element, {.of_class = of_class}, joints);
    const std::string parent = file_.links[place.link].name;
    if (joints.empty()) {
      add(fixed_joint(element, "fixed " + name), parent, name, pose);
    } else if (joints.size() > 1) {
      model_.touching.push_back({parent, name});
    }
    std::string link = parent;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const bool last = i + 1 == joints.size();
      const std::string child = last ? name : names_.new_link(name + "." + std::to_string(i + 1));
      if (!last) file_.links.push_back({.name = child, .line = element.GetLineNum()});
      add(read_joint(joints[i]), link, child, i == 0 ? pose : Pose::Identity());
      link = child;
    }
    file_.links.push_back({.name = name, .line = element.GetLineNum()});
    read_contents(element, {.link = file_.links.size() - 1, .of_class = of_class}, false);
  }

  void collect_joints(const XMLElement& parent, const MjcfPlace& place,
                      std::vector<MjcfJoint>& joints) const {
    for (const XMLElement* at : model_.document.children(parent)) {
      if (is_tag(*at, "joint") || is_tag(*at, "freejoint")) joints.push_back({at, place});
      if (is_tag(*at, "frame")) collect_joints(*at, inside(*at, place), joints);
    }
  }

  /// Connects two links by a joint; `pose` is of its frame in the parent at `ref_`.
  void add(UrdfFile::Joint joint, const std::string& parent, const std::string& child,
           const Pose& pose) {
    joint.parent = parent;
    joint.child = child;
    joint.origin = pose;
    // A joint with a fault stays as it is, and is refused on the chain.
    if (ref_ != 0 && has_one_dof(joint) && has_direction(joint.axis)) {
      joint.origin = pose * screw_motion(screw_of(joint), -ref_);
    }
    refs_.push_back(std::exchange(ref_, 0));
    file_.joints.push_back(std::move(joint));
  }

  UrdfFile::Joint at_line(const XMLElement& element) const {
    const std::string& path = MjcfDocument::reader_of(element).path();
    UrdfFile::Joint joint;
    joint.line = joint.axis_line = joint.limit_line = joint.mimic_line = element.GetLineNum();
    if (path != file_.path) joint.included_from = path;
    return joint;
  }

  UrdfFile::Joint fixed_joint(const XMLElement& element, const std::string& name) {
    UrdfFile::Joint joint = at_line(element);
    joint.name = names_.new_joint(name);
    joint.type = "fixed";
    return joint;
  }

  UrdfFile::Joint read_joint(const MjcfJoint& read) {
    const XMLElement& element = *read.element;
    UrdfFile::Joint joint = at_line(element);
    joint.name = MjcfNames::given(element);
    if (joint.name.empty()) joint.name = names_.new_joint("joint" + std::to_string(moving_));
    ++moving_;
    joint.type = "floating";
    if (is_tag(element, "freejoint")) return joint;
    refuse_misspelt_attribute(element, {"actuatorfrclimited",
                                        "actuatorfrcrange",
                                        "actuatorgravcomp",
                                        "armature",
                                        "axis",
                                        "class",
                                        "damping",
                                        "frictionloss",
                                        "group",
                                        "limited",
                                        "margin",
                                        "name",
                                        "pos",
                                        "range",
                                        "ref",
                                        "solimpfriction",
                                        "solimplimit",
                                        "solreffriction",
                                        "solreflimit",
                                        "springdamper",
                                        "springref",
                                        "springyield",
                                        "stiffness",
                                        "type",
                                        "user"});
    const MjcfAttributes attributes = attributes_of(element, read.place);
    const std::string type = attributes.choice("type", {"free", "ball", "slide", "hinge"}, "hinge");
    if (type == "free") return joint;
    joint.type = type;
    if (type == "ball") return joint;
    const bool hinge = type == "hinge";
    joint.axis = read.place.frame.linear() * attributes.vector("axis", Vector3::UnitZ());
    joint.point = read.place.frame * attributes.vector("pos", Vector3::Zero());
    joint.axis_line = attributes.line_of("axis");
    joint.limit_line = attributes.line_of("range");
    const bool limited = read_range(attributes, hinge, joint);
    joint.type = !hinge ? "prismatic" : limited ? "revolute" : "continuous";
    const double ref = attributes.number_or("ref", 0);
    ref_ = hinge ? model_.settings.radians(ref) : ref;
    return joint;
  }

  /// Returns whether the joint is limited, and sets its position limits then. As in MuJoCo, a range
  /// whose lower limit is not below the upper one is none, unless the joint is said to be limited.
  bool read_range(const MjcfAttributes& attributes, bool hinge, UrdfFile::Joint& joint) {
    const std::string limited = attributes.choice("limited", {"true", "false", "auto"}, "auto");
    if (limited == "false") return false;
    std::vector<double> range = attributes.numbers("range", 2);
    const bool given = !range.empty() && (range[0] != 0 || range[1] != 0);
    if (limited == "auto" && given && !model_.settings.autolimits) {
      attributes.refuse("range", "is given without limited=\"true\", and autolimits is false");
    }
    if (limited == "auto" && !given) return false;
    if (limited == "auto" && range[0] >= range[1]) {
      file_.faults.push_back({.warning = {.kind = ReadWarningKind::range_ignored,
                                          .line = joint.limit_line,
                                          .joint = joint.name,
                                          .numbers = range},
                              .index = file_.joints.size()});
      return false;
    }
    if (!given || range[0] >= range[1]) {
      attributes.refuse("range",
                        "must have a lower and a greater upper limit, as the joint is "
                        "limited");
    }
    for (double& limit : range) limit = hinge ? model_.settings.radians(limit) : limit;
    if (!no_lower_limit(range[0])) joint.limits.lower = range[0];
    if (!no_upper_limit(range[1])) joint.limits.upper = range[1];
    return std::isfinite(joint.limits.lower) || std::isfinite(joint.limits.upper);
  }

  /// Adds a site as a link. One that has the name of a body gets another name.
  void add_site(const XMLElement& element, const MjcfPlace& place) {
    const std::string name = MjcfNames::given(element);
    if (name.empty()) return;
    if (!site_names_.insert(name).second) {
      MjcfDocument::reader_of(element).refuse(element.GetLineNum(),
                                              "two sites have the name " + name);
    }
    const Pose pose = place.frame * mjcf_pose(attributes_of(element, place), model_.settings);
    const std::string link = names_.new_link(name);
    add(fixed_joint(element, "fixed site " + name), file_.links[place.link].name, link, pose);
    file_.links.push_back({.name = link, .line = element.GetLineNum(), .site = true});
  }

  MjcfModel& model_;
  UrdfFile& file_;
  MjcfNames names_;
  std::vector<MjcfJoint> sites_;  ///< added at the end, so that bodies have their names first
  std::unordered_set<std::string> site_names_;
  std::vector<double> refs_;  ///< of each joint of the file
  double ref_ = 0;            ///< of the joint that is being read
  std::size_t bodies_ = 0, moving_ = 0;
};

}  // namespace

std::unique_ptr<const MjcfModel> read_mjcf(std::string_view text, const std::string& path) {
  auto model = std::make_unique<MjcfModel>(text, path);
  MjcfReader reader(*model);
  reader.read();
  read_mjcf_couplings(*model, reader.refs());
  find_joint_faults(model->file);
  return model;
}

}  // namespace beeline::internal
