#pragma once

#include <span>
#include <vector>

#include <beeline/budget.h>
#include <beeline/error.h>
#include <beeline/model/arm.h>

namespace beeline {

/// A path in joint space, without time: at N grid points the configuration q and its derivatives
/// with respect to the path parameter s, which may have any unit. Between grid points it is the
/// quintic Hermite polynomial of the values at both ends.
struct JointPath {
  std::vector<double> s;           ///< path parameter, strictly increasing, (N,)
  std::vector<Configuration> q;    ///< rad or m
  std::vector<Configuration> dq;   ///< dq/ds
  std::vector<Configuration> ddq;  ///< d2q/ds2

  std::size_t size() const { return s.size(); }
};

/// Throws Error unless there are at least two grid points, all columns are as long as s and have
/// the same number of coordinates, all numbers are finite and s increases.
void check_path(const JointPath& path);

/// The configuration and its derivatives with respect to s at one path parameter.
struct PathPoint {
  Configuration q;     ///< rad or m
  Configuration dq;    ///< dq/ds
  Configuration ddq;   ///< d2q/ds2
  Configuration dddq;  ///< d3q/ds3
};

/// Evaluates the path in step k, between grid points k and k + 1, at the fraction u from 0 to 1.
PathPoint path_point(const JointPath& path, std::size_t step, double u);

/// Returns the cubic spline through the samples, twice continuously differentiable, with the
/// samples as grid points. Its end conditions are not-a-knot: the first two steps are one cubic, as
/// are the last two (de Boor, *A Practical Guide to Splines*, chapter IV). Three samples give a
/// parabola, two a line. parameter[k] belongs to sample k and increases. Throws Error when the
/// sizes differ.
JointPath joint_spline(std::span<const Configuration> samples, std::span<const double> parameter);

/// Makes the path four times continuously differentiable at its inner grid points by changing dq
/// and ddq there; positions, and the derivatives at both ends, remain. Throws Error as check_path()
/// does.
void smooth_derivatives(JointPath& path);

/// Arc length along the joint-space polyline, for each sample; 0 first. It does not increase
/// between equal samples.
std::vector<double> chord_length(std::span<const Configuration> samples);

struct RefineOptions {
  std::size_t min_steps = 400;  ///< each step is at most the path's length divided by this; above 0
  double max_change = 0.1;      ///< max change of dq/ds over a step, relative to |dq/ds|; above 0
  int max_parts = 512;          ///< max number of parts of one step, 1 or more
  Budget budget = {};           ///< a grid point is a unit of work
};

/// Returns the same path with more grid points. The grid points of `path` remain; steps that are
/// longer or curve more than the options allow are divided into equal parts. The result is empty if
/// the budget ends the computation. Also throws Error for more than 1e7 grid points.
JointPath refined(const JointPath& path, const RefineOptions& options = {});

}  // namespace beeline
