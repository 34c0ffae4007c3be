#include <memory>

#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/reach/surface.h>

#include "command/verb.h"
#include "reach_totals.h"
#include "result_files.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct MapExportArguments {
  std::string map, out;
};

Answer export_map(const MapExportArguments& arguments) {
  refuse_overwriting(arguments.out, {arguments.map});
  if (extension(arguments.out) != "vti") {
    throw Error("--out: " + arguments.out + " does not end in .vti");
  }
  const ReachMap map(arguments.map);
  write_vti(map, arguments.out);
  Answer answer{
      .text = "written       " + arguments.out + "\n",
      .document = {
          {"status", "written"}, {"out", arguments.out}, {"map_scene", scene_document(map)}}};
  if (const auto& scene = map.header().scene) {
    answer.text += "free in       " + scene_name(*scene) + "\n";
  }
  return answer;
}

}  // namespace

Verb reach_export_verb() {
  const auto arguments = std::make_shared<MapExportArguments>();
  return {.name = "export",
          .summary = "Write a map for ParaView",
          .description =
              "Writes the positions of a map as an image of VTK, .vti, which ParaView opens: the "
              "fraction of the directions that is reached, and the largest number of branches, "
              "manipulability and margin of any orientation; the last two are nan where none is "
              "reached. The map itself is HDF5, which h5py reads.",
          .arguments = {map_argument(&arguments->map)},
          .options = {Option("--out FILE", "The positions, .vti.", &arguments->out,
                             {.required = true})},
          .examples = {{"A map for ParaView",
                        "beeline reach map puma560 --resolution 0.1 --out puma560.h5\n"
                        "beeline reach export puma560.h5 --out puma560.vti"}},
          .run = [arguments] { return export_map(*arguments); }};
}

}  // namespace beeline::command
