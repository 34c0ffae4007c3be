#include <gtest/gtest.h>

#include <beeline/draw/arm_figure.h>
#include <beeline/draw/internal/annotation.h>
#include <beeline/draw/internal/arm_drawing.h>
#include <beeline/draw/internal/trail.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/kinematics/forward.h>
#include <beeline/kinematics/manipulability.h>
#include <beeline/model/catalog.h>

#include <tests/random_arm.h>
#include <tests/typical_arms.h>

namespace beeline {
using namespace internal;
namespace {

template <class Shape>
std::vector<Shape> all_of(const Drawing& drawing) {
  std::vector<Shape> found;
  for (const Item& item : drawing.items) {
    if (const auto* shape = std::get_if<Shape>(&item.shape)) found.push_back(*shape);
  }
  return found;
}

double inverse_condition(const Arm& arm, const Configuration& q) {
  const Eigen::MatrixXd j = task_jacobian(arm, q, default_task(arm), internal::unit_of_length(arm));
  return 1 / manipulability_measures(j).condition;
}

TEST(DisplayConfiguration, OfEveryBuiltInArmIsNotSingularAndAboveTheGround) {
  for (const std::string& name : testing::typical_arms) {
    const Arm arm = built_in(name);
    const Configuration q = display_configuration(arm);
    EXPECT_TRUE(limit_violations(arm, q).empty()) << name;
    EXPECT_GT(inverse_condition(arm, q), 0.02) << name;
    const Vector3 tool = forward_kinematics(arm, q).translation();
    EXPECT_GE(arm.planar() ? tool.y() : tool.z(), -1e-9) << name;
    EXPECT_EQ(q, display_configuration(arm)) << name;
  }
}

TEST(DisplayConfiguration, IsTheMiddleOfTheLimitsWhereThatIsGood) {
  EXPECT_EQ(display_configuration(built_in("panda")), middle_configuration(built_in("panda")));
  testing::Random random;
  for (int trial = 0; trial < 100; ++trial) {
    const Arm arm = testing::random_arm(random, random.integer(1, 9), 5);
    const Configuration middle = middle_configuration(arm), q = display_configuration(arm);
    EXPECT_TRUE(limit_violations(arm, q).empty());
    if (inverse_condition(arm, middle) > 0.3) {
      EXPECT_EQ(q, middle);
    }
  }
}

TEST(Frames, AtOnePlaceHaveOneLabelAndOtherLengths) {
  for (const std::string& name : testing::typical_arms) {
    const Arm arm = built_in(name);
    const Configuration q = display_configuration(arm);
    Drawing drawing;
    add_arm(drawing, arm, q, {.frames = true, .tool = false});
    const std::vector<FrameTriad> triads = all_of<FrameTriad>(drawing);
    const std::vector<Label> labels = all_of<Label>(drawing);
    ASSERT_EQ(triads.size(), arm.joints().size() + 1);
    for (std::size_t i = 0; i < triads.size(); ++i) {
      const Vector3 at = triads[i].pose.translation();
      std::size_t here = 0;
      for (const Label& label : labels) here += (label.at - at).norm() < 1e-9;
      EXPECT_EQ(here, 1u) << name;
      for (std::size_t j = i + 1; j < triads.size(); ++j) {  // j is drawn over i
        if ((triads[j].pose.translation() - at).norm() > 1e-9) continue;
        EXPECT_LT(triads[j].length, triads[i].length - 2) << name;
        EXPECT_GT(triads[j].width, triads[i].width) << name;
      }
    }
  }
}

TEST(JacobianArrows, ThatCoincideStayVisible) {
  const Arm arm = built_in("rrr");
  Drawing drawing;
  add_jacobian_arrows(drawing, arm, Configuration::Zero(3), 1);
  const std::vector<Polyline> arrows = all_of<Polyline>(drawing);
  ASSERT_EQ(arrows.size(), 3u);
  for (std::size_t i = 0; i + 1 < 3; ++i) {
    const auto length = [](const Polyline& arrow) {
      return (arrow.points[1] - arrow.points[0]).norm();
    };
    EXPECT_GT(length(arrows[i]), length(arrows[i + 1]));
    EXPECT_GT(arrows[i].width, arrows[i + 1].width + 1);
  }
  Drawing apart;
  add_jacobian_arrows(apart, built_in("gantry"), Configuration::Zero(2), 1);
  for (const Polyline& arrow : all_of<Polyline>(apart)) EXPECT_EQ(arrow.width, 2.2);
}

TEST(MotionFigure, SaysHowFarBelowTheBase) {
  const Arm arm = built_in("ur5");
  const auto caption = [&](double shoulder) {
    const Configuration up = (Configuration(6) << 0, -0.5, 0, 0, 0, 0).finished();
    Trajectory motion{arm.joint_names(), {0, 1}, {up, up}, {}, {}};
    motion.positions[1][1] = shoulder;
    return motion_figure(arm, motion).columns[0][0].caption;
  };
  EXPECT_EQ(caption(-1).find("below"), std::string::npos);
  EXPECT_NE(caption(1).find("below the plane of the base"), std::string::npos);
  const Pose ceiling(Eigen::Translation3d(0, 0, 2) *
                     Eigen::AngleAxisd(3.14159265, Vector3::UnitX()));
  const Arm hanging = with_mount(arm, ceiling);
  Trajectory motion{arm.joint_names(), {0, 1}, {Configuration::Zero(6)}, {}, {}};
  motion.positions.push_back(Configuration::Constant(6, 0.5));
  EXPECT_EQ(motion_figure(hanging, motion).columns[0][0].caption.find("below"), std::string::npos);
  const Arm planar = built_in("rrr");
  Trajectory down{planar.joint_names(), {0, 1}, {Configuration::Zero(3)}, {}, {}};
  down.positions.push_back(Configuration::Constant(3, -0.5));
  EXPECT_EQ(motion_figure(planar, down).columns[0][0].caption.find("below"), std::string::npos);
}

}  // namespace
}  // namespace beeline
