#include <unordered_set>

#include <beeline/error.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/urdf.h>

namespace beeline {
namespace {

[[noreturn]] void refuse_state(const Srdf& srdf, const Srdf::State& state,
                               const std::string& message) {
  const std::string of = state.group.empty() ? "" : " of group " + internal::printable(state.group);
  throw FileError(srdf.path, state.line, "state " + state.name + of + " " + message);
}

/// Returns the name of the first coordinate that the state has no value for; empty if there is
/// none.
std::string missing_joint(const Srdf::State& state, const Arm& arm) {
  for (const std::string& joint : arm.joint_names()) {
    if (!state.joints.contains(joint)) return joint;
  }
  return "";
}

Configuration configuration_of(const Srdf& srdf, const Srdf::State& state, const Arm& arm) {
  Configuration q(arm.dof());
  for (int k = 0; k < arm.dof(); ++k) {
    const std::vector<double>& values = state.joints.at(arm.joint_of(k).name);
    if (values.size() != 1) {
      refuse_state(srdf, state,
                   "has " + std::to_string(values.size()) + " values for joint " +
                       arm.joint_of(k).name + ", which takes one");
    }
    q[k] = values.front();
  }
  return q;
}

/// Returns the states with this name; of the group alone if it has one of the name.
std::vector<const Srdf::State*> states_called(const Srdf& srdf, const std::string& name,
                                              const std::string& group) {
  std::vector<const Srdf::State*> found, of_group;
  std::vector<std::string> names;
  std::unordered_set<std::string> known;
  for (const Srdf::State& state : srdf.states) {
    if (known.insert(state.name).second) names.push_back(state.name);
    if (state.name != name) continue;
    found.push_back(&state);
    if (state.group == group) of_group.push_back(&state);
  }
  if (found.empty()) {
    throw FileError(srdf.path, 0,
                    unknown_name("named state", internal::printable(name), names).what());
  }
  return of_group.empty() ? found : of_group;
}

}  // namespace

Configuration named_state(const Srdf& srdf, const Arm& arm, const std::string& name,
                          const std::string& group) {
  const std::vector<const Srdf::State*> states = states_called(srdf, name, group);
  const Srdf::State* selected = nullptr;
  for (const Srdf::State* state : states) {
    if (!missing_joint(*state, arm).empty()) continue;
    if (selected == nullptr) {
      selected = state;
    } else if (configuration_of(srdf, *state, arm) != configuration_of(srdf, *selected, arm)) {
      refuse_state(srdf, *state,
                   "has other values than in group " + internal::printable(selected->group) +
                       "; name the group");
    }
  }
  if (selected == nullptr) {
    refuse_state(srdf, *states.front(),
                 "has no value for joint " + missing_joint(*states.front(), arm));
  }
  return configuration_of(srdf, *selected, arm);
}

}  // namespace beeline
