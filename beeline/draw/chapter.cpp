#include <array>
#include <numbers>

#include <beeline/control/cartesian.h>
#include <beeline/control/joint.h>
#include <beeline/draw/arm_figure.h>
#include <beeline/draw/chapter.h>
#include <beeline/draw/internal/annotation.h>
#include <beeline/draw/internal/arm_scene.h>
#include <beeline/draw/internal/text.h>
#include <beeline/draw/internal/trail.h>
#include <beeline/error.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

namespace beeline {
using namespace internal;
namespace {

constexpr double degree = std::numbers::pi / 180;

Configuration degrees(double a, double b, double c) { return degree * Eigen::Vector3d(a, b, c); }

std::string angles_text(const ConfigurationRef& q) {
  std::string text;
  for (int k = 0; k < q.size(); ++k) {
    text += (k == 0 ? "θ" : ", θ") + subscript(k + 1) + " = " + degrees_text(q[k]);
  }
  return text;
}

/// Figure 1.3: the arm at q = 0, and with joints 2 and 3 actuated.
Figure figure_1_3(const Arm& arm) {
  const Configuration turned = degrees(0, 50, -80);
  Panel rest, actuated;
  add_arm(rest.scene, arm, degrees(0, 0, 0), {.frames = true, .tool = false});
  rest.caption = "at rest: " + angles_text(degrees(0, 0, 0));
  add_arm(actuated.scene, arm, turned, {.frames = true, .tool = false});
  add_joint_angles(actuated.scene, arm, turned, 0.95);
  actuated.caption = "actuated: " + angles_text(turned);
  Figure figure;
  figure.columns = {{rest, actuated}};
  figure.width = 440;
  return figure;
}

/// Figure 1.6: the worked example's two configurations.
Figure figure_1_6(const Arm& arm) {
  Figure figure;
  for (const auto& [letter, q] :
       {std::pair{"(a)", degrees(112, -52, -60)}, std::pair{"(b)", degrees(60, -45, -90)}}) {
    Panel panel;
    add_arm(panel.scene, arm, q);
    add_joint_angles(panel.scene, arm, q, 0.9);
    panel.caption = letter + (" " + angles_text(q)) + "\ntool at " + tool_text(arm, q);
    figure.columns.push_back({panel});
  }
  return figure;
}

/// Figure 1.7: joint-space control makes a curved trail; the spacing of its dots shows the speed.
Figure figure_1_7(const Arm& arm) {
  const std::vector<Configuration> motion = figure_1_7_motion();
  const Configuration& start = motion.front();
  const Configuration goal = degrees(99.2, -68.8, -30.4);
  Panel panel;
  add_arm(panel.scene, arm, start, {.faded = true});
  add_arm(panel.scene, arm, motion.back(), {.tool = false});
  add_trail(panel.scene, tool_positions(arm, motion));
  add_poses(panel.scene, {forward_kinematics(arm, goal)}, {"goal " + tool_text(arm, goal)});
  panel.scene.add(Layer::note, Label{forward_kinematics(arm, start).translation(), "start"});
  panel.caption = "eq. 1.3 from rest to " + angles_text(goal);
  Figure figure;
  figure.columns = {{panel}};
  return figure;
}

/// Figure 1.8: the columns of the Jacobian, at one scale for both configurations.
Figure figure_1_8(const Arm& arm) {
  Figure figure;
  const Configuration left = degrees(0, 90, 0);
  for (const Configuration& q : {left, degrees(161, -109, 38)}) {
    Panel panel;
    add_arm(panel.scene, arm, q, {.tool = false});
    add_jacobian_arrows(panel.scene, arm, q, jacobian_arrow_scale(arm, left), true);
    panel.caption = angles_text(q);
    figure.columns.push_back({panel});
  }
  return figure;
}

/// Figure 1.9: Cartesian control makes a straight trail.
Figure figure_1_9(const Arm& arm) {
  const std::vector<Configuration> motion = figure_1_9_motion();
  std::vector<Pose> waypoints;
  for (const Pose2& waypoint : figure_1_9_waypoints()) waypoints.push_back(to_space(waypoint));
  Panel panel;
  add_arm(panel.scene, arm, motion.front(), {.faded = true});
  add_arm(panel.scene, arm, motion.back(), {.tool = false});
  add_trail(panel.scene, tool_positions(arm, motion), 200);
  add_poses(panel.scene, waypoints, {"1", "2", "3"});
  panel.scene.add(Layer::note,
                  Label{forward_kinematics(arm, motion.front()).translation(), "start"});
  panel.caption = "eq. 1.6 from " + angles_text(motion.front()) + " through three waypoints";
  Figure figure;
  figure.columns = {{panel}};
  return figure;
}

struct Entry {
  std::string_view number;
  Figure (*draw)(const Arm& arm);
};

constexpr std::array<Entry, 5> entries{{{"1.3", figure_1_3},
                                        {"1.6", figure_1_6},
                                        {"1.7", figure_1_7},
                                        {"1.8", figure_1_8},
                                        {"1.9", figure_1_9}}};

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

std::vector<Configuration> figure_1_7_motion() {
  SimulationOptions until_visible;
  until_visible.tolerance = 2e-3;  // radians; a smaller error is not visible
  return control_joints(built_in("rrr"), degrees(0, 0, 0), degrees(99.2, -68.8, -30.4), {.kp = 0.1},
                        until_visible)
      .trajectory.positions;
}

Configuration figure_1_9_start() { return degrees(0, 90, 0); }

std::vector<Pose2> figure_1_9_waypoints() {
  return {{6, 2.5, 30 * degree}, {-0.5, 6.5, 120 * degree}, {-4, 2.5, 180 * degree}};
}

std::vector<Configuration> figure_1_9_motion() {
  std::vector<Pose> waypoints;
  for (const Pose2& waypoint : figure_1_9_waypoints()) waypoints.push_back(to_space(waypoint));
  CartesianOptions options;
  options.gain = 0.01;  // small: the deviation between steps is proportional to the gain
  options.simulation.tolerance = 2e-3;
  return control_in_lines(built_in("rrr"), figure_1_9_start(), waypoints, options)
      .trajectory.positions;
}

}  // namespace beeline
