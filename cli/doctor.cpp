#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <optional>

#include <beeline/doctor/comparison.h>
#include <beeline/doctor/diagnosis.h>
#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/urdf.h>

#include "arm_argument.h"
#include "budget_argument.h"
#include "command/streams.h"
#include "exemption_report.h"
#include "format.h"
#include "scene_argument.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct DoctorArguments {
  ArmArgument arm;
  std::string other, other_base, other_tip;
  ComparisonOptions comparison;
  UnitArgument unit;
  SceneArgument scene;
  BudgetArgument budget;
};

/// One line of a report: where, what, and what to do about it.
struct ReportLine {
  std::string place, what, remedy;
};

/// The lines in aligned columns, indented; a remedy that does not fit stands below.
std::string aligned(const std::vector<ReportLine>& lines) {
  constexpr std::size_t widest = 62;
  std::size_t place = 0, what = 0;
  for (const ReportLine& line : lines) {
    place = std::max(place, line.place.size());
    if (line.what.size() <= widest) what = std::max(what, line.what.size());
  }
  std::string text;
  for (const ReportLine& line : lines) {
    text += fmt::format("  {:<{}}  {}", line.place, place, line.what);
    if (!line.remedy.empty()) {
      const bool fits = line.what.size() <= what;
      text +=
          fits ? std::string(what - line.what.size() + 2, ' ') : "\n" + std::string(place + 6, ' ');
      text += line.remedy;
    }
    text += "\n";
  }
  return text;
}

std::string place_of(const Arm& arm, const ModelDifference& difference) {
  if (difference.joint < 0) return name(difference.kind);
  const int number = difference.joint + 1;
  const std::string& joint = arm.joints()[static_cast<std::size_t>(difference.joint)].name;
  const bool named_by_number = joint == fmt::format("joint{}", number);
  return named_by_number ? fmt::format("joint {}", number)
                         : fmt::format("joint {} {}", number, joint);
}

/// What to write or, for a base or a tool, the option to give.
std::string remedy_of(const Arm& arm, const ModelDifference& difference, const UnitArgument& unit) {
  if (!difference.pose) return difference.remedy;
  const bool tool = difference.kind == DifferenceKind::tool;
  return (tool ? "--tcp " : "--mount ") + typed(*difference.pose, arm.planar(), unit);
}

std::vector<ReportLine> report_lines(const Arm& arm,
                                     const std::vector<ModelDifference>& differences,
                                     const UnitArgument& unit) {
  std::vector<ReportLine> lines;
  for (const ModelDifference& difference : differences) {
    std::string place = place_of(arm, difference);
    std::replace(place.begin(), place.end(), '_', difference.joint < 0 ? ' ' : '_');
    lines.push_back({place, difference.what, remedy_of(arm, difference, unit)});
  }
  return lines;
}

std::string comparison_text(const DoctorArguments& arguments, const Arm& a, const Arm& b,
                            const ArmComparison& comparison) {
  const UnitArgument& unit = arguments.unit;
  std::string text = comparison.verdict + "\n";
  text +=
      fmt::format("  A  {}: {}, B  {}: {}\n", arguments.arm.text,
                  counted(static_cast<std::int64_t>(a.joints().size()), "joint"), arguments.other,
                  counted(static_cast<std::int64_t>(b.joints().size()), "joint"));
  const auto add = [&](const std::string& heading, const std::vector<ModelDifference>& found) {
    if (!found.empty()) text += "\n" + heading + "\n" + aligned(report_lines(a, found, unit));
  };
  add("what makes A equal to B", comparison.differences);
  add("or, in as few steps", comparison.alternative);
  add("beside it", comparison.others);
  const auto deviation = [&unit](const Deviation& apart) {
    return fmt::format("{} m, {} {}", shown(apart.position), shown(unit.shown(apart.orientation)),
                       unit.name());
  };
  text += fmt::format("\ntool apart at {} random configurations\n", comparison.configurations);
  std::vector<ReportLine> lines;
  if (a.joints().size() == b.joints().size()) {
    lines.push_back({"as they are", deviation(comparison.before), ""});
  }
  if (comparison.explained && !comparison.differences.empty()) {
    lines.push_back({"with these changes", deviation(comparison.residual), ""});
  }
  if (lines.empty()) lines.push_back({"not comparable", "the numbers of joints differ", ""});
  return text + aligned(lines);
}

