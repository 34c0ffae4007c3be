#include "former_names.h"

#include <algorithm>
#include <map>

#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/internal/file.h>
#include <beeline/model/catalog.h>

std::string current_option_name(const std::string& name) {
  static const std::map<std::string, std::string> renamed{{"--law", "--profile"},
                                                          {"--round", "--blend"},
                                                          {"--most-samples", "--max-samples"},
                                                          {"--most-steps", "--max-steps"},
                                                          {"--iterations", "--max-iterations"},
                                                          {"--restarts", "--max-restarts"},
                                                          {"--speed-limit", "--speed"}};
  const auto found = renamed.find(name);
  return found == renamed.end() ? "" : found->second;
}

std::string current_verb_name(const std::string& name) { return name == "time" ? "retime" : ""; }

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

namespace {

/// Whether a text typed for a trajectory can only be an arm; a .json file may be either.
bool is_arm(const std::string& text) {
  const std::string ending = beeline::internal::extension(text);
  if (ending == "urdf" || ending == "xml") return true;
  const std::vector<std::string> built_in = beeline::built_in_names();
  return beeline::is_joint_string(text) ||
         std::find(built_in.begin(), built_in.end(), text) != built_in.end();
}

}  // namespace

void refuse_former_order(const Verb& verb) {
  if (verb.arguments.size() < 2 || verb.arguments.front().completes != Completes::arm) return;
  if (verb.arguments.back().completes == Completes::arm) return;  // two arms have no order
  if (verb.arguments.back().targets != nullptr) return;
  const std::string& first = *verb.arguments.front().target;
  const std::string& last = *verb.arguments.back().target;
  const std::string format = beeline::internal::extension(first);
  if (last.empty() || !(format == "csv" || (format == "json" && is_arm(last)))) return;
  std::string order = verb.name;
  for (const Positional& argument : verb.arguments) order += " " + argument.name;
  throw beeline::Error("the arm comes first, before the file: beeline " + order + ", not " + first +
                       " " + last);
}
