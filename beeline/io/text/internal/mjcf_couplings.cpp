#include <algorithm>
#include <tinyxml2.h>
#include <unordered_map>
#include <unordered_set>

#include <beeline/error.h>
#include <beeline/io/text/internal/mjcf_file.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/model/internal/axis_direction.h>

namespace beeline::internal {
namespace {

using tinyxml2::XMLElement;

/// Reads the equality constraints of joints.
class MjcfCouplings {
 public:
  MjcfCouplings(MjcfModel& model, const std::vector<double>& refs)
      : model_(model), file_(model.file), refs_(refs) {
    for (std::size_t j = 0; j < file_.joints.size(); ++j) joints_.emplace(file_.joints[j].name, j);
  }

  void read(const XMLElement& element) {
    const MjcfAttributes attributes(element);
    refuse_misspelt_attribute(
        element, {"active", "class", "joint1", "joint2", "name", "polycoef", "solimp", "solref"});
    if (!is_active(element)) return;
    const std::size_t follower = joint_called(element, "joint1");
    UrdfFile::Joint& joint = file_.joints[follower];
    if (!coupled_.insert(follower).second) {
      attributes.refuse("joint1", "is " + in_quotes(joint.name) + ", which follows another joint");
    }
    joint.mimic_line = element.GetLineNum();
    const std::vector<double> c = attributes.some_numbers("polycoef", {0, 1, 0, 0, 0});
    if (attributes.source("joint2") == nullptr) {  // it is constant
      constant_.emplace(follower, refs_[follower] + c[0]);
      return;
    }
    const std::size_t leader = joint_called(element, "joint2");
    if (leader == follower) {
      attributes.refuse("joint2", "is " + in_quotes(joint.name) + ", as joint1 is");
    }
    const std::string& name = file_.joints[leader].name;
    if (c[2] != 0 || c[3] != 0 || c[4] != 0) return add_nonlinear(follower, name);
    // q1 - ref1 = c0 + c1 (q2 - ref2)
    joint.mimic = {.leader = name,
                   .multiplier = c[1],
                   .offset = refs_[follower] + c[0] - c[1] * refs_[leader]};
  }

  /// Records an active constraint of bodies, sites or tendons, which is not read.
  void ignore(const XMLElement& element) {
    if (!is_active(element)) return;
    UrdfFault fault{.warning = {.kind = ReadWarningKind::constraint_ignored,
                                .line = element.GetLineNum(),
                                .element = described(element)}};
    for (const char* const attribute :
         {"body1", "body2", "site1", "site2", "tendon1", "tendon2", "flex"}) {
      if (const char* const name = element.Attribute(attribute)) {
        fault.warning.others.push_back(printable(name));
      }
    }
    if (const char* const name = element.Attribute("name")) fault.warning.value = printable(name);
    file_.faults.push_back(std::move(fault));
  }

  /// Makes the constant joints fixed. A follower of one gets its value as offset.
  void fix_constant_joints() {
    for (UrdfFile::Joint& joint : file_.joints) {
      if (!joint.mimic) continue;
      const auto leader = constant_.find(joints_.at(joint.mimic->leader));
      if (leader != constant_.end())
        joint.mimic->offset += joint.mimic->multiplier * leader->second;
    }
    for (const auto& [index, value] : constant_) {
      UrdfFile::Joint& joint = file_.joints[index];
      if (!has_direction(joint.axis)) continue;  // it is a fault
      joint.origin = joint.origin * screw_motion(screw_of(joint), value);
      joint.type = "fixed";
      joint.limits = {};
    }
  }

 private:
  /// The attribute `active`, of the element or of the class of equality constraints.
  bool is_active(const XMLElement& element) const {
    const std::size_t of_class =
        model_.defaults.class_of(element, "class", MjcfDefaults::main_class);
    const auto inherited = model_.defaults.sources("equality", of_class, "active");
    const bool own = element.Attribute("active") != nullptr || inherited.empty();
    return MjcfAttributes(own ? element : *inherited.front().element)
               .choice("active", {"true", "false"}, "true") == "true";
  }

  std::size_t joint_called(const XMLElement& element, const char* attribute) const {
    const XmlElements& reader = MjcfDocument::reader_of(element);
    const std::string name = with_escaped_bytes(reader.needed_text(element, attribute));
    const auto found = joints_.find(name);
    if (found == joints_.end() || file_.joints[found->second].type == "fixed") {
      constexpr std::size_t most_compared = 10'000;
      std::vector<std::string> known;
      for (const UrdfFile::Joint& joint : file_.joints) {
        if (known.size() < most_compared && joint.type != "fixed") known.push_back(joint.name);
      }
      reader.refuse(element.GetLineNum(), std::string(attribute) + ": " +
                                              unknown_name("joint", printable(name), known).what());
    }
    if (!has_one_dof(file_.joints[found->second])) {
      reader.refuse(element.GetLineNum(), std::string(attribute) + " is " + in_quotes(name) +
                                              ", which is neither a hinge nor a slide joint");
    }
    return found->second;
  }

  void add_nonlinear(std::size_t follower, const std::string& leader) {
    file_.faults.push_back({.warning = {.kind = ReadWarningKind::nonlinear_coupling,
                                        .line = file_.joints[follower].mimic_line,
                                        .joint = file_.joints[follower].name,
                                        .value = leader},
                            .index = follower});
  }

  MjcfModel& model_;
  UrdfFile& file_;
  const std::vector<double>& refs_;
  std::unordered_map<std::string, std::size_t> joints_;
  std::unordered_set<std::size_t> coupled_;
  std::unordered_map<std::size_t, double> constant_;  ///< values of joints, by index
};

}  // namespace

void read_mjcf_couplings(MjcfModel& model, const std::vector<double>& refs) {
  MjcfCouplings couplings(model, refs);
  for (const XMLElement* at : model.document.in_sections("equality")) {
    std::string_view(at->Name()) == "joint" ? couplings.read(*at) : couplings.ignore(*at);
  }
  couplings.fix_constant_joints();
}

}  // namespace beeline::internal
