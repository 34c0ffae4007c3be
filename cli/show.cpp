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
#include "command/streams.h"
#include "dh_document.h"
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
  std::string out, as, convention;
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
                       const ShowArguments& arguments) {
  try {
    const Configuration q = arguments.arm.state(srdf, arm, state.name, state.group);
    return shown(arguments.unit.shown(arm, q));
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
    const std::string values = state_text(srdf, state, arm, arguments);
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

/// Adds a no: what cannot be said, and its sentences.
void refuse(Answer& answer, const std::string& what, const std::vector<std::string>& reasons) {
  answer.yes = false;
  answer.reason += (answer.reason.empty() ? "" : "; ") + what;
  for (std::size_t i = 0; i < reasons.size(); ++i) {
    answer.reason += (i == 0 ? ": " : "; ") + reasons[i];
  }
}

/// The shapes of the arm's links that an arm file of JSON takes; of files of trees of links they
/// stay there, with their meshes.
std::vector<LinkShapes> own_shapes(const ShowArguments& arguments) {
  if (has_link_tree_ending(arguments.arm.text)) return {};
  return arguments.arm.shapes({}).links;
}

/// Whether an input of URDF or MJCF has shapes, read or not: a mesh may be missing.
bool has_shapes(const ShowArguments& arguments) {
  try {
    const ArmShapes read = arguments.arm.shapes({});
    return !read.links.empty() || !read.links_without_shapes.empty();
  } catch (const FileError&) {
    return true;
  }
}

/// Warns of what the arm's URDF or MJCF file has and --out does not.
void warn_of_lost_parts(const ShowArguments& arguments) {
  const std::string& input = arguments.arm.text;
  if (!has_link_tree_ending(input)) return;
  if (has_shapes(arguments)) {
    warn(arguments.out + " has no shapes of the links; they are in " + input);
  }
  if (arm_file_format(arguments.out) == ArmFileFormat::urdf && extension(input) == "urdf") {
    warn(arguments.out + " has no efforts, which are written as 0; they are in " + input);
  }
}

/// Writes --out, or adds the reasons why the format cannot describe the arm.
void write_out(const ShowArguments& arguments, const Arm& arm, Answer& answer) {
  const ArmFileFormat format = arm_file_format(arguments.out);
  const std::vector<LinkShapes> shapes = own_shapes(arguments);
  ArmFile file = arm_file(arm, format);
  if (!file) {
    std::vector<std::string> reasons;
    Json gaps = Json::list();
    for (const ArmGap& gap : file.gaps) {
      reasons.push_back(sentence(gap, format));
      gaps.append(Json{{"kind", name(gap.kind)}, {"joint", gap.joint}, {"link", gap.link}});
    }
    answer.document.add("gaps", gaps);
    return refuse(answer, arguments.out + " is not written", reasons);
  }
  if (format == ArmFileFormat::json) {
    file.text = arm_to_json(arm, shapes);
  } else if (!shapes.empty()) {
    warn(arguments.out + " has no shapes of the links; a .json file has them");
  }
  for (const std::string& note : file_notes(file, arguments.out, OptionStyle::command)) warn(note);
  warn_of_lost_parts(arguments);
  write_file(arguments.out, file.text);
}

/// Adds --as dh: the table or, where there is none, the screws.
void add_dh(const ShowArguments& arguments, const Arm& arm, Answer& answer) {
  const DhTable table = dh_table(
      arm, arguments.convention == "standard" ? DhConvention::standard : DhConvention::modified);
  answer.text += dh_text(arm, table, arguments.unit);
  answer.document.add("dh", dh_document(arm, table, arguments.unit));
  if (table) return;
  std::vector<std::string> reasons;
  for (const DhMisfit& misfit : table.misfits) reasons.push_back(sentence(misfit));
  refuse(answer, "no table of " + arguments.convention + " DH parameters", reasons);
}

void check(const ShowArguments& arguments) {
  if (arguments.as == "dh" && arguments.convention.empty()) {
    throw Error("--as dh needs --convention standard or modified: they are different tables");
  }
  if (arguments.as != "dh" && !arguments.convention.empty()) {
    throw Error("--convention is for --as dh");
  }
  if (arguments.out.empty()) return;
  arm_file_format(arguments.out);
  refuse_overwriting(arguments.out, arguments.arm.inputs());
}

Answer show(const ShowArguments& arguments) {
  check(arguments);
  const Arm arm = arguments.limits.set_on(arguments.arm.read(arguments.unit), arguments.unit);
  Answer answer{.text = arm_table(arm, arguments.unit.degrees),
                .document = arm_document(arm, arguments.unit.degrees)};
  if (arguments.as == "dh") add_dh(arguments, arm, answer);
  if (arguments.as == "screws" || (arguments.as == "dh" && !answer.yes)) {
    answer.text += screw_table(arm);
    answer.document.add("screws", screw_document(arm));
  }
  if (!arguments.out.empty() && answer.yes) {
    write_out(arguments, arm, answer);
  } else if (!arguments.out.empty()) {
    refuse(answer, arguments.out + " is not written", {});
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
      .options = joined(
          {arguments->unit.options(),
           {Option("--out FILE",
                   "Also write the arm to this file: .json, with the shapes of its links "
                   "unless they are in a URDF file; .urdf; or MuJoCo's .xml or .mjcf. If "
                   "the format cannot describe the arm, nothing is written.",
                   &arguments->out),
            Option("--as FORM",
                   "Also print the arm in another form. screws: the product of "
                   "exponentials, with the screws in the world and in the tool and the "
                   "home pose. dh: Denavit-Hartenberg parameters with the poses of base "
                   "and tool, or the screws if no table has the arm's axes exactly.",
                   &arguments->as, {.choices = {"screws", "dh"}}),
            Option("--convention NAME",
                   "The convention of --as dh: standard (Denavit & Hartenberg, Paul) or "
                   "modified (Craig).",
                   &arguments->convention, {.choices = {"standard", "modified"}, .needs = "--as"})},
           arguments->arm.options(),
           arguments->limits.options()}),
      .examples = {{"The Franka Panda, angles in degrees", "beeline show panda --degrees"},
                   {"The screws of a UR5, as in Lynch & Park", "beeline show ur5 --as screws"},
                   {"The DH table of a Franka Panda, angles in degrees",
                    "beeline show panda --as dh --convention modified --degrees"},
                   {"A built-in arm for ROS and for MuJoCo",
                    "beeline show ur5e --out ur5e.urdf\nbeeline show ur5e --out ur5e.xml"},
                   {"A UR5 with limits of its user",
                    "beeline show ur5 --velocity 3.14 --acceleration 15 --speed 0.5"},
                   {"A UR5 on a rail of 2 m, for ROS",
                    "beeline show ur5 --rail x:2 --out ur5_on_rail.urdf"},
                   {"An arm file to change and use in place of the built-in arm",
                    "beeline show ur5 --out my_arm.json\nbeeline show my_arm.json"}},
      .run = [arguments] { return show(*arguments); }};
}

}  // namespace beeline::command
