#include "former_names.h"

#include <algorithm>
#include <map>

#include <beeline/error.h>
#include <beeline/read/internal/file.h>

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

void refuse_former_order(const Verb& verb) {
  if (verb.arguments.size() < 2 || verb.arguments.front().completes != Completes::arm) return;
  if (verb.arguments.back().targets != nullptr) return;
  const std::string& first = *verb.arguments.front().target;
  const std::string& last = *verb.arguments.back().target;
  const auto is_trajectory = [](const std::string& text) {
    const std::string format = beeline::internal::extension(text);
    return format == "csv" || format == "json";
  };
  const bool csv_first = beeline::internal::extension(first) == "csv";
  if (last.empty() || !(csv_first || (is_trajectory(first) && !is_trajectory(last)))) return;
  std::string order = verb.name;
  for (const Positional& argument : verb.arguments) order += " " + argument.name;
  throw beeline::Error("the arm comes first, before the file: beeline " + order + ", not " + first +
                       " " + last);
}
