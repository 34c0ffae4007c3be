#include <algorithm>

#include <beeline/error.h>
#include <beeline/io/text/internal/urdf_fault.h>
#include <beeline/io/text/internal/urdf_held_joints.h>

namespace beeline::internal {

HeldJoints::HeldJoints(const UrdfFile& file, const std::vector<ChainJoint>& chain,
                       const std::map<std::string, double>& hold,
                       std::span<const Srdf::State> states)
    : file_(file),
      hold_(hold),
      states_(states),
      on_chain_(file.joints.size()),
      has_chain_(!chain.empty()) {
  for (std::size_t j = 0; j < file.joints.size(); ++j) joints_.emplace(file.joints[j].name, j);
  for (const ChainJoint& place : chain) on_chain_[place.index] = true;
  resolve_leaders();
  for (const ChainJoint& place : chain) {
    const bool moves = file.joints[place.index].type != "fixed";
    if (moves) driving_.insert(leaders_[place.index]->index);
  }
  check_hold();
}

/// Finds the leader of each joint. Leaders that lead each other end at one of them.
void HeldJoints::resolve_leaders() {
  leaders_.resize(file_.joints.size());
  std::vector<bool> is_pending(file_.joints.size());
  std::vector<std::size_t> pending;
  for (std::size_t j = 0; j < file_.joints.size(); ++j) {
    std::size_t at = j;
    while (!leaders_[at] && !is_pending[at]) {
      is_pending[at] = true;
      pending.push_back(at);
      const auto found =
          file_.joints[at].mimic ? joints_.find(file_.joints[at].mimic->leader) : joints_.end();
      if (found == joints_.end()) break;
      at = found->second;
    }
    while (!pending.empty()) {
      const std::size_t follower = pending.back();
      pending.pop_back();
      const std::optional<Leader> leader = follower == at ? std::nullopt : leaders_[at];
      leaders_[follower] = {.index = follower};
      if (leader) {
        const Mimic& mimic = *file_.joints[follower].mimic;
        leaders_[follower] = {leader->index, mimic.multiplier * leader->multiplier,
                              mimic.multiplier * leader->offset + mimic.offset};
      }
      at = follower;
    }
  }
}

void HeldJoints::check_hold() const {
  for (const auto& [name, value] : hold_) {
    const auto found = joints_.find(name);
    const bool beside = found != joints_.end() && !on_chain_[found->second];
    if (!beside || !has_one_dof(file_.joints[found->second])) throw unknown_hold(name);
    const UrdfFile::Joint& joint = file_.joints[found->second];
    if (joint.mimic) {
      throw Error::of(
          "hold", "joint " + name + " follows joint " + joint.mimic->leader + "; hold that one");
    }
    const Limits& limits = joint.limits;
    if (within_position_limits(limits, value) || limits.lower > limits.upper) continue;
    throw Error::of("hold", "joint " + name + " at " + number(value) + " is outside its limits " +
                                number(limits.lower) + " to " + number(limits.upper));
  }
}

Error HeldJoints::unknown_hold(const std::string& name) const {
  std::vector<std::string> known;
  for (std::size_t j = 0; j < file_.joints.size(); ++j) {
    const UrdfFile::Joint& joint = file_.joints[j];
    if (!on_chain_[j] && has_one_dof(joint) && !joint.mimic) known.push_back(joint.name);
  }
  const std::string joint = has_chain_ ? "joint beside the chain" : "joint";
  return Error::of("hold", known.empty() ? "no " + joint + " moves, so " + name + " cannot be held"
                                         : unknown_name(joint, name, known).what());
}

const Srdf::State* HeldJoints::state_for(const UrdfFile::Joint& joint) const {
  if (hold_.contains(joint.name) || !has_one_dof(joint)) return nullptr;
  for (const Srdf::State& state : states_) {
    const auto found = state.joints.find(joint.name);
    if (found == state.joints.end() || found->second.size() != 1) continue;
    if (within_position_limits(joint.limits, found->second.front())) return &state;
  }
  return nullptr;
}

std::string HeldJoints::state_of(std::size_t joint) const {
  if (!has_one_dof(file_.joints[joint])) return "";
  const Srdf::State* const state = state_for(file_.joints[leaders_[joint]->index]);
  return state == nullptr ? "" : state->name;
}

double HeldJoints::value(std::size_t joint) const {
  const Leader& leader = *leaders_[joint];
  const UrdfFile::Joint& leading = file_.joints[leader.index];
  const auto given = hold_.find(leading.name);
  const Limits& limits = leading.limits;
  const Srdf::State* const state = state_for(leading);
  const double value = given != hold_.end()           ? given->second
                       : state != nullptr             ? state->joints.at(leading.name).front()
                       : limits.lower <= limits.upper ? std::clamp(0.0, limits.lower, limits.upper)
                                                      : 0.0;
  return leader.multiplier * value + leader.offset;
}

Pose HeldJoints::pose(std::size_t index) const {
  const UrdfFile::Joint& joint = file_.joints[index];
  if (!has_one_dof(joint)) return joint.origin;
  const double held = value(index);
  if (held == 0) return joint.origin;
  return joint.origin * screw_motion(screw_of(joint), held);
}

void HeldJoints::add_held(std::size_t index, const std::string& link,
                          std::map<std::string, double>& held) const {
  const UrdfFile::Joint& joint = file_.joints[index];
  if (joint.type == "fixed") return;
  const std::vector<std::string>& types = urdf_joint_types();
  if (!file_.is_mjcf && std::find(types.begin(), types.end(), joint.type) == types.end()) {
    throw FileError(file_.path, joint.line,
                    "joint " + joint.name + " is " + joint.type +
                        ", which is not a type of URDF, and it carries the shape of link " + link);
  }
  for (const UrdfFault& fault : file_.faults) {
    if (fault.index != index || fault.warning.kind != ReadWarningKind::nonlinear_coupling) continue;
    throw error_of(file_, fault, "; it carries the shape of link " + link);
  }
  const std::size_t leader = leaders_[index]->index;
  if (driving_.contains(leader)) {
    throw FileError(path_of(file_, joint), joint.line,
                    "joint " + joint.name + ", which carries the shape of link " + link +
                        ", is beside the chain and moves with it, by joint " +
                        file_.joints[leader].name + "; such a link cannot be placed");
  }
  held[joint.name] = has_one_dof(joint) ? value(index) : 0;
}

void HeldJoints::add_leader(std::size_t joint, std::map<std::string, double>& leaders) const {
  const std::size_t leader = leaders_[joint]->index;
  const UrdfFile::Joint& leading = file_.joints[leader];
  if (has_one_dof(leading) && !on_chain_[leader]) leaders[leading.name] = value(leader);
}

}  // namespace beeline::internal
