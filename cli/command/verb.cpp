#include "verb.h"

#include <algorithm>
#include <map>

#include <beeline/error.h>

namespace beeline::command {

std::vector<Option> all_options(const Verb& verb) {
  std::vector<Option> options = verb.options;
  if (verb.json != nullptr && verb.verbs.empty()) {
    options.push_back(Option("--json",
                             "Print the answer as JSON, with its units. Numbers read back exactly.",
                             verb.json.get()));
  }
  options.push_back(Option("--help", "Print this help.", Target(), {.alias = "-h"}));
  return options;
}

namespace {

bool is_set(const Verb& verb, const std::string& flag) {
  return std::any_of(verb.options.begin(), verb.options.end(), [&](const Option& option) {
    return option.name == flag && *std::get<bool*>(option.target);
  });
}

/// The verb that does what other programs call by this name, such as `fk` for Robotics Toolbox's
/// fkine; empty if there is none.
std::string verb_of_other_programs(const std::string& name) {
  static const std::map<std::string, std::string> verbs{
      {"fkine", "fk"},    {"forward", "fk"},      {"kinematics", "fk"},  {"ikine", "ik"},
      {"inverse", "ik"},  {"jacob0", "jacobian"}, {"jtraj", "move"},     {"ctraj", "line"},
      {"plan", "line"},   {"verify", "check"},    {"validate", "check"}, {"compare", "diff"},
      {"play", "replay"}, {"convert", "export"},  {"plot", "draw"},      {"teach", "view"},
      {"list", "arms"},   {"info", "show"},       {"workspace", "reach"}};
  const auto found = verbs.find(name);
  return found == verbs.end() ? "" : found->second;
}

/// Refuses a verb that builds without a library lack.
void refuse_missing(const std::string& name) {
  const std::pair<const char*, const char*> optional[] = {{"reach", "HDF5 (BEELINE_HDF5)"},
                                                          {"view", "cpp-httplib (BEELINE_VIEW)"}};
  for (const auto& [verb, library] : optional) {
    if (name != verb) continue;
    throw Error("the verb " + name + " is not in this build, which is without " + library +
                ", as pip's is; `make build` has it");
  }
}

}  // namespace

Json with_units(const Verb& verb, const Answer& answer) {
  Json document = answer.document;
  const bool has_units =
      std::any_of(verb.options.begin(), verb.options.end(),
                  [](const Option& option) { return option.name == "--degrees"; });
  if (!has_units) return document;
  Json units{{"length", "m"}, {"angle", is_set(verb, "--degrees") ? "deg" : "rad"}, {"time", "s"}};
  if (is_set(verb, "--millimetres")) units.add("position", "mm");
  units.add(answer.units);
  document.add("units", units);
  return document;
}

std::string usage(const Verb& verb, const std::string& command) {
  std::string text = command;
  if (!verb.verbs.empty()) return text + " VERB [options]";
  for (const Positional& argument : verb.arguments) {
    const std::string name = argument.name + (argument.targets == nullptr ? "" : "...");
    text += argument.required ? " " + name : " [" + name + "]";
  }
  bool optional = false;
  for (const Option& option : verb.options) {
    if (option.required) text += " " + option.name + " " + option.value;
    optional = optional || !option.required;
  }
  return optional ? text + " [options]" : text;
}

const Verb& find_verb(const std::vector<Verb>& verbs, const std::string& name) {
  std::vector<std::string> names;
  for (const Verb& verb : verbs) {
    if (verb.name == name) return verb;
    names.push_back(verb.name);
  }
  const std::string meant = verb_of_other_programs(name);
  if (std::find(names.begin(), names.end(), meant) != names.end()) {
    throw Error("unknown verb \"" + name + "\"; did you mean \"" + meant +
                "\"? (known: " + listed(names) + ")");
  }
  refuse_missing(name);
  throw unknown_name("verb", name, names);
}

}  // namespace beeline::command
