#pragma once

#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// A lower bound on the largest magnitude of a coordinate's derivative of the given order (1, 2 or
/// 3) for any smooth motion through samples k to k + order: their divided difference times order!,
/// which is a weighted mean of that derivative (the weight is a B-spline), minus its rounding
/// error. Not negative; 0 if there are too few samples.
double mean_derivative(const Trajectory& trajectory, std::size_t k, int coordinate, int order);

/// The derivative of an order that the interpolation does not bound, as limits count it (planning,
/// replay and check alike): mean_derivative(), and for the acceleration of linear joints at least
///     |v_k+1 - v_k| / (2 min(h_k, h_k+1)),
/// v and h the velocity and duration of the two intervals: the velocity changes within the shorter
/// one on both sides of the sample between them. For equal intervals that is half of the divided
/// difference; it exceeds it where one is more than three times the other, as at a standstill of
/// two samples, which divided differences over the long interval do not show.
double needed_derivative(const Trajectory& trajectory, std::size_t k, int coordinate, int order);

/// Throws Error unless the trajectory has as many joints as the arm, and check_trajectory().
void check_fits(const Arm& arm, const Trajectory& trajectory);

}  // namespace beeline::internal
