#include <cmath>
#include <fmt/format.h>

#include <beeline/inverse/inverse_kinematics.h>
#include <beeline/model/catalog.h>

#include "verbs.h"

namespace beeline::command {
namespace {

std::string joint_letters(const Arm& arm) {
  std::string letters;
  for (const Joint& joint : arm.joints()) letters += letter(kind(joint));
  return letters;
}

Answer list_arms() {
  constexpr const char* row = "{:<13} {:<19} {:<25} {:<8} {:>9}  {}\n";
  Answer answer{.text = fmt::format(row, "name", "maker", "model", "joints", "reach (m)",
                                    "inverse kinematics")};
  Json arms = Json::list();
  for (const BuiltInArm& about : built_in_arms()) {
    const Arm arm = built_in(about.name);
    const std::string letters = joint_letters(arm), method = inverse_method(arm, {.all = true});
    const double reach = arm.reach().radius;
    answer.text += fmt::format(row, about.name, about.maker, about.model, letters,
                               std::isfinite(reach) ? fmt::format("{:.2f}", reach) : "-", method);
    arms.append({{"name", about.name},
                 {"maker", about.maker},
                 {"model", about.model},
                 {"joints", letters},
                 {"dof", arm.dof()},
                 {"planar", arm.planar()},
                 {"method", method},
                 {"reach", reach},
                 {"source", about.source},
                 {"note", about.note},
                 {"shapes_source", about.shapes_source}});
  }
  answer.document = {{"arms", arms}};
  return answer;
}

}  // namespace

Verb arms_verb() {
  return {.name = "arms",
          .summary = "List the built-in arms",
          .description =
              "Prints the name of each built-in arm, its maker and model, the kinds of its joints "
              "(R revolute, P prismatic) from the base to the tool, the method of its inverse "
              "kinematics, and the radius of a ball that the tool cannot leave. --json adds the "
              "document that the numbers are from. `beeline show NAME` prints one arm.",
          .examples = {{"The list, and the first arm's joints as a table",
                        "beeline arms\nbeeline show rrr"}},
          .run = list_arms};
}

}  // namespace beeline::command
