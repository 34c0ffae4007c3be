#pragma once

#include <span>

#include <beeline/kinematics/internal/taylor_bound.h>
#include <beeline/math/polynomial.h>
#include <beeline/model/arm.h>

namespace beeline::internal {

/// Bounds on the Taylor coefficients of a polynomial on [from, to], by its derivatives' Bernstein
/// coefficients there.
TaylorBound taylor_bound(const Polynomial& p, double from = 0, double to = 1);

/// Bounds on the Taylor coefficients of the tool's pose while the coordinates are polynomials of u
/// from 0 to 1; metres.
struct ToolTaylorBound {
  TaylorBound position;     ///< of the tool's origin; c[0] is not set
  TaylorBound orientation;  ///< of its rotation matrix, in the operator norm
};

/// Let r_j be the vector from the axis of joint j to the tool's origin in the frame before the
/// joint, so r_j = exp([z_j]x q_j) (c_j + r_(j+1)) with a constant c_j. By Leibniz's rule and
/// exponential() its derivatives are bounded by the derivatives of r_(j+1) and q_j and by the
/// tool's distance from the axis, which is at most its value at u = 1/2 plus half of the bound on
/// |r_(j+1)'|.
ToolTaylorBound tool_taylor_bound(const Arm& arm, std::span<const Polynomial> coordinates);

}  // namespace beeline::internal
