#pragma once

#include <beeline/draw/internal/chart.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Returns the line style of joint k (from 0): distinct_colour(k), and other dashes for each
/// further eight joints.
Curve joint_curve(const std::string& name, int k);

/// Charts positions, velocities and accelerations of all joints over time, of the motion that the
/// columns mean, also between the samples. A joint with a known limit is drawn in percent of it
/// (positions: of the range, from -100 at the lower limit to 100 at the upper), so that joints can
/// be compared; joints without one use a scale on the right, thick, when both kinds occur.
/// Accelerations of linear motions are divided differences, drawn as a step plot; a chart without
/// data is omitted. The trajectory is in the arm's joint order.
std::vector<Chart> joint_charts(const Arm& arm, const Trajectory& trajectory);

/// Charts the same of a trajectory alone, in rad or m and s; its limits are not known.
std::vector<Chart> joint_charts(const Trajectory& trajectory);

/// Charts the speed of the tool's origin over time, m/s, also between the samples.
Chart tool_speed_chart(const Arm& arm, const Trajectory& trajectory);

}  // namespace beeline::internal
