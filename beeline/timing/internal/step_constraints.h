#pragma once

#include <vector>

#include <beeline/path/joint_path.h>
#include <beeline/timing/time_scaling.h>

namespace beeline::internal {

/// An interval of squared speeds (ds/dt)^2.
struct SquaredSpeeds {
  double min = 0, max = 0;
  bool none() const { return !(min <= max); }
};

/// The limits of a path as constraints |begin x + end y| <= 1 on the squared speeds x and y at the
/// beginning and the end of each step of its grid. With x, y >= 0 the constraints of one step
/// enclose a convex polygon with the origin inside; each query is a linear program in two
/// variables.
///
/// With x and y, d2s/dt2 = (y - x) / 2h. A joint's acceleration q' d2s/dt2 + q'' (ds/dt)^2 is a
/// parabola in s where the path is cubic: within its limit where the three coefficients of its
/// Bernstein form are. Its velocity is kept at the ends by `largest`, and by constraints at the
/// quarters of the step, one for all joints. So a step has three rows of constraints, each with
/// one for each joint and one of the velocity, filled up with constraints that bound nothing.
struct StepConstraints {
  std::size_t joints = 0;
  std::size_t width = 0;                               ///< of a row: a multiple of eight
  std::vector<double> slowness, inverse_acceleration;  ///< inverses of the limits, a row
  std::vector<double> largest;  ///< squared speed at each grid point that the velocity limits allow
  std::vector<double> max_end;  ///< of each step: bound of y where x hardly matters
  std::vector<double> middle;   ///< for each step a row: dq/ds in its middle
  /// For each step four times three rows: p, m, w, r of the edges x <= p - m y, y <= w - r x and,
  /// by symmetry, x >= -p - m y.
  std::vector<double> edges;

  std::size_t constraints() const { return 3 * width; }  ///< of a step
  double* edges_of(std::size_t step) { return edges.data() + 4 * constraints() * step; }
  const double* edges_of(std::size_t step) const { return edges.data() + 4 * constraints() * step; }

  /// Whether a thread keeps the memory: see ThreadScratch.
  bool is_small() const { return edges.capacity() < 100'000; }
};

/// Sets the sizes and the limits for a path.
void begin_constraints(const JointPath& path, const PathLimits& limits,
                       StepConstraints& constraints);

/// Computes the constraints of the steps from `from` to before `to`, and `largest` up to the grid
/// point `to`. No squared speed is above `fastest`.
void set_constraints(const JointPath& path, const PathLimits& limits, double fastest,
                     std::size_t from, std::size_t to, StepConstraints& constraints);

/// Computes for the steps before `to` down to `from` the interval of x, up to the largest, from
/// which some y in speeds[k + 1] can be reached, as speeds[k]. Returns the first step for which
/// there is none, or `to`.
std::size_t controllable_speeds(const StepConstraints& constraints, std::size_t from,
                                std::size_t to, SquaredSpeeds* speeds);

/// Computes for the steps from `from` to before `to` the largest y in controllable[k + 1] that can
/// be reached from b[k], as b[k + 1]; the nearest one if there is none because of rounding. Returns
/// the first step along which the speed is zero, or `to`.
std::size_t largest_speeds(const StepConstraints& constraints, std::size_t from, std::size_t to,
                           const SquaredSpeeds* controllable, double* b);

/// Returns the largest square of the fraction of a velocity limit that is used between the quarters
/// of these steps, at which the constraints keep it; 0 if it is far below 1.
double squared_velocity_fraction(const JointPath& path, const StepConstraints& constraints,
                                 std::size_t from, std::size_t to, const double* b);

}  // namespace beeline::internal
