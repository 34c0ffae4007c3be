#pragma once

#include <optional>
#include <span>
#include <vector>

#include <beeline/certificate/path_deviation.h>

namespace beeline {

/// The path that a motion was to follow.
struct FollowedPath {
  ToolPath path;
  std::vector<double> places;  ///< on it, of the samples, as far as they follow it
  Task task;
  std::optional<Deviation> tolerance = std::nullopt;
};

/// How the tool went along its path, measured at the samples and at equal parts between them,
/// joints in proportion.
struct PathTrace {
  /// One place at which it was measured.
  struct Place {
    std::size_t step = 0;              ///< between which samples; 0: the beginning of a piece
    double way = 0;                    ///< along the path, metres
    Deviation off;                     ///< from the piece, see deviation_from()
    Vector3 tool = Vector3::Zero();    ///< in the world, metres
    Vector3 across = Vector3::Zero();  ///< of `tool`, what the deviation's position is the size of
  };
  /// From one sample to the next, or the part of it that is on one piece.
  struct Step {
    double from = 0, to = 0;  ///< the way
    Deviation bound;          ///< step_bound()
  };
  std::vector<Place> places;
  std::vector<Step> steps;
  std::vector<double> ends;     ///< the way at each piece's end
  std::vector<Vector3> course;  ///< the path as a polyline
  bool turns_only = false;  ///< a piece is told by its turn, and as long as way_of_a_radian says
};

/// Throws Error when sizes do not fit, as path_deviation() does.
PathTrace trace_path(const Arm& arm, std::span<const Configuration> samples,
                     const FollowedPath& followed);

}  // namespace beeline
