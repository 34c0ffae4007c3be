#pragma once

#include <beeline/draw/internal/chart.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Collects the points of a curve in order. If many are expected, only the first, lowest, highest
/// and last of each group of neighbours are kept, so that no spike is lost.
class CurveCollector {
 public:
  CurveCollector(Curve& curve, std::size_t expected);
  void add(double x, double y);
  void finish();  ///< must be called at the end

 private:
  struct Point {
    double x = 0, y = 0;
  };
  Curve& curve_;
  std::size_t group_size_;
  std::vector<Point> group_;
};

/// Returns the number of parts into which each interval of a motion is divided for a chart.
std::size_t parts_of_interval(std::size_t intervals);

/// Adds a derivative of one coordinate to the curve, over time, for the motion that the columns
/// mean. The order is 0 for position, 1 for velocity, 2 for acceleration. Values are mapped to
/// (value - middle) / unit. The curve has the value on both sides of a sample and, exactly, the
/// extremes between two samples. The order must not exceed the degree of the interpolation.
void add_derivative(const Trajectory& trajectory, Eigen::Index coordinate, int order, double middle,
                    double unit, Curve& curve);

}  // namespace beeline::internal
