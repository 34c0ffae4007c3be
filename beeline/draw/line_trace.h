#pragma once

#include <optional>
#include <span>
#include <vector>

#include <beeline/kinematics/task.h>

namespace beeline {

/// The lines that a motion was to follow: from its own first pose through the waypoints.
struct FollowedLines {
  std::vector<Pose> waypoints;
  std::vector<std::size_t> arrivals;  ///< the sample at each waypoint
  Task task;
  std::optional<Deviation> tolerance = std::nullopt;
};

/// How the tool went along its lines, measured at the samples and at equal parts between them,
/// joints in proportion.
struct LineTrace {
  /// One place at which it was measured.
  struct Place {
    std::size_t step = 0;              ///< between which samples; 0: the beginning of a line
    double way = 0;                    ///< along the lines, metres
    Deviation off;                     ///< from the line, see deviation_from()
    Vector3 tool = Vector3::Zero();    ///< in the world, metres
    Vector3 across = Vector3::Zero();  ///< of `tool`, what the deviation's position is the size of
  };
  /// From one sample to the next.
  struct Step {
    double from = 0, to = 0;  ///< the way
    Deviation bound;          ///< step_bound()
  };
  std::vector<Place> places;
  std::vector<Step> steps;
  std::vector<double> ends;      ///< the way at each waypoint
  std::vector<Vector3> corners;  ///< where the lines begin and end: one more than waypoints
  bool turns_only = false;  ///< a line is told by its turn, and as long as way_of_a_radian says
};

/// Throws Error when sizes do not fit, as straightness() does.
LineTrace trace_lines(const Arm& arm, std::span<const Configuration> samples,
                      const FollowedLines& lines);

}  // namespace beeline
