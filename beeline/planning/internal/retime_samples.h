#pragma once

#include <functional>
#include <span>
#include <string>

#include <beeline/timing/retime.h>

namespace beeline::internal {

/// Moves samples at equal times onto the path. The second argument is Retimed::arc_lengths.
using MoveSamples = std::function<void(Trajectory&, std::span<const double>)>;

/// Retimes samples from rest to rest, as retime() does along the spline through them, and appends
/// them to a trajectory that ends at the first one. Slows the motion down if slowdown_for_limits()
/// of the samples or the bound on the tool's speed between them requires it. Keeps every sample and
/// adds none, unless options.rate specifies samples at equal times; `move` may then move these.
/// Appends nothing if nothing moves. Returns the reason if there is no such motion, otherwise an
/// empty text.
std::string append_retimed(const Arm& arm, Trajectory& trajectory,
                           std::span<const Configuration> samples, const RetimeOptions& options,
                           const MoveSamples& move = {});

}  // namespace beeline::internal
