#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <memory>

#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/scene.h>
#include <beeline/io/text/urdf.h>
#include <beeline/model/catalog.h>

#include "arm_argument.h"
#include "arm_document.h"
#include "format.h"
#include "result_files.h"
#include "screw_table.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct ShowArguments {
  ArmArgument arm;
  LimitsArgument limits;
  UnitArgument unit;
  std::string out, as;
};

/// The chain of a group, or why it is none.
std::string chain_text(const Srdf& srdf, const std::string& group, const std::string& urdf) {
  try {
    const ChainEnds ends = group_ends(srdf, group, urdf);
    return fmt::format("{} to {}", ends.base, ends.tip);
  } catch (const Error&) {
    return "not one chain of this file";
  }
}

/// The state's values for the arm, or why it has none for it.
std::string state_text(const Srdf& srdf, const Srdf::State& state, const Arm& arm,
                       const UnitArgument& unit) {
  try {
    return shown(unit.shown(arm, named_state(srdf, arm, state.name, state.group)));
  } catch (const Error&) {
    return "not for this arm";
  }
}

/// Adds the groups and named states of --srdf.
void add_srdf(const ShowArguments& arguments, const Arm& arm, Answer& answer) {
  const Srdf srdf = read_srdf(arguments.arm.srdf);
  Json groups = Json::list(), states = Json::list();
  answer.text += fmt::format("\ngroups of {}\n", srdf.path);
  for (const Srdf::Group& group : srdf.groups) {
    const std::string chain = chain_text(srdf, group.name, arguments.arm.text);
    answer.text += fmt::format("  {:<24}  {}\n", group.name, chain);
    groups.append({{"name", group.name}, {"chain", chain}});
  }
  answer.text += fmt::format("\nnamed states (joint values in {}, m)\n", arguments.unit.name());
  for (const Srdf::State& state : srdf.states) {
    const std::string values = state_text(srdf, state, arm, arguments.unit);
    answer.text += fmt::format("  {:<24}  {:<16}  {}\n", state.name, state.group, values);
    Json joints = Json::object();
    for (const auto& [joint, numbers] : state.joints) {
      joints.add(joint, Eigen::VectorXd(Eigen::Map<const Eigen::VectorXd>(
                            numbers.data(), static_cast<Eigen::Index>(numbers.size()))));
    }
    states.append({{"name", state.name}, {"group", state.group}, {"joints", joints}});
  }
  answer.document.add("groups", groups);
  answer.document.add("states", states);
}

/// Adds what a built-in arm is and where its numbers come from. It may be named in any case.
void add_source(const std::string& name, Answer& answer) {
  const auto same = [](unsigned char a, unsigned char b) {
    return std::tolower(a) == std::tolower(b);
  };
  for (const BuiltInArm& about : built_in_arms()) {
    if (!std::equal(about.name.begin(), about.name.end(), name.begin(), name.end(), same)) continue;
    answer.text += fmt::format("\n{} {}\nsource: {}\n", about.maker, about.model, about.source);
    if (!about.note.empty()) answer.text += fmt::format("note: {}\n", about.note);
    answer.text += fmt::format("shapes of its links: {}\n",
                               about.shapes_source.empty() ? "none" : about.shapes_source);
    answer.document.add(Json{{"maker", about.maker},
                             {"model", about.model},
                             {"source", about.source},
                             {"note", about.note},
                             {"shapes_source", about.shapes_source}});
  }
}

Answer show(const ShowArguments& arguments) {
  const Arm arm = arguments.limits.set_on(arguments.arm.read(arguments.unit), arguments.unit);
  if (!arguments.out.empty()) {
    if (extension(arguments.out) != "json") {
      throw Error("--out " + arguments.out + ": an arm is written to a .json file");
    }
    refuse_overwriting(arguments.out, arguments.arm.inputs());
    const bool is_urdf = is_urdf_path(arguments.arm.text);
    const ArmShapes shapes = is_urdf ? ArmShapes{} : arguments.arm.shapes({});
    write_file(arguments.out, arm_to_json(arm, shapes.links));
  }
  Answer answer{.text = arm_table(arm, arguments.unit.degrees),
                .document = arm_document(arm, arguments.unit.degrees)};
  if (arguments.as == "screws") {
    answer.text += screw_table(arm);
    answer.document.add("screws", screw_document(arm));
  }
  add_source(arguments.arm.text, answer);
  if (!arguments.arm.srdf.empty()) add_srdf(arguments, arm, answer);
  return answer;
}

}  // namespace

Verb show_verb() {
  const auto arguments = std::make_shared<ShowArguments>();
  return {
      .name = "show",
      .summary = "Print an arm as a table: joints, limits, frames, reach",
      .description =
          "Prints each joint with its type, its axis in the world at zero joint values, its "
          "position limits (lower, upper) and its limits of velocity, acceleration and jerk; "
          "the frames of all links and of the tool at zero joint values; and a ball that the "
          "tool cannot leave. Limits that are not known are assumed in motions; they are "
          "marked with an a, and with --json null, with the assumed ones in `assumed`. Of a "
          "built-in arm also its maker, the document that the numbers are from and what the shapes "
          "of its links contain; with --srdf the groups and named states.",
      .arguments = {arguments->arm.argument()},
      .options =
          joined({arguments->unit.options(),
                  {Option("--out FILE",
                          "Also write the arm to this .json file, with the shapes of its links "
                          "unless they are in a URDF file.",
                          &arguments->out),
                   Option("--as FORM",
                          "Also print the arm as screws: the product of exponentials, with the "
                          "screws in the world and in the tool and the home pose.",
                          &arguments->as, {.choices = {"screws"}})},
                  arguments->arm.options(),
                  arguments->limits.options()}),
      .examples = {{"The Franka Panda, angles in degrees", "beeline show panda --degrees"},
                   {"The screws of a UR5, as in Lynch & Park", "beeline show ur5 --as screws"},
                   {"A UR5 with limits of its user",
                    "beeline show ur5 --velocity 3.14 --acceleration 15 --speed 0.5"},
                   {"An arm file to change and use in place of the built-in arm",
                    "beeline show ur5 --out my_arm.json\nbeeline show my_arm.json"}},
      .run = [arguments] { return show(*arguments); }};
}

}  // namespace beeline::command
