#include <algorithm>
#include <cmath>

#include <beeline/draw/deviation_charts.h>
#include <beeline/draw/text.h>
#include <beeline/draw/trail.h>
#include <beeline/error.h>

namespace beeline {
namespace {

constexpr double rounding = 1e-12;  // metres or radians, below which a deviation is none

/// A unit in which the size is between 1 and 1000.
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

/// Arcs from sample to sample so narrow that they would run into each other on paper.
bool dense(const PathTrace& trace) { return trace.steps.size() > 150; }

/// All places or, of a dense trace, that place of each step which is farthest off; of very many
/// steps, that of some together.
std::vector<std::size_t> shown_places(const PathTrace& trace, const auto& off) {
  constexpr std::size_t most = 1500;
  const std::size_t together = 1 + trace.steps.size() / most;
  const auto group = [&](std::size_t i) {
    return (trace.places[i].step + together - 1) / together;
  };
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < trace.places.size(); ++i) {
    const bool begins = trace.places[i].step == 0;  // a piece
    const std::size_t before = begins ? 0 : group(i - 1);
    if (dense(trace) && !begins && (before == 0 || before == group(i))) {
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
  for (const PathTrace::Place& place : trace.places) largest = std::max(largest, place.off.*part);
  const Unit unit = unit_for(largest, base);
  Curve measured{.name = "measured", .colour = amber, .width = 0.9};
  for (const std::size_t i :
       shown_places(trace, [&](std::size_t k) { return trace.places[k].off.*part; })) {
    measured.x.push_back(trace.places[i].way);
    measured.y.push_back(trace.places[i].off.*part / unit.size);
  }
  Curve bound{.name = "proved", .colour = ink, .width = 0.7};
  for (const PathTrace::Step& step : trace.steps) {
    bound.x.insert(bound.x.end(), {step.from, step.to});
    bound.y.insert(bound.y.end(), {step.bound.*part / unit.size, step.bound.*part / unit.size});
  }
  Chart chart{.heading = dense(trace) ? "largest deviation" : "deviation",
              .x_name = trace.turns_only ? "way along the path [m; a turn: 0.01 m a radian]"
                                         : "way along the path [m]",
              .left_name = std::string(what) + " [" + unit.name + "]",
              .curves = {std::move(measured), std::move(bound)},
              .least = rounding / unit.size,
              .from_zero = true};
  if (followed.tolerance) chart.levels = {{"tolerance", (*followed.tolerance).*part / unit.size}};
  return chart;
}

std::vector<Vector3> enlarged(const PathTrace& trace, double factor) {
  std::vector<Vector3> points;
  for (const std::size_t i :
       shown_places(trace, [&](std::size_t k) { return trace.places[k].across.norm(); })) {
    points.emplace_back(trace.places[i].tool + (factor - 1) * trace.places[i].across);
  }
  return points;
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
  for (std::size_t w = 0; w < trace.ends.size(); ++w) {
    for (Chart& chart : charts) {
      const bool first = &chart == charts.data();
      chart.stations.push_back({trace.ends[w], first ? std::to_string(w + 1) : ""});
    }
  }
  return charts;
}

double exaggeration(const PathTrace& trace) {
  constexpr double share = 0.06;  // of the path's extent
  double most = 0;
  for (const PathTrace::Place& place : trace.places) most = std::max(most, place.across.norm());
  Vector3 low = trace.course.front(), high = low;
  for (const Vector3& point : trace.course) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  const double extent = (high - low).norm();
  if (most <= rounding * std::max(1.0, extent)) return 1;
  const double factor = share * extent / most;
  return factor > 2.5 ? round_step(factor / 2.5) : 1;
}

Figure exaggerated_figure(const Arm& arm, const PathTrace& trace, const FollowedPath& followed,
                          double factor) {
  Scene scene;
  scene.add(Layer::trail, Polyline{trace.course, Colour{0.45, 0.47, 0.5}, 0.7});
  scene.add(Layer::trail, Polyline{enlarged(trace, factor), amber, 0.9});
  scene.add(Layer::mark, Dots{{trace.course.front()}, ink, 5});
  std::vector<std::string> names;
  std::vector<Pose> waypoints;
  for (const Piece& piece : followed.path.pieces) {
    waypoints.push_back(pose_at(piece, 1));
    names.push_back(std::to_string(waypoints.size()));
  }
  add_poses(scene, waypoints, names);
  Panel panel{.scene = std::move(scene)};
  panel.view = arm.planar() ? top_view() : oblique_view(-0.87, 0.44);
  panel.caption = factor > 1 ? "tool's trail, its distance from the path × " + fixed(factor, 0) +
                                   (dense(trace) ? " (the most of each step)" : "")
                             : "tool's trail, to scale";
  Figure figure;
  figure.columns = {{std::move(panel)}};
  return figure;
}

}  // namespace beeline
