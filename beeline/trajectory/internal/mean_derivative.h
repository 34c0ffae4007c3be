#pragma once

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// A lower bound on the largest magnitude of a coordinate's derivative of the given order (1, 2 or
/// 3) for any smooth motion through samples k to k + order: their divided difference times order!,
/// which is a weighted mean of that derivative (the weight is a B-spline), minus its rounding
/// error. Not negative; 0 if there are too few samples.
double mean_derivative(const Trajectory& trajectory, std::size_t k, int coordinate, int order);

/// Throws Error unless the trajectory has as many joints as the arm, and check_trajectory().
void check_fits(const Arm& arm, const Trajectory& trajectory);

}  // namespace beeline::internal
