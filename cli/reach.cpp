#include <memory>

#include <beeline/reach/reach.h>
#include <beeline/reach/reach_map.h>

#include "reach_totals.h"
#include "result_files.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct MergeArguments {
  std::vector<std::string> parts;
  std::string out;
  bool incomplete = false;
};

Verb merge_verb() {
  const auto arguments = std::make_shared<MergeArguments>();
  return {
      .name = "merge",
      .summary = "Join files that hold parts of one map",
      .description =
          "Joins the parts that `beeline reach map --shard` computed. The cells are copied as they "
          "are stored: the datasets equal a map computed in one piece. Parts may overlap.",
      .arguments = {{.name = "PART",
                     .help = "Files with parts of the same map.",
                     .completes = Completes::file,
                     .targets = &arguments->parts}},
      .options = {Option("--out FILE", "The map, an HDF5 file.", &arguments->out,
                         {.required = true}),
                  Option("--incomplete", "Join parts that are not yet the whole map.",
                         &arguments->incomplete)},
      .examples = {{"Two halves of a map",
                    "beeline reach map ur5 --resolution 0.2 --shard 1/2 --out half1.h5\n"
                    "beeline reach map ur5 --resolution 0.2 --shard 2/2 --out half2.h5\n"
                    "beeline reach merge half1.h5 half2.h5 --out ur5.h5"}},
      .run = [arguments] {
        refuse_overwriting(arguments->out, arguments->parts);
        merge_reach_maps(arguments->parts, arguments->out, arguments->incomplete);
        return map_totals(ReachMap(arguments->out));
      }};
}

}  // namespace

Verb reach_verb() {
  Verb verb{.name = "reach", .summary = "Maps of what an arm can do: compute, join, query"};
  verb.description =
      "A reach map answers, for each cell of a grid over positions and orientations of the tool: "
      "does the arm reach it, in how many branches, with what manipulability and margin to its "
      "joint limits?";
  verb.examples = {{"A map, and a question",
                    "beeline reach map puma560 --resolution 0.12 --out puma560.h5\n"
                    "beeline reach query puma560.h5 --pose 0.5,0.1,0.3,180,0,0 --degrees"}};
  verb.verbs = {reach_map_verb(),     merge_verb(),       reach_query_verb(), reach_slice_verb(),
                reach_compare_verb(), reach_place_verb(), reach_export_verb()};
  return verb;
}

}  // namespace beeline::command