Json json_differences(const Arm& a, const std::vector<ModelDifference>& differences,
                      const UnitArgument& unit) {
  Json list = Json::list();
  for (const ModelDifference& difference : differences) {
    Json json{{"kind", name(difference.kind)}};
    if (difference.joint >= 0) {
      json.add("joint", difference.joint + 1);
      json.add("joint_name", a.joints()[static_cast<std::size_t>(difference.joint)].name);
    }
    if (!difference.parameter.empty()) json.add("parameter", difference.parameter);
    if (difference.a) json.add("a", *difference.a);
    if (difference.b) json.add("b", *difference.b);
    if (difference.pose) json.add("pose", json_pose(*difference.pose, false, unit));
    json.add("what", difference.what);
    const std::string remedy = remedy_of(a, difference, unit);
    if (!remedy.empty()) json.add("remedy", remedy);
    list.append(json);
  }
  return list;
}

Json json_deviation(const Deviation& deviation, const UnitArgument& unit) {
  return {{"position", deviation.position}, {"orientation", unit.shown(deviation.orientation)}};
}

/// "2 suspicious numbers, 1 fault".
std::string verdict_on(const Diagnosis& diagnosis) {
  std::int64_t numbers = 0, faults = 0;
  for (const Finding& finding : diagnosis.findings) {
    ++(finding.kind == FindingKind::fault ? faults : numbers);
  }
  std::string text = numbers > 0 ? counted(numbers, "suspicious number") : "";
  if (faults > 0) text += (text.empty() ? "" : ", ") + counted(faults, "fault");
  return text.empty() ? "nothing suspicious" : text;
}

/// Whether the finding after finding i has another cost or remedy. Findings in a row that have the
/// same are shown with it once.
bool ends_advice(const std::vector<Finding>& findings, std::size_t i) {
  return i + 1 == findings.size() || findings[i + 1].remedy != findings[i].remedy ||
         findings[i + 1].cost != findings[i].cost;
}

/// Prints all faults of a file whose chain has one. A single fault is in the error alone.
void print_faults(const std::string& path) {
  std::vector<Finding> faults;
  try {
    faults = file_faults(path);
  } catch (const Error&) {
    return;  // the error says why the file cannot be read
  }
  if (faults.size() < 2) return;
  warn(path + " has " + counted(static_cast<std::int64_t>(faults.size()), "fault") + ":");
  for (std::size_t i = 0; i < faults.size(); ++i) {
    const std::string remedy = ends_advice(faults, i) ? "; " + faults[i].remedy : "";
    print_error("  " + faults[i].place + ": " + faults[i].what + remedy);
  }
}

/// The findings in one model.
Answer diagnose_one(const DoctorArguments& arguments) {
  const ArmArgument& arm = arguments.arm;
  std::optional<Arm> read;
  try {
    read = arm.read(arguments.unit, false);  // warns of what was selected
  } catch (const FileError&) {
    print_faults(arm.text);
    throw;
  }
  ChainEnds ends{.base = arm.base, .tip = arm.tip};
  if (!arm.group.empty()) ends = group_ends(read_srdf(arm.srdf), arm.group, arm.text);
  const Diagnosis diagnosis = diagnose(arm.text, ends);
  const ExemptionReport exemptions =
      report_on_exemptions(arm, *read, arguments.scene, arguments.unit, arguments.budget);
  const std::string verdict = exemptions.with_verdict(verdict_on(diagnosis), !diagnosis);
  std::string text = arm.text + ": " + verdict + "\n";
  Json list = Json::list();
  std::size_t width = 0;
  for (const Finding& finding : diagnosis.findings) width = std::max(width, finding.place.size());
  for (std::size_t i = 0; i < diagnosis.findings.size(); ++i) {
    const Finding& finding = diagnosis.findings[i];
    const bool last = ends_advice(diagnosis.findings, i);
    text += fmt::format("\n  {:<{}}  {}\n", finding.place, width, finding.what);
    if (last && !finding.cost.empty()) {
      text += fmt::format("  {:<{}}  cost: {}\n", "", width, finding.cost);
    }
    if (last) text += fmt::format("  {:<{}}  {}\n", "", width, finding.remedy);
    Json json{{"kind", name(finding.kind)}, {"place", finding.place}, {"what", finding.what}};
    if (finding.joint >= 0) json.add("joint", finding.joint + 1);
    if (!finding.cost.empty()) json.add("cost", finding.cost);
    json.add("remedy", finding.remedy);
    list.append(json);
  }
  const bool found_nothing = diagnosis && exemptions.collisions == 0;
  const bool clear = found_nothing && exemptions.ending.empty();
  const std::string status = clear ? "clear" : found_nothing ? exemptions.ending : "suspicious";
  Json document{{"status", status}, {"findings", list}};
  if (!exemptions.text.empty()) document.add("exemptions", exemptions.document);
  return {.text = text + exemptions.text,
          .document = document,
          .yes = clear,
          .reason = found_nothing ? exemptions.unfinished() : arm.text + " has " + verdict};
}

