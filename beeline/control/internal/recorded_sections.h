#pragma once

#include <vector>

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// The samples of a recording from one stop to the next.
struct RecordedSection {
  std::size_t begin = 0, end = 0;
  bool rests = false;  ///< whether it is a dwell: the joints stay within 1e-5 rad or m
};

/// Divides a recording at its stops. A stop is a sample with
///
/// - known velocities: the velocity is below 1e-9 of the recording's largest. Or it counts as rest
///   (see end_velocity.h) and is below a tenth of the velocities at the samples beside it;
/// - linear joints: the velocities of the two intervals beside it count as rest, and they are below
///   2/3 of the velocities in the next intervals, differ in direction, or one of them is zero.
///
/// Among consecutive stops within 1e-5 rad or m, such as noise at rest, only the first and the last
/// count. Fewer than two samples have no sections.
std::vector<RecordedSection> sections_between_stops(const Arm& arm, const Trajectory& recording);

}  // namespace beeline::internal
