#include <memory>

#include <beeline/error.h>
#include <beeline/io/text/internal/file.h>
#include <beeline/reach/surface.h>

#include "command/verb.h"
#include "reach_totals.h"
#include "result_files.h"
#include "verbs.h"

using namespace beeline;

namespace {

struct MapExportArguments {
  std::string map, out;
  bool json = false;
};

Answer export_map(const MapExportArguments& arguments) {
  refuse_overwriting(arguments.out, {arguments.map});
  if (internal::extension(arguments.out) != "vti") {
    throw Error("--out: " + arguments.out + " does not end in .vti");
  }
  write_vti(ReachMap(arguments.map), arguments.out);
  return {.text = "written       " + arguments.out + "\n",
          .document = {{"status", "written"}, {"out", arguments.out}}};
}

}  // namespace

Verb reach_export_verb() {
  const auto shared = std::make_shared<MapExportArguments>();
  MapExportArguments& arguments = *shared;
  return {.name = "export",
          .summary = "Write a map for ParaView",
          .description =
              "Writes the positions of a map as an image of VTK, .vti, which ParaView opens: the "
              "fraction of the directions that is reached, and the largest number of branches, "
              "manipulability and margin of any orientation; the last two are nan where none is "
              "reached. The map itself is HDF5, which h5py reads.",
          .arguments = {map_argument(&arguments.map)},
          .options = {{.name = "--out",
                       .value = "FILE",
                       .help = "The positions, .vti.",
                       .target = &arguments.out,
                       .required = true,
                       .completes = Completes::file}},
          .examples = {{"A map for ParaView",
                        "beeline reach map puma560 --resolution 0.1 --out puma560.h5\n"
                        "beeline reach export puma560.h5 --out puma560.vti"}},
          .json = &arguments.json,
          .run = [shared] { return export_map(*shared); }};
}
