#include <fmt/core.h>

#include <beeline/model/catalog.h>

#include "output.h"
#include "verb.h"

using namespace beeline;

namespace {

struct Arguments {
  bool json = false;
};

std::string joint_letters(const Arm& arm) {
  std::string letters;
  for (const Joint& joint : arm.joints()) letters += letter(kind(joint));
  return letters;
}

Exit list_arms(const Arguments& arguments) {
  OrderedJson arms = OrderedJson::array();
  for (const std::string& name : built_in_names()) {
    const Arm arm = built_in(name);
    const std::string letters = joint_letters(arm), summary = built_in_summary(name);
    if (!arguments.json) fmt::print("{:<9} {:<8} {}\n", name, letters, summary);
    arms.push_back({{"name", name},
                    {"joints", letters},
                    {"dof", arm.dof()},
                    {"planar", arm.planar()},
                    {"summary", summary}});
  }
  if (arguments.json) print_json({{"arms", arms}});
  return Exit::yes;
}

}  // namespace

Run declare_arms(CLI::App& verb) {
  static Arguments arguments;
  verb.add_flag("--json", arguments.json, "Print JSON");
  verb.footer("Example:\n  beeline arms");
  return [] { return list_arms(arguments); };
}
