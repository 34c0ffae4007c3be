#pragma once

#include <span>
#include <vector>

#include <beeline/certificate/internal/segment_step.h>
#include <beeline/path/tool_path.h>

namespace beeline {

/// Throws Error unless step_bound() holds for the task: any along a line, for others see
/// check_matched().
void check_task(const Arm& arm, const Piece& piece, const Task& task);

/// Throws Error for a path without pieces, and unless step_bound() holds for each.
void check_task(const Arm& arm, const ToolPath& path, const Task& task);

/// Throws Error unless the route has pieces, for each its span and whether the arm stops behind it,
/// and what check_task() refuses.
void check_route(const Arm& arm, const Route& route, const Task& task);

bool all_lines(const ToolPath& path);

/// What matters of the piece does not move, but for 1e-9 m and rad.
bool stands_still(const Piece& piece, const Task& task);

/// How far `pose` is from the piece, as far as the task asks: from the nearest point of a line
/// (nearest_on_line.h), of other pieces from the pose at s.
Deviation deviation_from(const Piece& piece, double s, const Pose& pose, const Task& task);

/// The same for a place on the path.
Deviation deviation_from(const ToolPath& path, double place, const Pose& pose, const Task& task);

/// A bound on deviation_from() while every joint moves in proportion from one end of the step to
/// the other, and s does too: line_step_bound(), matched_step_bound(). Throws Error when a
/// configuration does not fit the arm.
Deviation step_bound(const Arm& arm, const Piece& piece, const Task& task, const StepEnd& a,
                     const StepEnd& b);

/// What a motion does between two samples on one piece of its path.
struct PieceStep {
  std::size_t piece = 0;
  Configuration q_a, q_b;
  double s_a = 0, s_b = 0;
};

/// The step from one place on the path to another that is not before it: where it goes over the end
/// of a piece, joints in proportion to ToolPath::spans, it is cut there.
std::vector<PieceStep> cut_at_pieces(const ToolPath& path, const Task& task,
                                     const ConfigurationRef& q_a, double place_a,
                                     const ConfigurationRef& q_b, double place_b);

/// A step's deviations at both ends and half-way, and its bound with these known: the lesser of
/// step_bound() and the larger of both halves' own, where what it cannot tell of a step is an
/// eighth.
struct MeasuredStep {
  Deviation begin, middle, end;
  Deviation bound;
};
MeasuredStep measured(const Arm& arm, const ToolPath& path, const Task& task,
                      const PieceStep& step);

/// Throws Error unless the places are on the path, in order.
void check_places(const ToolPath& path, std::span<const double> places);

/// How near a joint motion stays to its path, measured and proved.
struct PathDeviation {
  Deviation sampled;   ///< the largest deviation at the samples
  Deviation measured;  ///< at the samples and at places between them
  Deviation bound;     ///< proved: at no moment between samples, joints moving in proportion, more
};

/// `places[k]` is where on the path sample k is: pieces done, with a share of the next. On lines
/// the nearest point counts whatever the share; that they are gone to their ends verify() tells.
/// Throws Error when sizes do not fit, for places that are not on the path in order, and what
/// check_task() refuses.
PathDeviation path_deviation(const Arm& arm, std::span<const Configuration> samples,
                             std::span<const double> places, const ToolPath& path,
                             const Task& task);

/// The places of samples of which `arrivals[i]` is the one that reaches the end of piece i: between
/// these the nearest ones (nearest_place()); behind the last all are at its end. Throws Error when
/// arrivals are not among the samples, in order, or more than pieces.
std::vector<double> places_along(const Arm& arm, std::span<const Configuration> samples,
                                 const ToolPath& path, std::span<const std::size_t> arrivals,
                                 const Task& task);

/// The first sample at or behind the end of each piece, as far as the places go.
std::vector<std::size_t> arrivals(std::span<const double> places);

}  // namespace beeline
