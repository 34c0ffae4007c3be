#pragma once

#include <functional>

#include <beeline/draw/animation.h>
#include <beeline/draw/internal/keyframes.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Returns the times at which the frames are shown.
Timeline timeline_of(const Animation& animation, const PlaybackOptions& options);

/// Returns the fraction of the loop at which the animation's time t is shown.
double fraction_at(const Animation& animation, const PlaybackOptions& options, double t);

/// Returns the frames of a motion, one each 1/50 s, at most 1000. `draw` adds the moving items to a
/// frame at a time of the trajectory.
Animation motion_frames(
    const Trajectory& trajectory,
    const std::function<void(Drawing& frame, double time, const Configuration& q)>& draw);

}  // namespace beeline::internal
