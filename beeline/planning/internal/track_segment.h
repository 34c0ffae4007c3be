#pragma once

#include <functional>

#include <beeline/certificate/path_deviation.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>

namespace beeline {

/// How one segment of a path is to be followed.
struct TrackOptions {
  Deviation tolerance = {};  ///< most that the tool may leave it by between samples
  std::size_t max_samples = 0;
  /// Where there is a choice, the configuration at a fraction of the segment is taken next to this
  /// one; default: next to the sample before, joints to spare away from their limits.
  std::function<Configuration(double)> guide = {};
  std::function<void(double)> progress = {};  ///< told the fraction done, now and then
};

struct TrackedSegment {
  std::vector<Configuration> samples;  ///< the start first
  std::vector<double> fractions;  ///< of the segment: sample k has the tool at that point; 0 first
  PathDeviation deviation;        ///< sampled half-way between samples too
  bool through() const { return fractions.back() == 1; }
};

/// The configurations from `start`, which has the tool at the segment's begin, along it as far as
/// they continue one another: each is solved to rounding, within the bounds, and step_bound()
/// proves that on the way from the one before it the tool stays within the tolerance; steps are as
/// long as that allows. So there can be no jump to another branch between two samples, whatever its
/// size. A singular start is left to the first side that works, in the order of the joints. Ends
/// early where the arm cannot go on, or with max_samples. Throws Error for a start that is
/// elsewhere, and what check_task() refuses.
TrackedSegment track_segment(const Arm& arm, const Segment& segment, const Task& task,
                             const internal::Bounds& bounds, const Configuration& start,
                             const TrackOptions& options);

}  // namespace beeline
