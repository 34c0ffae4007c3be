#include <algorithm>
#include <cmath>

#include <beeline/draw/internal/sheet.h>
#include <beeline/draw/timing_figure.h>
#include <beeline/error.h>

namespace beeline {
using namespace internal;
namespace {

/// Returns the response over time, percent.
Curve response(const NamedMotion& motion, const Configuration& goal, int number) {
  constexpr double widest = 300;  // percent
  const Trajectory& trajectory = motion.trajectory;
  if (trajectory.size() == 0) throw Error("a motion without samples cannot be drawn");
  const Configuration& start = trajectory.positions.front();
  if (start.size() != goal.size()) {
    throw Error("the goal has " + std::to_string(goal.size()) + " joint values, the motion " +
                std::to_string(start.size()));
  }
  const Configuration way = goal - start;
  if (!(way.squaredNorm() > 0)) throw Error("the goal is the start; a step response needs a step");
  Curve curve{.name = motion.name, .colour = distinct_colour(number), .width = 1.4};
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    const double part = (trajectory.positions[k] - start).dot(way) / way.squaredNorm();
    if (!(std::abs(100 * part) <= widest)) break;
    curve.x.push_back(trajectory.times[k] - trajectory.times.front());
    curve.y.push_back(100 * part);
  }
  return curve;
}

/// Returns the time after which the curve stays within half a percent of 100.
double settling_time(const Curve& curve) {
  for (std::size_t k = curve.y.size(); k-- > 0;) {
    if (std::abs(curve.y[k] - 100) > 0.5) return curve.x[std::min(k + 1, curve.x.size() - 1)];
  }
  return 0;
}

}  // namespace

Picture step_response_figure(const std::vector<NamedMotion>& motions, const Configuration& goal,
                             const std::string& title) {
  Chart chart{.heading = "distance towards the goal",
              .x_name = "time [s]",
              .left_name = "% of the way",
              .from_zero = true};
  double end = 0;
  for (const NamedMotion& motion : motions) {
    chart.curves.push_back(response(motion, goal, static_cast<int>(chart.curves.size())));
    end = std::max(end, settling_time(chart.curves.back()));
  }
  Sheet sheet{.title = title, .plot_height = 220};
  for (Curve& curve : chart.curves) {
    sheet.legend.push_back(curve);
    curve.name.clear();
    std::size_t count = 1;
    while (count < curve.x.size() && curve.x[count - 1] < end) ++count;
    curve.x.resize(count);
    curve.y.resize(count);
    if (curve.x.back() < end && std::abs(curve.y.back() - 100) <= 0.5) {  // it stays there
      curve.x.push_back(end);
      curve.y.push_back(curve.y.back());
    }
  }
  chart.reference_lines = {{"goal", 100}};
  sheet.columns.push_back({.charts = {chart}, .plot_width = 420});
  return compose(sheet);
}

}  // namespace beeline
