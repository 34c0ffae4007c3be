#pragma once

#include <beeline/draw/internal/chart.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Returns the line style of joint k (from 0): distinct_colour(k), and other dashes for each
/// further eight joints.
Curve joint_curve(const std::string& name, int k);

/// Charts positions, velocities and accelerations of all joints over time, for the motion that the
/// columns mean, also between the samples. A joint with a known limit is drawn in percent of it
/// (positions: of the range, from -100 at the lower limit to 100 at the upper), so that joints can
/// be compared. Joints without a limit use a scale on the right, with thick lines, if both kinds
/// occur. Accelerations of linear motions are divided differences, drawn as a step plot. A chart
/// without data is omitted. The trajectory is in the arm's joint order.
std::vector<Chart> joint_charts(const Arm& arm, const Trajectory& trajectory);

/// Charts a trajectory without its arm, in rad or m and s. Its limits are not known.
std::vector<Chart> joint_charts(const Trajectory& trajectory);

/// Charts the speed of the tool's origin over time, m/s, also between the samples.
Chart tool_speed_chart(const Arm& arm, const Trajectory& trajectory);

}  // namespace beeline::internal
