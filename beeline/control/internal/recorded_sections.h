#pragma once

#include <vector>

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// The samples of a recording from one stop to the next.
struct RecordedSection {
  std::size_t begin = 0, end = 0;
  bool rests = false;  ///< it is a dwell: the joints stay within 1e-5 rad or m
};

/// Divides a recording at its stops. A stop is a sample with
///
/// - velocities known: a velocity below 1e-9 of the recording's largest, or one that counts as rest
///   (see end_velocity.h) and is below a tenth of those of the samples beside it;
/// - linear joints: velocities of the two intervals beside it that count as rest, and that are
///   below 2/3 of those of the next ones, differ in direction, or of which one is zero.
///
/// Of stops in a row within 1e-5 rad or m, such as noise at rest, only the first and the last
/// count. No sections for fewer than two samples.
std::vector<RecordedSection> sections_between_stops(const Arm& arm, const Trajectory& recording);

}  // namespace beeline::internal
