#include "exemption_report.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

#include <beeline/error.h>

#include "command/progress.h"
#include "command/streams.h"
#include "format.h"

namespace beeline::command {
namespace {

std::int64_t count_of(const std::vector<Exemption>& found, ExemptionStatus status) {
  return std::count_if(found.begin(), found.end(),
                       [status](const Exemption& pair) { return pair.status == status; });
}

std::string text_of(const std::vector<Exemption>& found, const UnitArgument& unit, const Arm& arm) {
  std::string text = fmt::format("\n  exempted pairs      {}\n", found.size());
  for (const Exemption& pair : found) {
    if (pair.status != ExemptionStatus::collides) continue;
    text += fmt::format("  collide             {} and {}, {} m deep at q {}\n", pair.names[0],
                        pair.names[1], shown(pair.depth), shown(unit.shown(arm, pair.q)));
  }
  for (const Exemption& pair : found) {
    if (pair.status != ExemptionStatus::always_collides) continue;
    text += fmt::format("  always collide      {} and {}, up to {} m deep\n", pair.names[0],
                        pair.names[1], shown(pair.depth));
  }
  const std::pair<ExemptionStatus, const char*> counts[] = {
      {ExemptionStatus::never_close, "proved apart       "},
      {ExemptionStatus::no_collision, "no collision found "},
      {ExemptionStatus::not_checked, "not checked        "},
      {ExemptionStatus::time_limit, "not finished       "},
      {ExemptionStatus::cancelled, "not finished       "},
      {ExemptionStatus::work_limit, "not finished       "}};
  for (const auto& [status, label] : counts) {
    const std::int64_t pairs = count_of(found, status);
    if (pairs == 0) continue;
    const bool unchecked = status == ExemptionStatus::not_checked;
    text += fmt::format("  {} {}{}\n", label, counted(pairs, "pair"),
                        unchecked ? ", which share a joint or do not move" : "");
  }
  return text;
}

Json document_of(const std::vector<Exemption>& found, const UnitArgument& unit, const Arm& arm) {
  Json list = Json::list();
  for (const Exemption& pair : found) {
    Json bodies = Json::list();
    for (const std::string& name : pair.names) bodies.append(name);
    Json json{{"bodies", bodies}, {"status", name(pair.status)}};
    if (pair.q.size() > 0) {
      json.add("q", unit.shown(arm, pair.q));
      json.add("depth", pair.depth);
    }
    list.append(json);
  }
  return list;
}

}  // namespace

std::string ExemptionReport::unfinished() const {
  return "the search of the exempted pairs is not finished";
}

std::string ExemptionReport::with_verdict(const std::string& verdict, bool suspicious) const {
  if (collisions == 0) return verdict + (ending.empty() ? "" : "; " + unfinished());
  return (suspicious ? verdict + ", " : "") + counted(collisions, "exempted pair") +
         (collisions == 1 ? " that collides" : " that collide");
}

ExemptionReport report_on_exemptions(const ArmArgument& arm_argument, const Arm& arm,
                                     SceneArgument scene, const UnitArgument& unit,
                                     const BudgetArgument& budget) {
  if (arm_argument.srdf.empty() && scene.scenes.empty()) {
    scene.read(arm_argument, arm);  // refuses options that need a scene
    return {};
  }
  scene.self = true;
  std::optional<CheckedScene> read;
  const auto unexamined = [](const Error& error) -> ExemptionReport {
    warn(std::string("the exempted pairs are not examined: ") + error.what());
    return {};
  };
  try {
    read = scene.read(arm_argument, arm);
  } catch (const NoShapesError& error) {
    return unexamined(error);
  } catch (const FileError& error) {  // a mesh of the arm may be missing
    const std::vector<std::string> scenes = scene.inputs();
    if (std::find(scenes.begin(), scenes.end(), error.path()) != scenes.end()) throw;
    return unexamined(error);
  }
  std::vector<NamedPair> pairs = read->srdf_pairs;
  const std::vector<NamedPair>& of_scene = read->exempted_pairs;
  pairs.insert(pairs.end(), of_scene.begin(), of_scene.end());
  Progress progress;
  const std::vector<Exemption> found = examine_exemptions(
      arm, read->model.links(), read->model.scene(), pairs, {.budget = progress.of(budget.next())});
  ExemptionReport report{.text = text_of(found, unit, arm),
                         .document = document_of(found, unit, arm),
                         .collisions = count_of(found, ExemptionStatus::collides)};
  for (const ExemptionStatus ended :
       {ExemptionStatus::time_limit, ExemptionStatus::cancelled, ExemptionStatus::work_limit}) {
    if (count_of(found, ended) > 0) report.ending = name(ended);
  }
  return report;
}

}  // namespace beeline::command
