#include <filesystem>
#include <fmt/format.h>
#include <memory>

#include <beeline/draw/figure.h>
#include <beeline/draw/timing_figure.h>
#include <beeline/reach/surface.h>

#include "format.h"
#include "plane_argument.h"
#include "reach_totals.h"
#include "result_files.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct CompareArguments {
  std::string first, second, out;
  PlaneArgument plane;
};

Json json_of(const ReachSide& side, const ReachMap& map) {
  Json json{{"map", map.path()},
            {"arm", map.arm().name()},
            {"map_scene", scene_document(map)},
            {"volume", side.volume},
            {"alone", side.volume_only_here},
            {"better", side.volume_more_directions},
            {"directions", side.directions}};
  if (std::isfinite(side.margin)) {
    json.add("manipulability", side.manipulability);
    json.add("margin", side.margin);
  }
  return json;
}

/// The name of its file.
std::string name_of(const ReachMap& map) {
  return std::filesystem::path(map.path()).filename().string();
}

std::string table(const ReachComparison& comparison, const ReachMap& first,
                  const ReachMap& second) {
  const auto& [a, b] = comparison.sides;
  const bool planar = first.arm().planar() && second.arm().planar();
  const std::string unit = planar ? "m2" : "m3";
  const auto row = [](const std::string& name, const std::string& x, const std::string& y) {
    return fmt::format("{:<32}{:>16}{:>16}\n", name, x, y);
  };
  const auto numbers = [&row](const std::string& name, double x, double y) {
    return row(name, fmt::format("{:.4g}", x), fmt::format("{:.4g}", y));
  };
  std::string text = row("", name_of(first), name_of(second));
  text += numbers("reached, " + unit, a.volume, b.volume);
  text += numbers("  only by this one", a.volume_only_here, b.volume_only_here);
  text += numbers("  by both", comparison.both, comparison.both);
  text +=
      numbers("more directions than the other", a.volume_more_directions, b.volume_more_directions);
  text += row("directions reached, mean", fmt::format("{:.1f} %", 100 * a.directions),
              fmt::format("{:.1f} %", 100 * b.directions));
  if (comparison.both > 0) {
    text += numbers("manipulability, mean", a.manipulability, b.manipulability);
    text += numbers("margin, mean", a.margin, b.margin);
  }
  for (const ReachMap* map : {&first, &second}) {
    if (const auto& scene = map->header().scene) {
      text += name_of(*map) + ": free in " + scene_name(*scene) + "\n";
    }
  }
  return text + fmt::format("compared at points {} m apart\n", shown(comparison.step));
}

Answer compare(const CompareArguments& arguments) {
  if (arguments.plane.given() == arguments.out.empty()) {
    throw Error("--at and --out: a picture needs both");
  }
  if (!arguments.out.empty()) {
    refuse_overwriting(arguments.out, {arguments.first, arguments.second});
    (void)arguments.plane.normal();
    (void)format_of(arguments.out);
  }
  const ReachMap first(arguments.first), second(arguments.second);
  const ReachComparison comparison = compare_reach(first, second);
  Answer answer{.text = table(comparison, first, second)};
  Json sides = Json::list();
  sides.append(json_of(comparison.sides[0], first));
  sides.append(json_of(comparison.sides[1], second));
  answer.document = {{"status", "compared"},
                     {"maps", sides},
                     {"both", comparison.both},
                     {"step", comparison.step}};
  if (arguments.out.empty()) return answer;
  const PlaneArgument& plane = arguments.plane;
  auto slices = slices_of(first, second, plane.normal(), plane.at(), plane.measure());
  slices[0].title = name_of(first);
  slices[1].title = name_of(second);
  save(reach_figure(slices), arguments.out);
  answer.text += "picture       " + arguments.out + "\n";
  answer.document.add("out", arguments.out);
  return answer;
}

}  // namespace

Verb reach_compare_verb() {
  const auto arguments = std::make_shared<CompareArguments>();
  return {
      .name = "compare",
      .summary = "Compare the maps of two arms, or of one with two mounts or tools",
      .description =
          "Compares two maps in the same world, at the centres of cells that cover both: the "
          "volume that each reaches, that only one or both reach, and where each reaches more tool "
          "directions; the mean fraction of directions where either reaches some; the means of the "
          "largest manipulability and margin where both do. Maps of the same box are compared cell "
          "by cell. With --at and --out, draws both in a plane.",
      .arguments = {file_argument("A", "A file of `beeline reach map`.", &arguments->first),
                    file_argument("B", "Another one.", &arguments->second)},
      .options =
          joined({{Option("--out FILE", "A picture of both in the plane --at, .svg, .png or .pdf.",
                          &arguments->out)},
                  arguments->plane.options(false)}),
      .examples =
          {{"An arm on the floor and on a wall",
            "beeline reach map puma560 --resolution 0.12 --out floor.h5\n"
            "beeline reach map puma560 --mount 0,0,0.5,0,1.5708,0 --resolution 0.12 --out wall.h5\n"
            "beeline reach compare floor.h5 wall.h5 --at y=0 --out compare.svg"}},
      .run = [arguments] { return compare(*arguments); }};
}

}  // namespace beeline::command
