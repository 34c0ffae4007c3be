#include <algorithm>
#include <set>
#include <utility>

#include <beeline/io/text/internal/joint_from_yaml.h>
#include <beeline/io/text/internal/limits_from_yaml.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/model/catalog.h>

namespace beeline::internal {
namespace {

class LimitsReader {
 public:
  LimitsReader(std::string_view text, const std::string& path, const Arm& arm)
      : path_(path), arm_(arm), root_(parse_yaml(text, path)), namings_(joint_namings(arm)) {}

  JointLimits read() {
    search(root_);
    const auto* joints = find_joints();
    for (const YamlMember& member : *joints) names_.insert(member.key);
    prefix_ = common_prefix();
    if (!prefix_.empty()) note("the prefix " + printable(prefix_) + " of joint names is left out");
    std::vector<std::string> others;
    for (const YamlMember& member : *joints) {
      const Joint* joint = find_joint(member.key);
      if (joint == nullptr) {
        others.push_back(printable(member.key));
      } else {
        const bool is_new = result_.joints.emplace(joint->name, overrides(member, *joint)).second;
        if (!is_new) {
          throw FileError(path_, member.line, "joint " + joint->name + " has limits twice");
        }
      }
    }
    if (result_.joints.empty()) {
      throw FileError(path_, limits_ == nullptr ? 0 : limits_->line,
                      "has no joint of arm " + arm_.name() + " (" + listed(joint_names()) +
                          "); its joints are " + (others.empty() ? "none" : listed(others)));
    }
    if (!others.empty()) note("arm " + arm_.name() + " does not have " + listed(others));
    for (const auto& [sentence, names] : joint_notes_) note(sentence + ": " + listed(names));
    return std::move(result_);
  }

 private:
  /// Finds the one member `joint_limits` below this value, and the scaling factors beside it.
  void search(const Yaml& yaml) {
    const auto* members = std::get_if<Yaml::Members>(&yaml.value);
    if (members == nullptr) return;
    for (const YamlMember& member : *members) {
      if (member.key == joint_limits_key) {
        if (limits_ != nullptr) {
          throw FileError(path_, member.line,
                          std::string(joint_limits_key) + " is given twice, here and in line " +
                              std::to_string(limits_->line));
        }
        limits_ = &member;
      } else if (member.key.starts_with("default_") && member.key.ends_with("_scaling_factor")) {
        const auto* factor = std::get_if<std::string>(&member.value.value);
        note(printable(member.key) + (factor == nullptr ? "" : " " + printable(*factor)) +
             " is not applied; set a speed scale instead");
      } else {
        search(member.value);
      }
    }
  }

  /// Returns the members of `joint_limits`, or else the members of the file if one of them has
  /// urdf_limits().
  const Yaml::Members* find_joints() const {
    if (limits_ != nullptr) {
      const auto* joints = std::get_if<Yaml::Members>(&limits_->value.value);
      if (joints != nullptr) return joints;
      throw FileError(
          path_, limits_->line,
          std::string(joint_limits_key) + " must be a map of joints, each with its limits");
    }
    const auto* joints = std::get_if<Yaml::Members>(&root_.value);
    if (joints != nullptr && std::any_of(joints->begin(), joints->end(), [](const auto& joint) {
          return urdf_limits(joint) != nullptr;
        })) {
      return joints;
    }
    throw FileError(path_, 0,
                    std::string("has no key ") + joint_limits_key +
                        "; below it each joint has limits, such as max_velocity: 2");
  }

  std::vector<std::string> joint_names() const {
    std::vector<std::string> names;
    for (const Joint& joint : arm_.joints()) names.push_back(joint.name);
    return names;
  }

  const Joint* joint_named(const std::string& name) const {
    const auto& joints = arm_.joints();
    const auto found = std::find_if(joints.begin(), joints.end(),
                                    [&](const Joint& known) { return known.name == name; });
    if (found != joints.end()) return &*found;
    for (const std::vector<std::string>& naming : namings_) {
      const auto called = std::find(naming.begin(), naming.end(), name);
      if (called != naming.end()) return &arm_.joint_of(called - naming.begin());
    }
    return nullptr;
  }

  /// The joint of the arm that the file calls `name`.
  const Joint* find_joint(const std::string& name) const {
    if (const Joint* joint = joint_named(name)) return joint;
    if (!prefix_.empty() && name.starts_with(prefix_)) {
      return joint_named(name.substr(prefix_.size()));
    }
    const std::string longer = name + "_joint";
    return names_.count(longer) == 0 ? joint_named(longer) : nullptr;
  }

  /// The only prefix with which the file has all joints of the arm, such as `panda_`; empty where
  /// there is none, or the file has a joint under the arm's own name.
  std::string common_prefix() const {
    std::vector<std::string> prefixes;
    const std::string ending = "_" + arm_.joints().front().name;
    for (const std::string& name : names_) {
      if (joint_named(name) != nullptr) return "";
      if (!name.ends_with(ending)) continue;
      const std::string prefix = name.substr(0, name.size() - ending.size() + 1);
      const auto& joints = arm_.joints();
      const bool all = std::all_of(joints.begin(), joints.end(), [&](const Joint& joint) {
        return names_.count(prefix + joint.name) == 1;
      });
      if (all) prefixes.push_back(prefix);
    }
    return prefixes.size() == 1 ? prefixes.front() : "";
  }

  void note(const std::string& sentence) { result_.notes.push_back(path_ + ": " + sentence); }

  /// Reads a joint; notes that several joints share become one.
  LimitOverrides overrides(const YamlMember& member, const Joint& joint) {
    std::vector<std::string> notes;
    LimitOverrides limits = limit_overrides_from_yaml(path_, member, joint, notes);
    for (const std::string& sentence : notes) {
      const auto known = std::find_if(joint_notes_.begin(), joint_notes_.end(),
                                      [&](const auto& other) { return other.first == sentence; });
      if (known != joint_notes_.end()) {
        known->second.push_back(joint.name);
      } else {
        joint_notes_.push_back({sentence, {joint.name}});
      }
    }
    return limits;
  }

  const std::string& path_;
  const Arm& arm_;
  Yaml root_;
  std::vector<std::vector<std::string>> namings_;  // of the arm's joints
  const YamlMember* limits_ = nullptr;
  std::set<std::string> names_;  // of the file's joints
  std::string prefix_;
  JointLimits result_;
  std::vector<std::pair<std::string, std::vector<std::string>>> joint_notes_;  // with their joints
};

}  // namespace

JointLimits limits_from_yaml(std::string_view text, const std::string& path, const Arm& arm) {
  return LimitsReader(text, path, arm).read();
}

}  // namespace beeline::internal
