#include <fmt/format.h>
#include <memory>

#include <beeline/draw/figure.h>
#include <beeline/draw/timing_figure.h>
#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/numbers.h>
#include <beeline/reach/surface.h>

#include "command/verb.h"
#include "format.h"
#include "plane_argument.h"
#include "reach_totals.h"
#include "result_files.h"
#include "verbs.h"

namespace beeline::command {
namespace {

struct SliceArguments {
  std::string map, out;
  PlaneArgument plane;
};

/// One row for each cell: the centre and the value, nan where it is not reached.
std::string csv_of(const ReachSlice& slice) {
  std::string text = "x,y,z," + name(slice.measure) + "\n";
  for (Eigen::Index i = 0; i < slice.values.rows(); ++i) {
    for (Eigen::Index j = 0; j < slice.values.cols(); ++j) {
      Vector3 centre;
      centre[slice.normal] = slice.at;
      centre[slice.axes[0]] = slice.grid[0].centre(i);
      centre[slice.axes[1]] = slice.grid[1].centre(j);
      for (const double c : centre) text += exact(c) + ",";
      text += exact(static_cast<double>(slice.values(i, j))) + "\n";
    }
  }
  return text;
}

Answer write_slice(const SliceArguments& arguments) {
  refuse_overwriting(arguments.out, {arguments.map});
  const std::string ending = extension(arguments.out);
  const bool csv = ending == "csv";
  if (!csv && ending != "svg" && ending != "png" && ending != "pdf") {
    throw Error("--out: \"" + arguments.out + "\" must end in .svg, .png, .pdf or .csv");
  }
  const ReachMap map(arguments.map);
  const ReachSlice slice =
      slice_of(map, arguments.plane.normal(), arguments.plane.at(), arguments.plane.measure());
  if (csv) {
    write_file(arguments.out, csv_of(slice));
  } else {
    save(reach_figure(slice), arguments.out);
  }
  const auto reached = (!slice.values.array().isNaN()).count();
  const std::string plane = fmt::format("{}={}", "xyz"[slice.normal], shown(slice.at));
  Answer answer{.text = fmt::format("slice         {} at {}, {} of {} positions reached\n",
                                    arguments.out, plane, reached, slice.values.size()),
                .document = {{"status", "written"},
                             {"out", arguments.out},
                             {"at", slice.at},
                             {"positions", slice.values.size()},
                             {"reached", reached},
                             {"map_scene", scene_document(map)}}};
  if (const auto& scene = map.header().scene) {
    answer.text += "free in       " + scene_name(*scene) + "\n";
  }
  return answer;
}

}  // namespace

Verb reach_slice_verb() {
  const auto arguments = std::make_shared<SliceArguments>();
  return {.name = "slice",
          .summary = "Draw the positions of a map in a plane, or write them as numbers",
          .description =
              "Draws the cells of a map around a plane perpendicular to an axis of the world, with "
              "the arm, or writes them to a .csv file: a row x,y,z,value for each, nan where the "
              "arm reaches no orientation. The value is the best of the orientations at a "
              "position; directions are their fraction that is reached.",
          .arguments = {map_argument(&arguments->map)},
          .options = joined(
              {arguments->plane.options(),
               {Option("--out FILE", "The picture, .svg, .png or .pdf, or the numbers, .csv.",
                       &arguments->out, {.required = true})}}),
          .examples = {{"How freely an arm can turn its tool at the height of its shoulder",
                        "beeline reach map puma560 --resolution 0.1 --out puma560.h5\n"
                        "beeline reach slice puma560.h5 --at z=0.2 --out slice.svg"}},
          .run = [arguments] { return write_slice(*arguments); }};
}

}  // namespace beeline::command
