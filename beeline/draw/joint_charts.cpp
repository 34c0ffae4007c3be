#include <algorithm>
#include <cmath>

#include <beeline/draw/joint_charts.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/jacobian.h>

namespace beeline {
namespace {

/// Values in straight lines between times, or, as stairs, each from its time to the next one, of
/// which there is one more than values.
struct Course {
  std::vector<double> times;
  std::vector<Configuration> values;
  bool stairs = false;
};

Course differences(const Course& course) {
  Course result{course.times, {}, true};
  if (course.stairs) {  // a stair's value is that of its middle
    for (std::size_t k = 0; k < course.values.size(); ++k) {
      result.times[k] = (course.times[k] + course.times[k + 1]) / 2;
    }
    result.times.pop_back();
  }
  for (std::size_t k = 1; k < course.values.size(); ++k) {
    const double dt = result.times[k] - result.times[k - 1];
    result.values.push_back((course.values[k] - course.values[k - 1]) / dt);
  }
  return result;
}

/// Fills in the curve of one coordinate.
void draw_course(const Course& course, const auto& value_of, Curve& curve) {
  for (std::size_t k = 0; k < course.values.size(); ++k) {
    curve.x.push_back(course.times[k]);
    curve.y.push_back(value_of(course.values[k]));
    if (!course.stairs) continue;
    curve.x.push_back(course.times[k + 1]);
    curve.y.push_back(curve.y.back());
  }
}

std::string text_of(const char* what, const Course& course) {
  return what + std::string(course.stairs ? ", by differences" : "");
}

/// What a joint's value is divided by, after `middle` is taken away; 0 where there is no limit.
struct Share {
  double middle = 0, half = 0;
};

Share share_of(const Limits& limits, double Limits::*kind) {
  if (kind == nullptr) {
    const double half = limits.upper / 2 - limits.lower / 2;
    const bool known = std::isfinite(half) && half > 0;
    return known ? Share{limits.lower + half, half} : Share{};
  }
  const bool known = std::isfinite(limits.*kind) && limits.*kind > 0;
  return {0, known ? limits.*kind : 0};
}

/// "rad/s", "m/s" or both, of those joints that have no limit.
std::string units_of(const Arm& arm, const std::vector<Share>& shares, const char* per) {
  bool turns = false, slides = false;
  for (std::size_t k = 0; k < shares.size(); ++k) {
    if (shares[k].half > 0) continue;
    const bool slide = kind(arm.joint_of(static_cast<int>(k))) == JointKind::prismatic;
    (slide ? slides : turns) = true;
  }
  const std::string tail = per;
  if (turns && slides) return "rad" + tail + ", m" + tail;
  return (slides ? "m" : "rad") + tail;
}

Chart chart_of(const Arm& arm, const Course& course, const char* what, const char* share_name,
               const char* per, double Limits::*kind) {
  Chart chart{.heading = text_of(what, course), .x_name = "time [s]"};
  std::vector<Share> shares;
  for (const Limits& limits : arm.limits()) shares.push_back(share_of(limits, kind));
  const auto limited = [](const Share& share) { return share.half > 0; };
  const bool some = std::any_of(shares.begin(), shares.end(), limited);
  const bool all = std::all_of(shares.begin(), shares.end(), limited);
  const std::string units = units_of(arm, shares, per);
  chart.left_name = some ? share_name : units;
  if (some && !all) chart.right_name = units + " (thick)";
  for (int k = 0; k < arm.dof(); ++k) {
    const Share& share = shares[k];
    Curve curve = joint_curve(arm, k);
    curve.name.clear();  // it is in the sheet's key
    curve.right = some && !limited(share);
    if (curve.right) curve.width = 1.8;
    draw_course(
        course,
        [&](const Configuration& q) {
          return limited(share) ? 100 * ((q[k] - share.middle) / share.half) : q[k];
        },
        curve);
    chart.curves.push_back(std::move(curve));
  }
  if (some) chart.levels = {{"limit", 100}, {"", -100}};
  if (!all && kind == &Limits::velocity) {
    const double held = velocity_when_unknown;
    chart.levels.push_back({"no limit known: " + number(held) + " " + units, held, some});
    chart.levels.push_back({"", -held, some});
  }
  return chart;
}

}  // namespace

Curve joint_curve(const Arm& arm, int k) {
  const std::vector<double> dashes[] = {{}, {5, 2}, {1.2, 1.6}, {6, 1.6, 1.2, 1.6}};
  return {.name = arm.joint_of(k).name, .colour = distinct_colour(k), .dashes = dashes[k / 8 % 4]};
}

std::vector<Chart> joint_charts(const Arm& arm, const Trajectory& trajectory) {
  const Course positions{trajectory.times, trajectory.positions};
  const Course velocities = trajectory.velocities.empty()
                                ? differences(positions)
                                : Course{trajectory.times, trajectory.velocities};
  const Course accelerations = trajectory.accelerations.empty()
                                   ? differences(velocities)
                                   : Course{trajectory.times, trajectory.accelerations};
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
  Course speeds{trajectory.times, {}, trajectory.velocities.empty()};
  const auto speed = [](double value) { return Configuration::Constant(1, value); };
  Jacobian columns(6, arm.dof());
  Vector3 before = Vector3::Zero();
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    const Vector3 tool = jacobian(arm, trajectory.positions[k], columns).translation();
    if (!speeds.stairs) {
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
  draw_course(
      speeds, [](const Configuration& v) { return v[0]; }, chart.curves[0]);
  return chart;
}

}  // namespace beeline
