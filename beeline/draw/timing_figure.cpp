#include <algorithm>

#include <beeline/draw/internal/curve_sampling.h>
#include <beeline/draw/internal/deviation_charts.h>
#include <beeline/draw/internal/joint_charts.h>
#include <beeline/draw/internal/sheet.h>
#include <beeline/draw/timing_figure.h>
#include <beeline/error.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/manipulability.h>

namespace beeline {
using namespace internal;
namespace {

constexpr double plot_height = 76;

Chart condition_chart(const Arm& arm, const Trajectory& trajectory, const Task& task) {
  constexpr std::size_t max_points = 20'000;  // each point takes microseconds
  const double unit = internal::unit_of_length(arm);
  Chart chart{.heading = "inverse condition of the Jacobian",
              .x_name = "time [s]",
              .left_name = "0: singular",
              .curves = {{.colour = ink}},
              .from_zero = true};
  const double begin = trajectory.times.front(), end = trajectory.times.back();
  const std::size_t steps =
      trajectory.size() == 1 ? 0 : std::clamp<std::size_t>(trajectory.size() - 1, 600, max_points);
  CurveCollector points(chart.curves.front(), steps + 1);
  for (std::size_t k = 0; k <= steps; ++k) {
    const double fraction = steps == 0 ? 0 : static_cast<double>(k) / static_cast<double>(steps);
    const double t = begin + fraction * (end - begin);
    const Eigen::MatrixXd j = task_jacobian(arm, sample(trajectory, t).position, task, unit);
    points.add(t, 1 / manipulability_measures(j).condition);
  }
  points.finish();
  return chart;
}

Chart clearance_chart(const ClearanceOverTime& clearance) {
  const double required = clearance.clearance.value_or(0);
  Chart chart{.heading = "clearance",
              .x_name = "time [s]",
              .left_name = clearance.clearance ? "distance [m]" : "beyond it [m]",
              .from_zero = true};
  Curve sampled{.name = "sampled", .colour = amber, .width = 0.9};
  CurveCollector points(sampled, clearance.sampled.size());
  for (std::size_t i = 0; i < clearance.sampled.size(); ++i) {
    points.add(clearance.sample_times[i], clearance.sampled[i] + required);
  }
  points.finish();
  Curve proved{.name = "proved", .colour = ink, .width = 0.7};
  for (std::size_t i = 0; i < clearance.proved.size(); ++i) {
    const double bound = clearance.proved[i] + required;
    proved.x.insert(proved.x.end(), {clearance.times[i], clearance.times[i + 1]});
    proved.y.insert(proved.y.end(), {bound, bound});
  }
  chart.curves = {std::move(sampled), std::move(proved)};
  chart.reference_lines = {{"required", required}};
  return chart;
}

/// Returns the trail above the charts of the deviation, with total height `height` points.
ChartColumn path_column(const Arm& arm, const Trajectory& trajectory, const FollowedPath& followed,
                        double height) {
  ChartColumn column{.plot_width = 340};
  const PathTrace trace = trace_path(arm, trajectory, followed);
  column.charts = deviation_charts(trace, followed);
  double taken = 56;  // points: margins of the trail, tick labels of the charts
  for (std::size_t i = 0; i < column.charts.size(); ++i) taken += plot_height + 24;
  Figure trail = exaggerated_figure(arm, trace, followed, exaggeration(trace));
  trail.width = column.plot_width + 24;  // with the charts' tick labels
  trail.height = std::max(140.0, height - taken);
  column.above = compose(trail);
  return column;
}

std::vector<double> waypoint_times(const Trajectory& trajectory,
                                   const TimingFigureOptions& options) {
  if (!options.waypoint_times.empty() || !options.path) return options.waypoint_times;
  std::vector<double> times;
  for (const double s : placed_waypoints(*options.path).path_parameters) {
    const std::optional<double> time = time_at(trajectory, *options.path, s);
    if (time) times.push_back(*time);
  }
  return times;
}

std::string extent_of(const Trajectory& trajectory) {
  return number(trajectory.times.back() - trajectory.times.front()) + " s, " +
         std::to_string(trajectory.size()) + (trajectory.size() == 1 ? " sample" : " samples");
}

void add_legend(const Trajectory& trajectory, Sheet& sheet) {
  for (const std::string& name : trajectory.joint_names) {
    sheet.legend.push_back(joint_curve(name, static_cast<int>(sheet.legend.size())));
  }
}

}  // namespace

Picture timing_figure(const Trajectory& trajectory, const std::string& title) {
  check_trajectory(trajectory);
  if (trajectory.times.empty()) throw Error("a motion without samples cannot be drawn");
  Sheet sheet{.title = title.empty() ? extent_of(trajectory) : title, .plot_height = plot_height};
  add_legend(trajectory, sheet);
  sheet.columns.push_back({.charts = joint_charts(trajectory)});
  return compose(sheet);
}

Picture timing_figure(const Arm& arm, const Trajectory& given, const TimingFigureOptions& options) {
  const Trajectory trajectory = matched_to(arm, given);
  if (trajectory.times.empty()) throw Error("a motion without samples cannot be drawn");
  const Task task = options.task   ? *options.task
                    : options.path ? options.path->task
                                   : default_task(arm);
  Sheet sheet{.title = options.title, .plot_height = plot_height};
  if (sheet.title.empty()) sheet.title = arm.name() + ": " + extent_of(trajectory);
  add_legend(trajectory, sheet);
  ChartColumn over_time{.charts = joint_charts(arm, trajectory)};
  over_time.charts.push_back(tool_speed_chart(arm, trajectory));
  over_time.charts.push_back(condition_chart(arm, trajectory, task));
  if (options.clearance && !options.clearance->proved.empty()) {
    over_time.charts.push_back(clearance_chart(*options.clearance));
  }
  add_numbered_markers(over_time.charts, waypoint_times(trajectory, options));
  const double height = static_cast<double>(over_time.charts.size()) * (plot_height + 20) + 30;
  sheet.columns.push_back(std::move(over_time));
  if (options.path) {
    sheet.columns.push_back(path_column(arm, trajectory, *options.path, height));
  }
  return compose(sheet);
}

}  // namespace beeline