Answer compare(const DoctorArguments& arguments) {
  if (arguments.other.empty()) return diagnose_one(arguments);
  if (!arguments.scene.scenes.empty()) {
    throw Error("--scene is for one arm, whose exempted pairs are examined");
  }
  const UnitArgument& unit = arguments.unit;
  const Arm a = arguments.arm.read(unit);
  ArmArgument other;
  other.text = arguments.other;
  other.base = arguments.other_base;
  other.tip = arguments.other_tip;
  const Arm b = other.read(unit);
  const ArmComparison comparison = compare_arms(a, b, arguments.comparison);
  return {.text = comparison_text(arguments, a, b, comparison),
          .document = {{"status", name(comparison.status)},
                       {"explained", comparison.explained},
                       {"verdict", comparison.verdict},
                       {"differences", json_differences(a, comparison.differences, unit)},
                       {"alternative", json_differences(a, comparison.alternative, unit)},
                       {"others", json_differences(a, comparison.others, unit)},
                       {"gain", comparison.gain},
                       {"offset", comparison.offset},
                       {"before", json_deviation(comparison.before, unit)},
                       {"residual", json_deviation(comparison.residual, unit)},
                       {"configurations", comparison.configurations}},
          .yes = static_cast<bool>(comparison),
          .reason = "A and B are not described alike"};
}

Positional first_model(DoctorArguments& arguments) {
  Positional model = arguments.arm.argument();
  model.name = "A";
  return model;
}

}  // namespace

Verb doctor_verb() {
  const auto arguments = std::make_shared<DoctorArguments>();
  return {
      .name = "doctor",
      .summary = "Diagnose a model: suspicious numbers, or what two descriptions have different",
      .description =
          "With one model, looks for numbers that are likely mistakes: millimetres, degrees, right "
          "angles written with few digits and axes that nearly have a closed form of inverse "
          "kinematics (with the method that is lost), joints that move alike, a missing <axis>, "
          "limits without a range; and for faults of a URDF file beside the chain, such as an "
          "unknown parent link, type or leader, an axis of zeros, reversed limits. If the chain "
          "has a fault (exit code 3), stderr lists all. What may be meant is not reported.\n\n"
          "With --srdf or --scene, examines the pairs of bodies that the SRDF file, or the allowed "
          "collision matrix of MoveIt's scene, exempts from collision checks: which of them "
          "collide "
          "within the position limits, with a configuration; which are proved never to touch; and "
          "for which a search found no collision, which proves nothing. --time-limit and Ctrl-C "
          "end "
          "the search; the pairs that remain are counted as not finished.\n\n"
          "With two, compares two descriptions of an arm: are they the same, and if not, what is "
          "different? The sequence of the joints' axes in space determines an arm up to its base, "
          "its tool, and the zeros and signs of its joints; so a difference is named as what it "
          "is: the DH convention, the mount, the tool, the offset or the sign of a joint, a unit, "
          "one dimension of a link, a missing joint, a limit. The explanation with the fewest "
          "differences is printed, with what to write; nothing is claimed that forward kinematics "
          "at random configurations does not confirm. Exit code 0: nothing is suspicious, or the "
          "two move alike as they are and have equal limits; 1 otherwise.",
      .arguments =
          {first_model(*arguments),
           {.name = "B",
            .help = "The other description of the arm: a built-in arm, a joint string or a file.",
            .target = &arguments->other,
            .completes = Completes::arm,
            .required = false}},
      .options = joined(
          {arguments->unit.options(),
           {Option("--tolerance E", "Smaller differences are rounding, metres and radians.",
                   &arguments->comparison.tolerance,
                   {.range = {.lowest = 0, .highest = 0.1, .excludes_lowest = true}}),
            Option("--configurations N",
                   "Number of random configurations at which the tool's poses are compared.",
                   &arguments->comparison.configurations, {.range = {.lowest = 1, .highest = 1e6}}),
            Option("--other-base LINK", "--base of B; the other options of arms apply to A.",
                   &arguments->other_base),
            Option("--other-tip LINK", "--tip of B.", &arguments->other_tip)},
           arguments->scene.body_options(),
           arguments->budget.options(),
           arguments->arm.options()}),
      .examples = {{"Is anything suspicious in a model? (exit code 0: nothing)",
                    "beeline doctor panda"},
                   {"Two arms that are easily confused: which numbers differ?",
                    "beeline doctor ur5 ur5e || true"},
                   {"A file that was changed by hand, compared with what it was",
                    "beeline show ur5 --out mine.json\n"
                    "beeline doctor ur5 mine.json --mount 0,0,0.5 || true"}},
      .run = [arguments] { return compare(*arguments); }};
}

}  // namespace beeline::command
