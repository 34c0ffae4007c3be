#include <algorithm>
#include <cmath>

#include <beeline/draw/internal/animation_frames.h>
#include <beeline/error.h>

namespace beeline::internal {
namespace {

void check_range(const char* name, double value, double low, double high) {
  if (value >= low && value <= high) return;
  throw Error(std::string(name) + " of an animation is " + number(value) + "; it must be from " +
              number(low) + " to " + number(high));
}

double loop_seconds(const Animation& animation, const PlaybackOptions& options) {
  const double duration = animation.times.back() - animation.times.front();
  return options.rest_before + duration / options.speed + options.rest_after;
}

}  // namespace

double fraction_at(const Animation& animation, const PlaybackOptions& options, double t) {
  const double since = (t - animation.times.front()) / options.speed;
  const double seconds = loop_seconds(animation, options);
  return seconds > 0 ? std::clamp((options.rest_before + since) / seconds, 0.0, 1.0) : 0;
}

Timeline timeline_of(const Animation& animation, const PlaybackOptions& options) {
  Timeline timeline;
  timeline.seconds = std::max(0.01, loop_seconds(animation, options));
  for (const double t : animation.times) {
    timeline.frames.push_back(fraction_at(animation, options, t));
  }
  return timeline;
}

Animation motion_frames(
    const Trajectory& trajectory,
    const std::function<void(Drawing& frame, double time, const Configuration& q)>& draw) {
  constexpr double rate = 50, max_steps = 999;
  const double begin = trajectory.times.front(), duration = trajectory.times.back() - begin;
  const int steps = static_cast<int>(std::min(max_steps, std::ceil(rate * duration)));
  Animation animation;
  for (int k = 0; k <= steps; ++k) {
    const double since = steps == 0 ? 0 : duration * k / steps, time = begin + since;
    animation.times.push_back(since);
    draw(animation.frames.emplace_back(), time, sample(trajectory, time).position);
  }
  return animation;
}

}  // namespace beeline::internal

namespace beeline {

void check_playback(const Animation& animation, const PlaybackOptions& options) {
  if (animation.frames.empty() || animation.frames.size() != animation.times.size()) {
    throw Error("an animation has " + std::to_string(animation.frames.size()) + " frames and " +
                std::to_string(animation.times.size()) +
                " times; it needs as many of both, one or more");
  }
  for (std::size_t k = 0; k < animation.times.size(); ++k) {
    const bool later = k == 0 || animation.times[k] > animation.times[k - 1];
    if (std::isfinite(animation.times[k]) && later) continue;
    throw Error("time " + number(animation.times[k]) + " of frame " + std::to_string(k) +
                " of an animation must be finite and after the one before");
  }
  internal::check_range("speed", options.speed, 1e-3, 1e3);
  internal::check_range("rest_before", options.rest_before, 0, 60);
  internal::check_range("rest_after", options.rest_after, 0, 60);
  internal::check_range("frames_per_second", options.frames_per_second, 1, 60);
  constexpr double longest = 86400;  // a day
  const double seconds = internal::loop_seconds(animation, options);
  if (!(seconds <= longest)) {
    throw Error("an animation of " + number(seconds) +
                " s is longer than a day; a playback speed of " + number(options.speed) +
                " is too slow for it");
  }
}

}  // namespace beeline
