#pragma once

#include <span>

#include <beeline/motion/timing/trajectory.h>

namespace beeline {

/// Rest to rest with zero acceleration at both ends: the fraction of the way s at the fraction of
/// the time u, both in [0, 1]; 10 u^3 - 15 u^4 + 6 u^5.
double rest_to_rest(double u);

/// A motion from rest to rest, `samples[k]` at the fraction `fractions[k]` of its time (0 first, 1
/// last, increasing): gives each sample its time, so that the joint speeds between samples and the
/// accelerations and jerks told by their differences keep the arm's limits (unknown velocity limits
/// count as `velocity_when_unknown`), and the motion lasts at least `shortest` seconds.
/// Appends samples[1] and on to `trajectory`, which ends at samples[0]. Throws Error when samples
/// and fractions do not fit the arm and each other.
void append_timed(Trajectory& trajectory, const Arm& arm, std::span<const Configuration> samples,
                  std::span<const double> fractions, double shortest = 0);

}  // namespace beeline
