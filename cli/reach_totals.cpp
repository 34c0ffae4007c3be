#include "reach_totals.h"

#include <fmt/format.h>

#include <beeline/reason.h>

#include "format.h"
#include "json_reason.h"

namespace beeline::command {
namespace {

/// "64000 positions x 54 directions x 6 rolls".
std::string cells_text(const ReachGrid& grid) {
  std::string text = counted(grid.positions(), "position");
  if (grid.cylindrical()) text += ", " + counted(grid.azimuths(), "azimuth") + ",";
  if (grid.orientations() == ReachOrientations::headings) {
    text += " x " + counted(grid.directions(), "heading");
  } else if (grid.orientations() == ReachOrientations::any) {
    text += " in any orientation";
  } else if (grid.orientations() != ReachOrientations::fixed) {
    text += " x " + counted(grid.directions(), "direction");
  }
  if (grid.rolls() > 1) text += " x " + counted(grid.rolls(), "roll");
  return text;
}

double percent(std::int64_t part, std::int64_t all) {
  return all == 0 ? 0 : 100 * static_cast<double>(part) / static_cast<double>(all);
}

}  // namespace

std::string scene_name(const ReachScene& scene) {
  return (scene.files.empty() ? "no scene, apart from itself" : listed(scene.files)) +
         fmt::format(", {} m are required", shown(scene.clearance));
}

Json scene_document(const ReachMap& map) {
  const std::optional<ReachScene>& scene = map.header().scene;
  if (!scene) return {};
  return {{"digest", scene->digest}, {"clearance", scene->clearance}, {"files", scene->files}};
}

Positional map_argument(std::string* target) {
  return file_argument("MAP", "A file of `beeline reach map`.", target);
}

Answer map_totals(const ReachMap& map) {
  const ReachMap::Totals totals = map.totals();
  const double edge = map.grid().axes()[0].step, size = totals.volume;
  const bool planar = map.arm().planar();
  std::int64_t there = 0;
  for (const bool slab : map.slabs()) there += slab;
  const auto slabs = static_cast<std::int64_t>(map.slabs().size());
  Answer answer;
  answer.text = fmt::format("map           {}\narm           {}\ncells         {}, of {} m\n",
                            map.path(), map.arm().name(), cells_text(map.grid()), shown(edge));
  const std::int64_t samples = map.header().samples;
  if (samples > 0) {
    answer.text += "by sampling   " + counted(samples, "configuration") + "\n";
  }
  const std::optional<ReachScene>& scene = map.header().scene;
  if (scene) answer.text += "free in       " + scene_name(*scene) + "\n";
  if (!map.complete()) {
    answer.text += fmt::format("in this file  {} of {} slabs, {}\n", there, slabs,
                               counted(totals.cells, "cell"));
  }
  answer.text += fmt::format("reached       {} of {} cells, {:.2f} %\n", totals.reached,
                             totals.cells, percent(totals.reached, totals.cells));
  answer.text += fmt::format("{}{} of {} positions, {:.4g} m{}\n",
                             planar ? "area          " : "volume        ", totals.reached_positions,
                             totals.positions, size, planar ? "2" : "3");
  answer.document = {{"status", map.complete() ? "complete" : "incomplete"},
                     {"map", map.path()},
                     {"arm", map.arm().name()},
                     {"by", samples > 0 ? "sampling" : "inverse-kinematics"},
                     {"samples", samples},
                     {"map_scene", scene_document(map)},
                     {"cells", map.grid().cells()},
                     {"positions", map.grid().positions()},
                     {"directions", map.grid().directions()},
                     {"rolls", map.grid().rolls()},
                     {"resolution", edge},
                     {"slabs", slabs},
                     {"slabs_here", there},
                     {"cells_here", totals.cells},
                     {"cells_reached", totals.reached},
                     {"positions_reached", totals.reached_positions},
                     {planar ? "area" : "volume", size}};
  answer.document.add(json_reason({}));
  return answer;
}

Answer interrupted_map(const std::string& out, Ending ending) {
  const std::string parts = out + ".parts";
  const Reason reason{ReasonCode::ended_in_map,
                      {{ReasonField::ending, ending}, {ReasonField::parts, parts}}};
  Answer answer{.text = "no map        the slabs computed so far are in " + parts + "\n",
                .document = {{"status", name(ending)}, {"parts", parts}},
                .yes = false,
                .reason = sentence(reason)};
  answer.document.add(json_reason(reason));
  return answer;
}

}  // namespace beeline::command
