#pragma once

#include <limits>
#include <vector>

namespace beeline {

/// Squares of ds/dt.
struct SquaredSpeeds {
  double least = 0, most = 0;
  bool none() const { return !(least <= most); }
};

/// Constraints |along x + across y| <= 1 on two squared speeds x and y.
struct Strips {
  std::vector<double> along, across;
};

/// The pairs (x, y) of squared speeds at the begin and the end of one step of a path's grid that
/// keep some strips. With x, y >= 0 that is a convex polygon, which has the origin inside; what is
/// asked of it are linear programs of two variables, answered by walking over its edges. It sees
/// `count` strips from number `first` on; nothing allocates but the constructor.
class StepPolygon {
 public:
  StepPolygon(const Strips& strips, std::size_t count)
      : strips_(strips), count_(count), p_(count), m_(count) {}

  void go_to(std::size_t first) { first_ = first; }

  /// The x, up to `most`, from which some y of `ends` can be reached.
  SquaredSpeeds begins(SquaredSpeeds ends, double most);

  /// The largest y of `ends` to which x leads; rounding may have left none, then the nearest.
  double furthest_end(double x, SquaredSpeeds ends) const;

 private:
  struct Edge {
    double p = std::numeric_limits<double>::max(), m = 0;
    double at(double y) const { return p - m * y; }
  };
  Edge edge(double y, double side) const;
  double summit(SquaredSpeeds ends, double side, double enough) const;
  double retreat(double y) const;

  const Strips& strips_;
  std::size_t first_ = 0, count_ = 0, edges_ = 0;
  std::vector<double> p_, m_;  ///< edges x <= p - m y and, mirrored in the origin, x >= -p - m y
};

}  // namespace beeline
