#pragma once

#include <array>

#include <beeline/draw/figure.h>
#include <beeline/reach/slice.h>

namespace beeline {

/// Draws a slice of a reach map: each position that is reached in the colour of its value, with a
/// scale beside it, and the arm.
Figure reach_figure(const ReachSlice& slice);

/// Draws slices of two maps beside each other, with one scale: of slices_of(), for example. Throws
/// Error for slices of different measures or planes.
Figure reach_figure(const std::array<ReachSlice, 2>& slices);

}  // namespace beeline
