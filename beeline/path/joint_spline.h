#pragma once

#include <span>

#include <beeline/path/joint_path.h>

namespace beeline {

/// The cubic spline through the samples, twice continuously differentiable, with the samples as
/// grid points. At both ends not-a-knot: the first two steps are one cubic, as are the last two (de
/// Boor, A Practical Guide to Splines, chapter IV); three samples make a parabola, two a line.
/// `parameter[k]` belongs to sample k and increases. Throws Error when they do not fit each other.
JointPath joint_spline(std::span<const Configuration> samples, std::span<const double> parameter);

/// How far it is along the straight joint lines from sample to sample: 0 first. Where samples
/// repeat it does not increase.
std::vector<double> chord_length(std::span<const Configuration> samples);

}  // namespace beeline
