#pragma once

#include <functional>
#include <span>
#include <string>

#include <beeline/timing/retime.h>

namespace beeline::internal {

/// Moves samples at equal times to where they belong; it is given Retimed::arc_lengths.
using MoveSamples = std::function<void(Trajectory&, std::span<const double>)>;

/// Retimes samples from rest to rest, as retime() does along the spline through them, and appends
/// them to a trajectory that ends at the first one. Slows the motion down where the samples'
/// slowdown_for_limits() or the bound on the tool's speed between them need it.
/// Keeps every sample and adds none, unless options.rate asks for samples at equal times; `move`
/// may then move these. Appends nothing where nothing moves. Returns why there is no such motion;
/// empty when there is.
std::string append_retimed(Trajectory& trajectory, const Arm& arm,
                           std::span<const Configuration> samples, const RetimeOptions& options,
                           const MoveSamples& move = {});

}  // namespace beeline::internal
