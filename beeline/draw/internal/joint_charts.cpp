#include <algorithm>
#include <cmath>

#include <beeline/draw/internal/joint_charts.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>

namespace beeline::internal {
namespace {

/// Values over time: linear between the times or, for a step plot, each constant from its time to
/// the next; a step plot has one time more than values.
struct Series {
  std::vector<double> times;
  std::vector<Configuration> values;
  bool step_plot = false;
};

Series differences(const Series& series) {
  Series result{series.times, {}, true};
  if (series.step_plot) {  // a step's value is taken at its middle
    for (std::size_t k = 0; k < series.values.size(); ++k) {
      result.times[k] = (series.times[k] + series.times[k + 1]) / 2;
    }
    result.times.pop_back();
  }
  for (std::size_t k = 1; k < series.values.size(); ++k) {
    const double dt = result.times[k] - result.times[k - 1];
    result.values.push_back((series.values[k] - series.values[k - 1]) / dt);
  }
  return result;
}

/// Adds the series of one coordinate to a curve.
void add_series(const Series& series, const auto& value_of, Curve& curve) {
  for (std::size_t k = 0; k < series.values.size(); ++k) {
    curve.x.push_back(series.times[k]);
    curve.y.push_back(value_of(series.values[k]));
    if (!series.step_plot) continue;
    curve.x.push_back(series.times[k + 1]);
    curve.y.push_back(curve.y.back());
  }
}

std::string text_of(const char* what, const Series& series) {
  return what + std::string(series.step_plot ? ", by differences" : "");
}

/// Maps values to fractions of a limit: (value - middle) / half; half is 0 without a limit.
struct LimitScale {
  double middle = 0, half = 0;
};

LimitScale limit_scale(const Limits& limits, double Limits::*kind) {
  if (kind == nullptr) {
    const double half = limits.upper / 2 - limits.lower / 2;
    const bool known = std::isfinite(half) && half > 0;
    return known ? LimitScale{limits.lower + half, half} : LimitScale{};
  }
  const bool known = std::isfinite(limits.*kind) && limits.*kind > 0;
  return {0, known ? limits.*kind : 0};
}

/// Returns the units of the joints without a limit: "rad/s", "m/s" or both.
std::string units_of(const Arm& arm, const std::vector<LimitScale>& scales, const char* per) {
  bool rotates = false, slides = false;
  for (std::size_t k = 0; k < scales.size(); ++k) {
    if (scales[k].half > 0) continue;
    const bool slide = kind(arm.joint_of(static_cast<int>(k))) == JointKind::prismatic;
    (slide ? slides : rotates) = true;
  }
  const std::string tail = per;
  if (rotates && slides) return "rad" + tail + ", m" + tail;
  return (slides ? "m" : "rad") + tail;
}

Chart chart_of(const Arm& arm, const Series& series, const char* what, const char* scaled_name,
               const char* per, double Limits::*kind) {
  Chart chart{.heading = text_of(what, series), .x_name = "time [s]"};
  std::vector<LimitScale> scales;
  for (const Limits& limits : arm.limits()) scales.push_back(limit_scale(limits, kind));
  const auto limited = [](const LimitScale& scale) { return scale.half > 0; };
  const bool some = std::any_of(scales.begin(), scales.end(), limited);
  const bool all = std::all_of(scales.begin(), scales.end(), limited);
  const std::string units = units_of(arm, scales, per);
  chart.left_name = some ? scaled_name : units;
  if (some && !all) chart.right_name = units + " (thick)";
  for (int k = 0; k < arm.dof(); ++k) {
    const LimitScale& scale = scales[k];
    Curve curve = joint_curve(arm, k);
    curve.name.clear();  // it is in the sheet's legend
    curve.right = some && !limited(scale);
    if (curve.right) curve.width = 1.8;
    add_series(
        series,
        [&](const Configuration& q) {
          return limited(scale) ? 100 * ((q[k] - scale.middle) / scale.half) : q[k];
        },
        curve);
    chart.curves.push_back(std::move(curve));
  }
  if (some) chart.reference_lines = {{"limit", 100}, {"", -100}};
  if (!all && kind == &Limits::velocity) {
    const double held = arm.limits(0).speed_scale * assumed_velocity_limit;
    chart.reference_lines.push_back({"no limit known: " + number(held) + " " + units, held, some});
    chart.reference_lines.push_back({"", -held, some});
  }
  return chart;
}

}  // namespace

Curve joint_curve(const Arm& arm, int k) {
  const std::vector<double> dashes[] = {{}, {5, 2}, {1.2, 1.6}, {6, 1.6, 1.2, 1.6}};
  return {.name = arm.joint_of(k).name, .colour = distinct_colour(k), .dashes = dashes[k / 8 % 4]};
}

std::vector<Chart> joint_charts(const Arm& arm, const Trajectory& trajectory) {
  const Series positions{trajectory.times, trajectory.positions};
  const Series velocities = trajectory.velocities.empty()
                                ? differences(positions)
                                : Series{trajectory.times, trajectory.velocities};
  const Series accelerations = trajectory.accelerations.empty()
                                   ? differences(velocities)
                                   : Series{trajectory.times, trajectory.accelerations};
  std::vector<Chart> charts{
      chart_of(arm, positions, "joint positions", "% of the range", "", nullptr)};
  if (!velocities.values.empty()) {
    charts.push_back(
        chart_of(arm, velocities, "joint velocities", "% of the limit", "/s", &Limits::velocity));
  }
  if (!accelerations.values.empty()) {
    charts.push_back(chart_of(arm, accelerations, "joint accelerations", "% of the limit", "/s²",
                              &Limits::acceleration));
  }
  return charts;
}

Chart tool_speed_chart(const Arm& arm, const Trajectory& trajectory) {
  Series speeds{trajectory.times, {}, trajectory.velocities.empty()};
  const auto speed = [](double value) { return Configuration::Constant(1, value); };
  Jacobian columns(6, arm.dof());
  Vector3 before = Vector3::Zero();
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    const Vector3 tool = jacobian(arm, trajectory.positions[k], columns).translation();
    if (!speeds.step_plot) {
      speeds.values.push_back(speed((columns.topRows<3>() * trajectory.velocities[k]).norm()));
    } else if (k > 0) {
      speeds.values.push_back(
          speed((tool - before).norm() / (trajectory.times[k] - trajectory.times[k - 1])));
    }
    before = tool;
  }
  Chart chart{.heading = text_of("tool speed", speeds),
              .x_name = "time [s]",
              .left_name = "m/s",
              .curves = {{.colour = ink}},
              .from_zero = true};
  add_series(
      speeds, [](const Configuration& v) { return v[0]; }, chart.curves[0]);
  return chart;
}

}  // namespace beeline::internal
