#include "path_argument.h"

#include <beeline/error.h>
#include <beeline/path/blend.h>

using namespace beeline;

std::vector<const CLI::Option*> PathArgument::declare(CLI::App& verb, const std::string& before) {
  return {
      verb.add_option("--path", kind,
                      before +
                          "line; screw motions between the poses; arc, each through two more\n"
                          "poses, of the first of which the position counts; or spline through "
                          "them all")
          ->capture_default_str(),
      verb.add_option("--round", round,
                      before + "round the lines' corners and pass them without a stop, at no more "
                               "than\nthis from them, metres, and 5 rad for each metre")};
}

bool PathArgument::straight() const { return path_kind_named(kind) == PathKind::line && !round; }

Route PathArgument::through(std::span<const Pose> poses) const {
  const PathKind path = path_kind_named(kind);
  if (round && path != PathKind::line) {
    throw Error("--round goes with --path line, whose corners it rounds");
  }
  if (round) return route_of(blended_lines(poses, {*round, *round / metres_per_radian}));
  return route_of(straight() ? lines_through(poses) : path_through(poses, path), path);
}

Route PathArgument::from(const Pose& tool, std::vector<Pose> poses, const Task& task) const {
  constexpr Deviation rounding{1e-9, 1e-9}, there{1e-5, 1e-5};  // as joint values of six digits
  const Deviation off = task_deviation(task, poses.front(), tool);
  if (!straight() && within(off, there)) {
    if (!within(off, rounding)) poses.front() = tool;
    return through(poses);
  }
  if (path_kind_named(kind) == PathKind::arc && poses.size() % 2 == 1) {
    throw Error("the arm begins " + number(off.position) + " m and " + angle(off.orientation) +
                " away from the first pose, so that it counts as one more: arcs then need an even "
                "number of poses in the file");
  }
  poses.insert(poses.begin(), tool);
  return through(poses);
}
