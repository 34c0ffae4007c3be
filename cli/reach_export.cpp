#include <beeline/error.h>
#include <beeline/reach/vti_file.h>
#include <beeline/read/internal/file.h>

#include "command/verb.h"
#include "reach_totals.h"
#include "result_files.h"
#include "verbs.h"

using namespace beeline;

namespace {

struct ImageArguments {
  std::string map, out;
  bool json = false;
};

Answer write_image(const ImageArguments& arguments) {
  refuse_overwriting(arguments.out, {arguments.map});
  if (internal::extension(arguments.out) != "vti") {
    throw Error("--out: " + arguments.out + " has none of the endings .vti");
  }
  write_vti(ReachMap(arguments.map), arguments.out);
  return {.text = "image         " + arguments.out + "\n",
          .document = {{"status", "written"}, {"out", arguments.out}}};
}

}  // namespace

Verb reach_export_verb() {
  static ImageArguments arguments;
  return {.name = "export",
          .summary = "Write the positions of a map for ParaView",
          .description =
              "Writes the positions of a map as an image of VTK, .vti, which ParaView opens: the "
              "fraction of the directions that is reached, and the largest number of branches, "
              "manipulability and margin of any orientation; the last two are nan where none is "
              "reached.",
          .arguments = {map_argument(&arguments.map)},
          .options = {{.name = "--out",
                       .value = "FILE",
                       .help = "The image, .vti.",
                       .target = &arguments.out,
                       .required = true,
                       .completes = Completes::file}},
          .examples = {{"A map for ParaView",
                        "beeline reach map puma560 --resolution 0.1 --out puma560.h5\n"
                        "beeline reach export puma560.h5 --out puma560.vti"}},
          .json = &arguments.json,
          .run = [] { return write_image(arguments); }};
}
