#include <algorithm>
#include <cmath>

#include <beeline/draw/internal/curve_sampling.h>
#include <beeline/draw/internal/joint_charts.h>
#include <beeline/error.h>
#include <beeline/kinematics/jacobian.h>
#include <beeline/trajectory/internal/interval_polynomial.h>

namespace beeline::internal {
namespace {

/// Returns the highest order of derivative, 0 to 2, of the motion between the samples.
int highest_order(const Trajectory& trajectory) { return trajectory.velocities.empty() ? 1 : 2; }

/// Returns whether the chart of a derivative has data.
bool has_data(const Trajectory& trajectory, int order) {
  if (order == 0) return true;
  if (trajectory.size() > 1) return order <= highest_order(trajectory) || trajectory.size() > 2;
  return !(order == 1 ? trajectory.velocities : trajectory.accelerations).empty();
}

/// Adds the divided differences of the velocities of linear motions, as a step plot.
void add_acceleration_steps(const Trajectory& trajectory, int joint, double unit, Curve& curve) {
  CurveCollector points(curve, 2 * trajectory.size());
  const auto time = [&](std::size_t k) {
    return (trajectory.times[k] + trajectory.times[k + 1]) / 2;
  };
  const auto velocity = [&](std::size_t k) {
    return (trajectory.positions[k + 1][joint] - trajectory.positions[k][joint]) /
           (trajectory.times[k + 1] - trajectory.times[k]);
  };
  for (std::size_t k = 0; k + 2 < trajectory.size(); ++k) {
    const double value = (velocity(k + 1) - velocity(k)) / (time(k + 1) - time(k)) / unit;
    points.add(time(k), value);
    points.add(time(k + 1), value);
  }
  points.finish();
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

/// The quantity of the joints that a chart shows.
struct Quantity {
  int order = 0;
  const char* name;
  const char* scaled_name;
  const char* per;
  double Limits::*limit;
};

const Quantity quantities[] = {
    {0, "joint positions", "% of the range", "", nullptr},
    {1, "joint velocities", "% of the limit", "/s", &Limits::velocity},
    {2, "joint accelerations", "% of the limit", "/s²", &Limits::acceleration}};

/// A chart without curves.
Chart empty_chart(const Trajectory& trajectory, const Quantity& quantity) {
  const bool by_differences = quantity.order > highest_order(trajectory);
  return {.heading = quantity.name + std::string(by_differences ? ", by differences" : ""),
          .x_name = "time [s]"};
}

/// Adds (value - middle) / unit of joint k to its curve.
void add_values(const Trajectory& trajectory, int k, const Quantity& quantity, double middle,
                double unit, Curve& curve) {
  if (quantity.order > highest_order(trajectory)) {
    add_acceleration_steps(trajectory, k, unit, curve);
  } else {
    add_derivative(trajectory, k, quantity.order, middle, unit, curve);
  }
}

Chart chart_of(const Arm& arm, const Trajectory& trajectory, const Quantity& quantity) {
  Chart chart = empty_chart(trajectory, quantity);
  std::vector<LimitScale> scales;
  for (const Limits& limits : arm.limits()) scales.push_back(limit_scale(limits, quantity.limit));
  const auto limited = [](const LimitScale& scale) { return scale.half > 0; };
  const bool some = std::any_of(scales.begin(), scales.end(), limited);
  const bool all = std::all_of(scales.begin(), scales.end(), limited);
  const std::string units = units_of(arm, scales, quantity.per);
  chart.left_name = some ? quantity.scaled_name : units;
  if (some && !all) chart.right_name = units + " (thick)";
  for (int k = 0; k < arm.dof(); ++k) {
    const LimitScale& scale = scales[k];
    Curve curve = joint_curve("", k);  // the name is in the sheet's legend
    curve.right = some && !limited(scale);
    if (curve.right) curve.width = 1.8;
    const double middle = limited(scale) ? scale.middle : 0;
    const double unit = limited(scale) ? scale.half / 100 : 1;
    add_values(trajectory, k, quantity, middle, unit, curve);
    chart.curves.push_back(std::move(curve));
  }
  if (some) chart.reference_lines = {{"limit", 100}, {"", -100}};
  if (!all && quantity.order == 1) {
    const double held = arm.limits(0).speed_scale * assumed_velocity_limit;
    chart.reference_lines.push_back({"no limit known: " + number(held) + " " + units, held, some});
    chart.reference_lines.push_back({"", -held, some});
  }
  return chart;
}

}  // namespace

Curve joint_curve(const std::string& name, int k) {
  const std::vector<double> dashes[] = {{}, {5, 2}, {1.2, 1.6}, {6, 1.6, 1.2, 1.6}};
  return {.name = name, .colour = distinct_colour(k), .dashes = dashes[k / 8 % 4]};
}

std::vector<Chart> joint_charts(const Arm& arm, const Trajectory& trajectory) {
  std::vector<Chart> charts;
  for (const Quantity& quantity : quantities) {
    if (has_data(trajectory, quantity.order)) charts.push_back(chart_of(arm, trajectory, quantity));
  }
  return charts;
}

std::vector<Chart> joint_charts(const Trajectory& trajectory) {
  std::vector<Chart> charts;
  for (const Quantity& quantity : quantities) {
    if (!has_data(trajectory, quantity.order)) continue;
    charts.push_back(empty_chart(trajectory, quantity));
    charts.back().left_name = "rad" + std::string(quantity.per) + ", m" + quantity.per;
    for (int k = 0; k < trajectory.positions.front().size(); ++k) {
      charts.back().curves.push_back(joint_curve("", k));
      add_values(trajectory, k, quantity, 0, 1, charts.back().curves.back());
    }
  }
  return charts;
}

Chart tool_speed_chart(const Arm& arm, const Trajectory& trajectory) {
  Chart chart{.heading = "tool speed",
              .x_name = "time [s]",
              .left_name = "m/s",
              .curves = {{.colour = ink}},
              .from_zero = true};
  const std::size_t intervals = trajectory.size() - 1, parts = parts_of_interval(intervals);
  CurveCollector points(chart.curves[0], intervals * (parts + 1));
  Jacobian columns(6, arm.dof());
  Configuration q = trajectory.positions.front(), velocity = Configuration::Zero(arm.dof());
  std::vector<Polynomial> position_of(static_cast<std::size_t>(arm.dof())),
      velocity_of = position_of;
  const auto add = [&](double t) {
    jacobian(arm, q, columns);
    points.add(t, (columns.topRows<3>() * velocity).norm());
  };
  if (intervals == 0) {
    if (!trajectory.velocities.empty()) velocity = trajectory.velocities.front();
    add(trajectory.times.front());
  }
  for (std::size_t k = 0; k < intervals; ++k) {
    const double h = trajectory.times[k + 1] - trajectory.times[k];
    for (int i = 0; i < arm.dof(); ++i) {
      const auto joint = static_cast<std::size_t>(i);
      position_of[joint] = interval_polynomial(trajectory, k, i);
      velocity_of[joint] = time_derivative(position_of[joint], 1, h);
    }
    for (std::size_t part = 0; part <= parts; ++part) {
      const double u = static_cast<double>(part) / static_cast<double>(parts);
      for (int i = 0; i < arm.dof(); ++i) {
        q[i] = position_of[static_cast<std::size_t>(i)](u);
        velocity[i] = velocity_of[static_cast<std::size_t>(i)](u);
      }
      add(trajectory.times[k] + u * h);
    }
  }
  points.finish();
  return chart;
}

}  // namespace beeline::internal
