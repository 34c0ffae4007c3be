#include "path_argument.h"

#include <beeline/error.h>
#include <beeline/motion/path/corner.h>

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
  if (round) return route_of(rounded_lines(poses, {*round, *round / metres_of_a_radian}));
  return route_of(straight() ? lines_through(poses) : path_through(poses, path), path);
}

Route PathArgument::from(const Pose& tool, std::vector<Pose> poses, const Task& task,
                         const Deviation& near) const {
  const bool there = !straight() && within(task_deviation(task, poses.front(), tool), near);
  if (!there) poses.insert(poses.begin(), tool);
  return through(poses);
}
