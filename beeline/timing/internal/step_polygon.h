#pragma once

#include <limits>
#include <vector>

namespace beeline::internal {

/// An interval of squared speeds (ds/dt)^2.
struct SquaredSpeeds {
  double min = 0, max = 0;
  bool none() const { return !(min <= max); }
};

/// Constraints |begin x + end y| <= 1 on the squared speeds x and y at the beginning and the
/// end of a step.
struct StepConstraints {
  std::vector<double> begin, end;  ///< coefficients of x and of y
};

/// The pairs (x, y) of squared speeds at the beginning and the end of one step of a path's grid
/// that satisfy the constraints of the step. With x, y >= 0 they form a convex polygon with the
/// origin inside. Each query is a linear program in two variables, solved by walking over the
/// edges. The polygon uses `count` constraints from number `first` on; only the constructor
/// allocates.
class StepPolygon {
 public:
  StepPolygon(const StepConstraints& constraints, std::size_t count)
      : constraints_(constraints), count_(count), p_(count), m_(count) {}

  /// Uses the constraints from number `first` on.
  void go_to(std::size_t first) { first_ = first; }

  /// Returns the interval of x, up to `max_begin`, from which some y in `ends` can be reached.
  SquaredSpeeds begins(SquaredSpeeds ends, double max_begin);

  /// Returns the largest y in `ends` that can be reached from x; the nearest one if there is none
  /// because of rounding.
  double furthest_end(double x, SquaredSpeeds ends) const;

 private:
  struct Edge {
    double p = std::numeric_limits<double>::max(), m = 0;
    double at(double y) const { return p - m * y; }
  };
  Edge edge(double y, double side) const;
  double max_vertex(SquaredSpeeds ends, double side, double enough) const;
  double largest_feasible(double y) const;

  const StepConstraints& constraints_;
  std::size_t first_ = 0, count_ = 0, edges_ = 0;
  std::vector<double> p_, m_;  ///< edges x <= p - m y and, by symmetry, x >= -p - m y
};

}  // namespace beeline::internal
