#include <algorithm>
#include <cmath>
#include <numbers>

#include <beeline/draw/internal/deviation_charts.h>
#include <beeline/draw/internal/projection.h>
#include <beeline/draw/internal/text.h>
#include <beeline/draw/internal/trail.h>
#include <beeline/error.h>

namespace beeline::internal {
namespace {

constexpr double rounding = 1e-12;  // metres or radians; smaller deviations count as zero

/// A unit in which a value is between 1 and 1000.
struct Unit {
  double size = 1;
  std::string name;
};

Unit unit_for(double size, const std::string& base) {
  const char* prefixes[] = {"", "m", "µ", "n", "p"};
  Unit unit{1, base};
  for (const char* prefix : prefixes) {
    unit.name = prefix + base;
    if (size >= unit.size) break;
    if (*prefix != 'p') unit.size /= 1000;
  }
  return unit;
}

/// Returns whether the steps are too narrow to be resolved on paper.
bool dense(const PathTrace& trace) { return trace.steps.size() > 150; }

/// Returns the points to draw: all points. For a dense trace, returns the one with the largest
/// deviation of each step or group of steps, and the ends of the segments.
std::vector<std::size_t> shown_points(const PathTrace& trace, const auto& off) {
  constexpr std::size_t max_groups = 1500;
  const std::size_t together = 1 + trace.steps.size() / max_groups;
  const auto group = [&](std::size_t i) {
    return (trace.points[i].step + together - 1) / together;
  };
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < trace.points.size(); ++i) {
    const bool begins = trace.points[i].step == 0;  // the beginning of a segment
    const bool ends = i + 1 == trace.points.size() || trace.points[i + 1].step == 0;
    const bool inside = !begins && !ends && trace.points[i - 1].step != 0;
    if (dense(trace) && inside && group(i - 1) == group(i)) {
      if (off(i) > off(shown.back())) shown.back() = i;
    } else {
      shown.push_back(i);
    }
  }
  return shown;
}

Chart chart_of(const PathTrace& trace, const FollowedPath& followed, double Deviation::*part,
               const char* what, const char* base) {
  double largest = rounding;
  for (const PathTrace::Step& step : trace.steps) largest = std::max(largest, step.bound.*part);
  for (const PathTrace::Point& point : trace.points)
    largest = std::max(largest, point.deviation.*part);
  const Unit unit = unit_for(largest, base);
  Curve measured{.name = "measured", .colour = amber, .width = 0.9};
  for (const std::size_t i :
       shown_points(trace, [&](std::size_t k) { return trace.points[k].deviation.*part; })) {
    measured.x.push_back(trace.points[i].arc_length);
    measured.y.push_back(trace.points[i].deviation.*part / unit.size);
  }
  Curve bound{.name = "proved", .colour = ink, .width = 0.7};
  for (const PathTrace::Step& step : trace.steps) {
    bound.x.insert(bound.x.end(), {step.from, step.to});
    bound.y.insert(bound.y.end(), {step.bound.*part / unit.size, step.bound.*part / unit.size});
  }
  Chart chart{.heading = dense(trace) ? "largest deviation" : "deviation",
              .x_name = trace.has_pure_rotation ? "arc length of the path [m; rotation: 0.01 m/rad]"
                                                : "arc length of the path [m]",
              .left_name = std::string(what) + " [" + unit.name + "]",
              .curves = {std::move(measured), std::move(bound)},
              .min_span = rounding / unit.size,
              .from_zero = true};
  if (followed.tolerance)
    chart.reference_lines = {{"tolerance", (*followed.tolerance).*part / unit.size}};
  return chart;
}

std::vector<Vector3> enlarged(const PathTrace& trace, double factor) {
  std::vector<Vector3> points;
  for (const std::size_t i : shown_points(
           trace, [&](std::size_t k) { return trace.points[k].deviation_vector.norm(); })) {
    points.emplace_back(trace.points[i].tool + (factor - 1) * trace.points[i].deviation_vector);
  }
  return points;
}

/// Returns the oblique view in which the line is longest on paper. The view of other figures is
/// preferred unless another is a tenth longer.
View widest_view(const std::vector<Vector3>& line) {
  constexpr double elevation = 0.44, azimuth = -0.87;
  constexpr int directions = 24;
  View best = oblique_view(azimuth, elevation);
  const auto length = [&line](const View& view) {
    double sum = 0;
    for (std::size_t i = 1; i < line.size(); ++i) {
      sum += (view.topRows<2>() * (line[i] - line[i - 1])).norm();
    }
    return sum;
  };
  double longest = 1.1 * length(best);
  for (int k = 1; k < directions; ++k) {
    const View view = oblique_view(azimuth + 2 * std::numbers::pi * k / directions, elevation);
    if (length(view) <= longest * (1 + 1e-9)) continue;
    longest = length(view);
    best = view;
  }
  return best;
}

}  // namespace

std::vector<Chart> deviation_charts(const PathTrace& trace, const FollowedPath& followed) {
  std::vector<Chart> charts;
  if (followed.task.positions() > 0) {
    charts.push_back(chart_of(trace, followed, &Deviation::position, "position", "m"));
  }
  if (followed.task.orientations() > 0) {
    charts.push_back(chart_of(trace, followed, &Deviation::orientation, "orientation", "rad"));
  }
  add_numbered_markers(charts, trace.waypoints);
  return charts;
}

double exaggeration(const PathTrace& trace) {
  constexpr double visible = 0.06;  // fraction of the extent of the path
  double largest = 0;
  for (const PathTrace::Point& point : trace.points)
    largest = std::max(largest, point.deviation_vector.norm());
  const double size = extent(trace.polyline);
  if (largest <= rounding * std::max(1.0, size)) return 1;
  const double factor = visible * size / largest;
  return factor > 2.5 ? round_step(factor / 2.5) : 1;
}

Figure exaggerated_figure(const Arm& arm, const PathTrace& trace, const FollowedPath& followed,
                          double factor) {
  Drawing drawing;
  drawing.add(Layer::trail, Polyline{trace.polyline, construction_grey, 0.7});
  const std::vector<Vector3> trail = enlarged(trace, factor);
  drawing.add(Layer::trail, Polyline{trail, amber, 0.9});
  drawing.add(Layer::mark, Dots{{trace.polyline.front()}, ink, 5});
  add_poses(drawing, placed_waypoints(followed).poses);
  Panel panel{.drawing = std::move(drawing)};
  panel.view = arm.planar() ? top_view() : widest_view(trail);
  panel.caption = factor > 1
                      ? "trail of the tool, its deviation from the path ×\u00a0" +
                            fixed(factor, 0) + (dense(trace) ? " (largest of each step)" : "")
                      : "trail of the tool, to scale";
  Figure figure;
  figure.columns = {{std::move(panel)}};
  figure.fill = true;
  return figure;
}

}  // namespace beeline::internal
