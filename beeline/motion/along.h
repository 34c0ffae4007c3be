#pragma once

#include <beeline/motion/line.h>
#include <beeline/motion/matched.h>
#include <beeline/motion/path/corner.h>

namespace beeline {

/// A path to be gone, and where the arm comes to rest on it.
struct Route {
  ToolPath path;
  std::vector<bool> stops;  ///< after each piece; the last is one whatever it says
};

/// Lines, screws and arcs stop where two of them meet; a spline goes through.
Route route_of(const ToolPath& path, PathKind kind);
/// Rounded lines stop at sharp corners only.
Route route_of(const RoundedPath& rounded);

/// Moves the tool along a path, certified as straight lines are: every sample solved to rounding,
/// the deviation from the path's pose at the share in proportion proved between samples. From
/// `start`, which must have the tool at the path's begin, or from the solution there from which the
/// arm goes farthest, then stays farthest from limits and singularities. `straightness` is
/// closeness() of the finished trajectory, `arrivals` the sample at each piece's end.
/// `options.rate`, `options.suggest` and `options.progress` do not count.
/// Throws Error for a start that is elsewhere or outside limits, and what check_matched() refuses.
LineMotion move_along(const Arm& arm, const std::optional<Configuration>& start, const Route& route,
                      const LineOptions& options = {});

}  // namespace beeline
