#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include <beeline/draw/arm_figure.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/pose/so3.h>

#include <tests/draw/page.h>
#include <tests/refusal.h>

namespace beeline {
using namespace internal;
namespace {

constexpr double degree = std::numbers::pi / 180;

std::vector<Vector3> tool_positions(const Arm& arm, const Trajectory& motion) {
  std::vector<Vector3> points;
  for (const Configuration& q : motion.positions) {
    points.push_back(forward_kinematics(arm, q).translation());
  }
  return points;
}

const Panel& panel(const Figure& figure, std::size_t column) { return figure.columns[column][0]; }

std::vector<Polyline> arrows(const Drawing& drawing) {
  std::vector<Polyline> found;
  for (const Item& item : drawing.items) {
    const auto* line = std::get_if<Polyline>(&item.shape);
    if (line != nullptr && line->arrow && line->points.size() == 2) found.push_back(*line);
  }
  return found;
}

TEST(Chapter, RefusesOtherFigures) {
  EXPECT_EQ(chapter_figures(), (std::vector<std::string>{"1.1", "1.2", "1.3", "1.4", "1.5", "1.6",
                                                         "1.7", "1.8", "1.9", "splines"}));
  EXPECT_REFUSED(chapter_figure("1.10"), "1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7, 1.8, 1.9");
  EXPECT_REFUSED(chapter_figure(""), "1.7, 1.8, 1.9");
}

TEST(Chapter, EveryFigureFitsItsPage) {
  for (const std::string& number : chapter_figures()) {
    testing::expect_within_page(compose(chapter_figure(number)), number);
  }
}

TEST(Chapter, Figures11And12ShowTheJointTypes) {
  std::vector<JointKind> kinds;
  const Figure two = chapter_figure("1.1"), six = chapter_figure("1.2");
  for (const auto& column : two.columns) {
    for (const Item& item : column[0].drawing.items) {
      if (const auto* joint = std::get_if<JointSymbol>(&item.shape)) kinds.push_back(joint->kind);
    }
  }
  EXPECT_EQ(kinds, (std::vector<JointKind>{JointKind::revolute, JointKind::prismatic}));
  std::string captions;
  for (const auto& column : six.columns) {
    for (const Panel& part : column) captions += part.caption + ";";
  }
  for (const char* type : {"prismatic (P)", "revolute (R)", "spherical (S)", "cylindrical (C)",
                           "helical (H)", "planar (E)"}) {
    EXPECT_NE(captions.find(type), std::string::npos) << type;
  }
}

TEST(Chapter, Figures14And15NameTransformationsAnglesAndLengths) {
  const auto texts = [](const std::string& number) {
    std::string all;
    const Figure figure = chapter_figure(number);
    for (const Item& item : figure.columns[0][0].drawing.items) {
      if (const auto* label = std::get_if<Label>(&item.shape)) all += label->text + ";";
    }
    return all;
  };
  EXPECT_EQ(texts("1.4"), "{0};{1};{2};T₁⁰;T₂¹;T₂⁰;");
  EXPECT_EQ(texts("1.5"), "{0};{1};{2};θ₁;θ₂;a₁;a₂;");
}

TEST(Chapter, TheSplinePassesTheWaypointsFaster) {
  const Figure figure = chapter_figure("splines");
  ASSERT_EQ(figure.columns.size(), 2u);
  double durations[2];
  for (std::size_t part = 0; part < 2; ++part) {
    const std::string& caption = panel(figure, part).caption;
    durations[part] = std::stod(caption.substr(caption.find(": ") + 2));
    const auto& trail =
        std::get<Polyline>(std::find_if(panel(figure, part).drawing.items.begin(),
                                        panel(figure, part).drawing.items.end(),
                                        [](const Item& item) {
                                          return item.layer == Layer::trail &&
                                                 std::holds_alternative<Polyline>(item.shape);
                                        })
                               ->shape);
    for (const Pose2& waypoint : figure_1_9_waypoints()) {
      double nearest = 9;
      for (const Vector3& p : trail.points) {
        nearest = std::min(nearest, (p - Vector3(waypoint.x, waypoint.y, 0)).norm());
      }
      EXPECT_LT(nearest, 0.05);
    }
  }
  EXPECT_LT(durations[1], durations[0]);
}

TEST(Chapter, Figure13NamesFourFrames) {
  const Figure figure = chapter_figure("1.3");
  ASSERT_EQ(figure.columns.size(), 1u);
  ASSERT_EQ(figure.columns[0].size(), 2u);  // above and below each other
  for (const Panel& part : figure.columns[0]) {
    int triads = 0;
    std::vector<std::string> names;
    for (const Item& item : part.drawing.items) {
      triads += std::holds_alternative<FrameTriad>(item.shape);
      if (const auto* label = std::get_if<Label>(&item.shape)) names.push_back(label->text);
    }
    EXPECT_EQ(triads, 4);
    ASSERT_GE(names.size(), 4u);
    names.resize(4);
    EXPECT_EQ(names, (std::vector<std::string>{"{0}", "{1}", "{2}", "{3}"}));
  }
}

TEST(Chapter, Figure16TellsThePoses) {
  const Figure figure = chapter_figure("1.6");
  EXPECT_NE(panel(figure, 0).caption.find("(2.44, 6.28, 0°)"), std::string::npos);
  EXPECT_NE(panel(figure, 1).caption.find("(5.65, 2.01, −75°)"), std::string::npos);
}

TEST(Chapter, Figure17SlowsDownToTheGoal) {
  const Arm arm = built_in("rrr");
  const std::vector<Vector3> trail = tool_positions(arm, figure_1_7_motion());
  ASSERT_GT(trail.size(), 20u);
  EXPECT_LT((trail.front() - Vector3(9, 0, 0)).norm(), 1e-12);
  EXPECT_LT((trail.back() - Vector3(4.459, 5.226, 0)).norm(), 0.02);
  double off_the_chord = 0;
  for (std::size_t k = 2; k < trail.size(); ++k) {
    EXPECT_LT((trail[k] - trail[k - 1]).norm(), (trail[k - 1] - trail[k - 2]).norm());
    const Vector3 chord = (trail.back() - trail.front()).normalized();
    off_the_chord = std::max(off_the_chord, chord.cross(trail[k] - trail.front()).norm());
  }
  EXPECT_GT(off_the_chord, 1);  // "this leads to a curved path in Cartesian space"
}

TEST(Chapter, Figure18ArrowsAreSquareToTheLeversAndProportional) {
  const Arm arm = built_in("rrr");
  const Figure figure = chapter_figure("1.8");
  ASSERT_EQ(figure.columns.size(), 2u);
  const Configuration configurations[] = {degree * Eigen::Vector3d(0, 90, 0),
                                          degree * Eigen::Vector3d(161, -109, 38)};
  double scale = 0;
  for (std::size_t part = 0; part < 2; ++part) {
    const std::vector<Pose> links = link_poses(arm, configurations[part]);
    const Vector3 tool = links.back().translation();
    const std::vector<Polyline> shown = arrows(panel(figure, part).drawing);
    ASSERT_EQ(shown.size(), 3u);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector3 lever = tool - links[k].translation();  // frame k sits at joint k + 1
      const Vector3 arrow = shown[k].points[1] - shown[k].points[0];
      EXPECT_LT((shown[k].points[0] - tool).norm(), 1e-12);
      EXPECT_NEAR(arrow.dot(lever), 0, 1e-9);
      EXPECT_GT(lever.cross(arrow).z(), 0);
      if (scale == 0) scale = arrow.norm() / lever.norm();
      EXPECT_NEAR(arrow.norm(), scale * lever.norm(), 1e-9);
      const double colours[] = {shown[k].colour.red, shown[k].colour.green, shown[k].colour.blue};
      EXPECT_EQ(std::max_element(colours, colours + 3) - colours, static_cast<long>(k));
    }
  }
}

TEST(Chapter, Figure19GoesStraight) {
  const Arm arm = built_in("rrr");
  const Trajectory motion = figure_1_9_motion();
  EXPECT_LT((motion.positions.front() - figure_1_9_start()).norm(), 1e-12);
  std::vector<Vector3> corners{forward_kinematics(arm, figure_1_9_start()).translation()};
  for (const Pose2& waypoint : figure_1_9_waypoints()) {
    corners.emplace_back(waypoint.x, waypoint.y, 0);
  }
  ASSERT_EQ(corners.size(), 4u);
  const std::vector<Vector3> trail = tool_positions(arm, motion);
  std::size_t line = 0;
  for (const Vector3& p : trail) {
    const auto off = [&](std::size_t i) {
      const Vector3 way = corners[i + 1] - corners[i];
      const double t = std::clamp(way.dot(p - corners[i]) / way.squaredNorm(), 0.0, 1.0);
      return (p - corners[i] - t * way).norm();
    };
    if (line + 1 < 3 && off(line + 1) < off(line)) ++line;
    EXPECT_LT(off(line), 0.015);  // of 9 m: less than the line's own width on paper
  }
  EXPECT_EQ(line, 2u);
  for (std::size_t i = 1; i < 4; ++i) {  // each waypoint is reached, with its orientation
    double nearest = 9;
    for (const Configuration& q : motion.positions) {
      const Pose2 goal = figure_1_9_waypoints()[i - 1];
      nearest =
          std::min(nearest, pose_difference(goal, to_plane(forward_kinematics(arm, q))).norm());
    }
    EXPECT_LT(nearest, 0.005);
  }
  for (const Configuration& q : motion.positions) {  // far from straight and folded elbows
    EXPECT_GT(std::abs(std::sin(q[1])), 0.3);
  }
}

}  // namespace
}  // namespace beeline
