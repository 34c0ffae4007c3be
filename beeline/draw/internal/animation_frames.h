#pragma once

#include <beeline/draw/animation.h>
#include <beeline/draw/internal/keyframes.h>

namespace beeline::internal {

/// Returns when each frame is shown.
Timeline timeline_of(const Animation& animation, const PlaybackOptions& options);

/// Returns when the animation's time t is shown, as a fraction of the loop.
double fraction_at(const Animation& animation, const PlaybackOptions& options, double t);

}  // namespace beeline::internal
