#include <fmt/format.h>

#include <beeline/model/catalog.h>

#include "verbs.h"

using namespace beeline;

namespace {

std::string joint_letters(const Arm& arm) {
  std::string letters;
  for (const Joint& joint : arm.joints()) letters += letter(kind(joint));
  return letters;
}

Answer list_arms() {
  Answer answer;
  Json arms = Json::list();
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    const std::string letters = joint_letters(arm), summary = built_in_summary(name);
    answer.text += fmt::format("{:<9} {:<8} {}\n", name, letters, summary);
    arms.append({{"name", name},
                 {"joints", letters},
                 {"dof", arm.dof()},
                 {"planar", arm.planar()},
                 {"summary", summary}});
  }
  answer.document = {{"arms", arms}};
  return answer;
}

}  // namespace

Verb arms_verb() {
  static bool json = false;
  return {.name = "arms",
          .summary = "List the built-in arms",
          .description =
              "Prints the name of each built-in arm, the kinds of its joints (R revolute, P "
              "prismatic) from the base to the tool, and what it is.",
          .examples = {{"The list, and the first arm's joints as a table",
                        "beeline arms\nbeeline show rrr"}},
          .json = &json,
          .run = list_arms};
}
