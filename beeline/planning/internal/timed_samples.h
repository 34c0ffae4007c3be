#pragma once

#include <functional>
#include <span>

#include <beeline/timing/retime.h>

namespace beeline {

/// Gives samples on a way their times and appends them to a trajectory, which ends at the first of
/// them: from rest to rest, as retime() does along the spline through them, and slower where their
/// own positions (slowdown_for_limits()) or the tool's speed between them need it. Every sample
/// stays as it is, and no other comes between; but with options.rate samples at equal times take
/// their place, which `brought` may move to where they belong; it is told Retimed::ways. Where
/// nothing moves nothing is appended. Returns why there is no such motion; empty when it was
/// appended.
std::string append_timed(
    Trajectory& trajectory, const Arm& arm, std::span<const Configuration> samples,
    const RetimeOptions& options,
    const std::function<void(Trajectory&, std::span<const double>)>& brought = {});

/// Makes a motion last longer by a factor; one below 1 changes nothing.
void slow_down(Trajectory& motion, double factor);

/// The most speed of the tool's origin between samples, joints in proportion: metres a second.
double largest_tool_speed(const Arm& arm, const Trajectory& motion);

/// Appends a motion that begins where the trajectory ends.
void append(Trajectory& trajectory, const Trajectory& motion);

}  // namespace beeline
