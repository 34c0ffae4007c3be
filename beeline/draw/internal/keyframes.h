#pragma once

#include <span>
#include <string>
#include <vector>

#include <beeline/draw/internal/simplification.h>

namespace beeline::internal {

/// The times at which the frames of a looping animation are shown, as fractions of its loop:
/// increasing, in [0, 1].
struct Timeline {
  std::vector<double> frames;
  double seconds = 1;  ///< duration of the loop
};

/// Returns the frames of first..last to keep, such that linear interpolation in time between them
/// reproduces the others within `tolerance`. `distance(i, a, b, t)` is the distance of frame i from
/// the interpolation between frames a and b at the fraction t. The ends are kept.
std::vector<std::size_t> thinned_keyframes(const Timeline& timeline, std::size_t first,
                                           std::size_t last, double tolerance,
                                           const auto& distance) {
  return simplified(first, last, tolerance, [&](std::size_t i, std::size_t a, std::size_t b) {
    const double begin = timeline.frames[a];
    return distance(i, a, b, (timeline.frames[i] - begin) / (timeline.frames[b] - begin));
  });
}

/// Returns the attributes of an element that repeats with the loop and has these values at these
/// keyframes: dur, repeatCount, keyTimes, values.
std::string animation_values(const Timeline& timeline, std::span<const std::size_t> keyframes,
                             const std::vector<std::string>& values);

/// Returns the element that makes its parent visible from the time `begin` to `end`, fractions of
/// the loop; empty for all of it.
std::string visible_between(const Timeline& timeline, double begin, double end);

}  // namespace beeline::internal
