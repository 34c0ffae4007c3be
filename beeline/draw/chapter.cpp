#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <beeline/control/cartesian.h>
#include <beeline/control/joint.h>
#include <beeline/draw/arm_figure.h>
#include <beeline/draw/internal/animation_frames.h>
#include <beeline/draw/internal/annotation.h>
#include <beeline/draw/internal/arm_drawing.h>
#include <beeline/draw/internal/concept_figures.h>
#include <beeline/draw/internal/text.h>
#include <beeline/draw/internal/trail.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>

namespace beeline {
using namespace internal;
namespace {

constexpr double degree = std::numbers::pi / 180;

Configuration degrees(double a, double b, double c) { return degree * Eigen::Vector3d(a, b, c); }

std::vector<Pose> waypoints_1_9() {
  std::vector<Pose> waypoints;
  for (const Pose2& waypoint : figure_1_9_waypoints()) waypoints.push_back(to_space(waypoint));
  return waypoints;
}

/// Figure 1.6: the worked example's two configurations.
Figure figure_1_6(const Arm& arm) {
  Figure figure;
  for (const auto& [letter, q] :
       {std::pair{"(a)", degrees(112, -52, -60)}, std::pair{"(b)", degrees(60, -45, -90)}}) {
    Panel panel;
    add_arm(panel.drawing, arm, q);
    add_joint_angles(panel.drawing, arm, q, 0.9);
    panel.caption = letter + (" " + angles_text(q)) + "\ntool at " + tool_text(arm, q);
    figure.columns.push_back({panel});
  }
  return figure;
}

/// Returns how many twentieths of a second a motion lasts.
std::size_t twentieths_of(const Trajectory& trajectory) {
  return static_cast<std::size_t>(std::round(20 * trajectory.times.back()));
}

/// A motion with the start's faded arm, the trail, the goals and the caption of its figure.
struct FigureMotion {
  Trajectory trajectory;
  std::vector<Pose> goals;
  std::vector<std::string> names;
  std::string caption;
  TrailStyle trail;
};

/// Draws the still part of a moving figure.
Panel still_panel(const Arm& arm, const FigureMotion& motion, bool growing) {
  const Configuration& start = motion.trajectory.positions.front();
  Panel panel;
  add_arm(panel.drawing, arm, start, {.faded = true});
  add_trail(panel.drawing, arm, motion.trajectory, {motion.trail.dots, growing});
  add_poses(panel.drawing, motion.goals, motion.names);
  panel.drawing.add(Layer::note, Label{forward_kinematics(arm, start).translation(), "start"});
  panel.caption = motion.caption;
  return panel;
}

/// Figure 1.7: joint-space control makes a curved trail; the spacing of its dots shows the speed.
FigureMotion motion_1_7(const Arm& arm) {
  const Configuration goal = degrees(99.2, -68.8, -30.4);
  const Trajectory trajectory = figure_1_7_motion();
  return {trajectory,
          {forward_kinematics(arm, goal)},
          {"goal " + tool_text(arm, goal)},
          "eq. 1.3 from rest to " + angles_text(goal),
          {.dots = trajectory.size()}};  // one dot a step
}

/// Figure 1.9: Cartesian control makes a straight trail.
FigureMotion motion_1_9(const Arm& /*arm*/) {
  return {figure_1_9_motion(),
          waypoints_1_9(),
          {},
          "eq. 1.6 from " + angles_text(figure_1_9_start()) + " through three waypoints",
          {.dots = 200}};
}

Figure still_figure(const Arm& arm, const FigureMotion& motion) {
  Panel panel = still_panel(arm, motion, false);
  add_arm(panel.drawing, arm, motion.trajectory.positions.back(), {.tool = false});
  Figure figure;
  figure.columns = {{panel}};
  return figure;
}

Figure figure_1_7(const Arm& arm) { return still_figure(arm, motion_1_7(arm)); }
Figure figure_1_9(const Arm& arm) { return still_figure(arm, motion_1_9(arm)); }

/// Figure 1.8: the columns of the Jacobian, at one scale for both configurations.
Figure figure_1_8(const Arm& arm) {
  Figure figure;
  const Configuration left = degrees(0, 90, 0);
  for (const Configuration& q : {left, degrees(161, -109, 38)}) {
    Panel panel;
    add_arm(panel.drawing, arm, q, {.tool = false});
    add_jacobian_arrows(panel.drawing, arm, q, jacobian_arrow_scale(arm, left), true);
    panel.caption = angles_text(q);
    figure.columns.push_back({panel});
  }
  return figure;
}

/// The waypoints of Figure 1.9 by certified motions in minimum time: along straight lines with a
/// stop at each waypoint, and along one spline without a stop.
Figure figure_splines(const Arm& arm) {
  const std::vector<Pose> waypoints = waypoints_1_9();
  std::vector<Pose> poses = waypoints;
  const Configuration start = figure_1_9_start();
  poses.insert(poses.begin(), forward_kinematics(arm, start));
  Figure figure;
  for (const PathKind path : {PathKind::line, PathKind::spline}) {
    const ToolPath through =
        path == PathKind::line ? lines_through(poses) : path_through(poses, path);
    const PathMotion motion = move_along(arm, start, route_of(through, path));
    Panel panel;
    add_arm(panel.drawing, arm, start, {.faded = true});
    add_arm(panel.drawing, arm, motion.trajectory.positions.back(), {.tool = false});
    add_trail(panel.drawing, arm, motion.trajectory,
              {.dots = 1 + twentieths_of(motion.trajectory)});
    add_poses(panel.drawing, waypoints);
    panel.caption = (path == PathKind::line ? "straight lines, a stop at each waypoint: "
                                            : "one spline, no stop: ") +
                    fixed(motion.trajectory.times.back(), 2) + " s; a dot each 0.05 s";
    figure.columns.push_back({panel});
  }
  figure.width = 620;
  return figure;
}

struct Entry {
  std::string_view number;
  Figure (*draw)(const Arm& arm);
};

constexpr std::array<Entry, 10> entries{{{"1.1", figure_1_1},
                                         {"1.2", figure_1_2},
                                         {"1.3", figure_1_3},
                                         {"1.4", figure_1_4},
                                         {"1.5", figure_1_5},
                                         {"1.6", figure_1_6},
                                         {"1.7", figure_1_7},
                                         {"1.8", figure_1_8},
                                         {"1.9", figure_1_9},
                                         {"splines", figure_splines}}};

}  // namespace

std::vector<std::string> chapter_figures() {
  std::vector<std::string> numbers;
  for (const Entry& entry : entries) numbers.emplace_back(entry.number);
  return numbers;
}

Figure chapter_figure(std::string_view number) {
  for (const Entry& entry : entries) {
    if (entry.number == number) return entry.draw(built_in("rrr"));
  }
  throw unknown_name("figure", number, chapter_figures());
}

Animation chapter_animation(std::string_view number) {
  const std::vector<std::string> moving{"1.7", "1.9"};
  if (std::find(moving.begin(), moving.end(), number) == moving.end()) {
    throw unknown_name("animated figure", number, moving);
  }
  const Arm arm = built_in("rrr");
  const FigureMotion motion = number == "1.7" ? motion_1_7(arm) : motion_1_9(arm);
  Animation animation = motion_frames(
      motion.trajectory,
      [&](Drawing& frame, double, const Configuration& q) { add_arm(frame, arm, q); });
  animation.figure.columns = {{still_panel(arm, motion, true)}};
  return animation;
}

Trajectory figure_1_7_motion() {
  SimulationOptions until_visible;
  until_visible.tolerance = 2e-3;  // radians; a smaller error is not visible
  until_visible.time_step = 0.05;
  return control_joints(built_in("rrr"), degrees(0, 0, 0), degrees(99.2, -68.8, -30.4), {.kp = 0.1},
                        until_visible)
      .trajectory;
}

Configuration figure_1_9_start() { return degrees(0, 90, 0); }

std::vector<Pose2> figure_1_9_waypoints() {
  return {{6, 2.5, 30 * degree}, {-0.5, 6.5, 120 * degree}, {-4, 2.5, 180 * degree}};
}

Trajectory figure_1_9_motion() {
  CartesianOptions options;
  options.gain = 0.01;  // small: the deviation between steps is proportional to the gain
  options.simulation.tolerance = 2e-3;
  options.simulation.time_step = 0.005;
  return control_in_lines(built_in("rrr"), figure_1_9_start(), waypoints_1_9(), options).trajectory;
}

}  // namespace beeline
