#pragma once

#include <beeline/draw/chart.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline {

/// How joint k (from 0) is drawn: distinct_colour(k), and dashed otherwise from the ninth on.
Curve joint_curve(const Arm& arm, int k);

/// Positions, velocities and accelerations of all joints over time. A joint that has a limit of the
/// kind is shown in percent of it (of its range: from -100 at the lower end to 100 at the upper),
/// so that joints with different limits can be compared; the others, where there are both, thick,
/// by a scale on the right. Velocities and accelerations that the trajectory does not have are the
/// divided differences of what they are the derivative of, as stairs; a chart of which nothing is
/// known is left out. The trajectory is in the arm's order.
std::vector<Chart> joint_charts(const Arm& arm, const Trajectory& trajectory);

/// The speed of the tool's origin over time.
Chart tool_speed_chart(const Arm& arm, const Trajectory& trajectory);

}  // namespace beeline
