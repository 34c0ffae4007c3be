#include <cmath>
#include <numbers>

#include <beeline/draw/internal/annotation.h>
#include <beeline/draw/internal/arm_drawing.h>
#include <beeline/draw/internal/concept_figures.h>
#include <beeline/draw/internal/text.h>
#include <beeline/io/text/arm.h>
#include <beeline/kinematics/forward.h>

namespace beeline::internal {
namespace {

constexpr double one_degree = std::numbers::pi / 180;

/// The two-link arm of Figures 1.4 and 1.5.
Arm two_links() { return arm_from_joint_string("RR:3.5,2.5"); }

/// Returns the curve from one frame's origin to another's, bent to the left of its direction by
/// `bend` times its length, and shortened at both ends.
std::vector<Vector3> bent_arrow(const Vector3& from, const Vector3& to, double bend) {
  const Vector3 chord = to - from, left = Vector3::UnitZ().cross(chord);
  std::vector<Vector3> points;
  for (int k = 3; k <= 37; ++k) {
    const double t = k / 40.0;
    points.emplace_back(from + t * chord + 4 * bend * t * (1 - t) * left);
  }
  return points;
}

}  // namespace

/// Figure 1.1: the two main joint types.
Figure figure_1_1(const Arm& /*arm*/) {
  Figure figure;
  figure.columns = {
      {linked_joint(JointKind::revolute, "(a) revolute joint: the angle θᵢ about its axis")},
      {linked_joint(JointKind::prismatic, "(b) prismatic joint: the offset dᵢ along its axis")}};
  figure.width = 480;
  return figure;
}

/// Figure 1.2: all joint types, with the motions that they allow.
Figure figure_1_2(const Arm& /*arm*/) {
  Figure figure;
  figure.columns = {{joint_picture('P', "prismatic (P)"), joint_picture('C', "cylindrical (C)")},
                    {joint_picture('R', "revolute (R)"), joint_picture('H', "helical (H)")},
                    {joint_picture('S', "spherical (S)"), joint_picture('E', "planar (E)")}};
  figure.width = 560;
  figure.height = 360;
  return figure;
}

/// Figure 1.3: the arm at q = 0, and with joints 2 and 3 actuated.
Figure figure_1_3(const Arm& arm) {
  const Configuration turned = Configuration(one_degree * Eigen::Vector3d(0, 50, -80));
  Panel rest, actuated;
  add_arm(rest.drawing, arm, Configuration::Zero(3), {.frames = true, .tool = false});
  rest.caption = "at rest: " + angles_text(Configuration::Zero(3));
  add_arm(actuated.drawing, arm, turned, {.frames = true, .tool = false});
  add_joint_angles(actuated.drawing, arm, turned, 0.95);
  actuated.caption = "actuated: " + angles_text(turned);
  Figure figure;
  figure.columns = {{rest, actuated}};
  figure.width = 440;
  return figure;
}

/// Figure 1.4: the transformations from frame to frame.
Figure figure_1_4(const Arm& /*arm*/) {
  const Arm arm = two_links();
  const Configuration q = one_degree * Eigen::Vector2d(50, -65);
  const std::vector<Pose> links = link_poses(arm, q);
  Panel panel;
  add_arm(panel.drawing, arm, q, {.frames = true, .tool = false});
  const auto transform = [&](std::size_t from, std::size_t to, double bend, const Colour& colour) {
    Polyline arrow{bent_arrow(links[from].translation(), links[to].translation(), bend), colour,
                   1.4};
    arrow.arrow = true;
    const Vector3 middle = arrow.points[17];
    const Vector3 out =
        std::copysign(1.0, bend) *
        Vector3::UnitZ().cross(Vector3(links[to].translation() - links[from].translation()));
    panel.drawing.add(Layer::mark, arrow);
    panel.drawing.add(
        Layer::note,
        Label{middle, "T" + subscript(static_cast<int>(to)) + superscript(static_cast<int>(from)),
              colour, 11, out.x(), out.y()});
  };
  transform(0, 1, 0.22, distinct_colour(4));
  transform(1, 2, 0.24, distinct_colour(4));
  transform(0, 2, -0.2, amber);
  panel.caption = "T₂⁰ = T₁⁰ T₂¹";
  Figure figure;
  figure.columns = {{panel}};
  figure.width = 440;
  return figure;
}

/// Figure 1.5: link frames at the next joint, x along the link; angles and link lengths.
Figure figure_1_5(const Arm& /*arm*/) {
  const Arm arm = two_links();
  const Configuration q = one_degree * Eigen::Vector2d(35, 40);
  const std::vector<Pose> links = link_poses(arm, q);
  Panel panel;
  add_arm(panel.drawing, arm, q, {.frames = true, .tool = false});
  add_joint_angles(panel.drawing, arm, q, 1.1);
  for (std::size_t i = 1; i < links.size(); ++i) {
    const Vector3 from = links[i - 1].translation(), to = links[i].translation();
    const Vector3 side = -0.62 * Vector3::UnitZ().cross((to - from).normalized());
    for (const auto& [begin, end] : {std::pair{from, to}, std::pair{to, from}}) {
      Polyline half{{(from + to) / 2 + side, end + side}, construction_grey, 0.9};
      half.arrow = true;
      panel.drawing.add(Layer::mark, half);
      panel.drawing.add(
          Layer::trail,
          Polyline{{begin + 0.4 * side, begin + 1.15 * side}, construction_grey, 0.7});
    }
    panel.drawing.add(Layer::note,
                      Label{(from + to) / 2 + side, "a" + subscript(static_cast<int>(i)), ink, 9.5,
                            side.x(), side.y()});
  }
  panel.caption = "frame {i} is at joint i + 1, or at the tool, with x along link i";
  Figure figure;
  figure.columns = {{panel}};
  figure.width = 440;
  return figure;
}

}  // namespace beeline::internal
