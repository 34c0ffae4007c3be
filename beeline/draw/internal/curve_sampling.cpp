#include <algorithm>
#include <array>
#include <cmath>

#include <beeline/draw/internal/curve_sampling.h>
#include <beeline/trajectory/internal/interval_polynomial.h>

namespace beeline::internal {
namespace {

constexpr std::size_t max_chart_points = 8000, max_parts = 40;  // a chart does not resolve more

using Values = std::array<double, max_parts + 1>;

/// Replaces the lowest and the highest inner values by the extremes of the polynomial.
void include_extremes(const Polynomial& p, std::size_t parts, Values& values) {
  const auto begin = values.begin(), end = begin + static_cast<std::ptrdiff_t>(parts) + 1;
  const auto [lowest, highest] = std::minmax_element(begin, end);
  const Extremes bounds = enclosure(p);
  if (!(bounds.smallest < *lowest || bounds.largest > *highest) || parts < 2) return;
  const Extremes exact = extremes(p);
  const auto inside = [&](Values::iterator at) {
    return std::clamp(at, begin + 1, begin + static_cast<std::ptrdiff_t>(parts) - 1);
  };
  const bool lower = exact.smallest<*lowest, higher = exact.largest> * highest;
  const auto low_at = inside(lowest), high_at = inside(highest);
  if (lower) *low_at = exact.smallest;
  if (higher) *high_at = exact.largest;
}

}  // namespace

CurveCollector::CurveCollector(Curve& curve, std::size_t expected)
    : curve_(curve), group_size_(1 + 4 * expected / max_chart_points) {
  if (expected <= max_chart_points) group_size_ = 1;
}

void CurveCollector::add(double x, double y) {
  group_.push_back({x, y});
  if (group_.size() >= group_size_) finish();
}

void CurveCollector::finish() {
  if (group_.empty()) return;
  const auto higher = [](const Point& a, const Point& b) { return a.y < b.y; };
  const auto low = std::min_element(group_.begin(), group_.end(), higher);
  const auto high = std::max_element(group_.begin(), group_.end(), higher);
  std::array<std::ptrdiff_t, 4> kept{0, low - group_.begin(), high - group_.begin(),
                                     static_cast<std::ptrdiff_t>(group_.size()) - 1};
  std::sort(kept.begin(), kept.end());
  std::ptrdiff_t before = -1;
  for (const std::ptrdiff_t i : kept) {
    if (i == before) continue;
    before = i;
    curve_.x.push_back(group_[static_cast<std::size_t>(i)].x);
    curve_.y.push_back(group_[static_cast<std::size_t>(i)].y);
  }
  group_.clear();
}

std::size_t parts_of_interval(std::size_t intervals) {
  return std::clamp<std::size_t>(2000 / std::max<std::size_t>(intervals, 1), 3, max_parts);
}

void add_derivative(const Trajectory& trajectory, Eigen::Index coordinate, int order, double middle,
                    double unit, Curve& curve) {
  const std::size_t intervals = trajectory.size() - 1, parts = parts_of_interval(intervals);
  CurveCollector points(curve, intervals * (parts + 1));
  if (intervals == 0) {
    const auto& column = order == 0   ? trajectory.positions
                         : order == 1 ? trajectory.velocities
                                      : trajectory.accelerations;
    if (!column.empty()) points.add(trajectory.times[0], (column[0][coordinate] - middle) / unit);
  }
  Values values{};
  for (std::size_t k = 0; k < intervals; ++k) {
    const double h = trajectory.times[k + 1] - trajectory.times[k];
    const Polynomial p = time_derivative(interval_polynomial(trajectory, k, coordinate), order, h);
    const auto fraction = [parts](std::size_t i) {
      return static_cast<double>(i) / static_cast<double>(parts);
    };
    for (std::size_t i = 0; i <= parts; ++i) values[i] = p(fraction(i));
    include_extremes(p, parts, values);
    for (std::size_t i = 0; i <= parts; ++i) {
      points.add(trajectory.times[k] + fraction(i) * h, (values[i] - middle) / unit);
    }
  }
  points.finish();
}

}  // namespace beeline::internal
