#pragma once

#include <functional>

#include <beeline/inverse/descent/numerical.h>
#include <beeline/motion/straightness.h>

namespace beeline {

/// How one straight line is to be followed.
struct FollowOptions {
  Deviation tolerance = {};  ///< most that the tool may leave the line by between samples
  std::size_t most_samples = 0;
  std::function<void(double)> progress =
      {};  ///< told the fraction of the line's time, now and then
};

struct Followed {
  std::vector<Configuration> samples;  ///< the start first
  std::vector<double> fractions;       ///< of the line's time (rest_to_rest), 0 first
  bool through() const { return fractions.back() == 1; }
};

/// The configurations from `start`, which has the tool at line.from, along the line as far as they
/// continue one another: each is solved to rounding from the one before it, within the bounds, and
/// step_bound() is within tolerance. Where it is not, steps are halved. A singular start is left to
/// the first side that works, in the order of the joints. Ends early where the arm
/// cannot go on, or with most_samples.
Followed follow(const Arm& arm, const Line& line, const Task& task, const Bounds& bounds,
                const Configuration& start, const FollowOptions& options);

}  // namespace beeline
