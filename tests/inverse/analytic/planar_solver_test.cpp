#include <gtest/gtest.h>
#include <numbers>

#include <beeline/error.h>
#include <beeline/inverse/analytic/planar_solver.h>
#include <beeline/inverse/numerical/levenberg_marquardt.h>
#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/model/joint.h>
#include <beeline/pose/se2.h>
#include <beeline/pose/se3.h>
#include <beeline/pose/so3.h>

#include <tests/inverse/answer.h>
#include <tests/random.h>

namespace beeline::internal {
namespace {

using namespace internal;

using std::numbers::pi;
using testing::largest;

/// The solutions within the tolerance of the solver.
std::vector<Configuration> planar_solutions(const Arm& arm, const Pose& world_T_tool,
                                            const Task& task, const Configuration& seed) {
  constexpr double tolerance = 1e-9;
  std::vector<Configuration> within;
  for (const PlanarSolution& solution : nearest_planar_solutions(arm, world_T_tool, task, seed)) {
    if (largest(solution.error) <= tolerance) within.push_back(solution.q);
  }
  return within;
}

/// A pose that maps the xy plane to a parallel plane: any heading and offset, upside down if asked.
Pose planar_offset(testing::Random& random, double size, bool upside_down) {
  Pose pose =
      to_space({random.uniform(-size, size), random.uniform(-size, size), random.uniform(-pi, pi)},
               random.uniform(-size, size));
  if (upside_down) pose = pose * Eigen::AngleAxisd(pi, Vector3::UnitX());
  return pose;
}

/// Axes along +z and -z, link frames with z up or down, sliding directions, base and tool at
/// random.
Arm random_planar_arm(const std::string& letters, double size, testing::Random& random) {
  std::vector<Joint> joints;
  bool upside_down = false;
  for (const char letter : letters) {
    Joint joint;
    joint.name = "joint" + std::to_string(joints.size() + 1);
    const bool flip = random.integer(0, 1) == 1;
    upside_down = upside_down != flip;
    joint.offset = planar_offset(random, size, flip);
    const double heading = random.uniform(-pi, pi);
    const Vector3 z = random.integer(0, 1) == 1 ? Vector3::UnitZ() : Vector3(-Vector3::UnitZ());
    joint.screw = letter == 'R' ? rotation_screw(z, random.vector(size))
                                : translation_screw({std::cos(heading), std::sin(heading), 0});
    joints.push_back(joint);
  }
  return {letters, joints, planar_offset(random, size, upside_down),
          planar_offset(random, size, false)};
}

std::vector<std::string> all_mixes(std::size_t longest) {
  std::vector<std::string> mixes, last{""};
  for (std::size_t length = 1; length <= longest; ++length) {
    std::vector<std::string> next;
    for (const std::string& mix : last) {
      next.push_back(mix + 'R');
      next.push_back(mix + 'P');
    }
    mixes.insert(mixes.end(), next.begin(), next.end());
    last = next;
  }
  return mixes;
}

bool among(const Arm& arm, const Configuration& q, const std::vector<Configuration>& solutions,
           double tolerance) {
  return std::any_of(solutions.begin(), solutions.end(), [&](const Configuration& other) {
    return same_posture(arm, q, other, tolerance);
  });
}

void expect_reached(const Arm& arm, const Pose& pose, const Task& task,
                    const std::vector<Configuration>& solutions, double tolerance) {
  for (const Configuration& q : solutions) {
    EXPECT_LE(largest(task_deviation(task, pose, forward_kinematics(arm, q))), tolerance)
        << arm.name();
  }
}

TEST(PlanarSolutions, OfAllJointTypesIncludeTheConfigurationOfThePose) {
  testing::Random random;
  const std::vector<std::string> mixes = all_mixes(3);
  ASSERT_EQ(mixes.size(), 14U);
  for (const std::string& mix : mixes) {
    for (int i = 0; i < 300; ++i) {
      const double size = std::pow(10.0, random.uniform(-2, 2));
      const Arm arm = random_planar_arm(mix, size, random);
      ASSERT_TRUE(arm.planar()) << mix;
      const Configuration q = random.configuration(arm);
      const Pose pose = forward_kinematics(arm, q);
      // Three prismatic joints are redundant: only with q as the seed is q the solution.
      const Configuration seed = mix == "PPP" ? q : random.configuration(arm);
      const std::vector<Configuration> found = planar_solutions(arm, pose, Task::planar(), seed);
      EXPECT_TRUE(among(arm, q, found, 1e-5)) << mix;
      expect_reached(arm, pose, Task::planar(), found, 1e-11 * std::max(1.0, size));
      for (const Configuration& each : found) {
        for (int k = 0; k < arm.dof(); ++k) {
          if (mix[k] != 'R') continue;
          EXPECT_LE(std::abs(each[k] - seed[k]), pi + 1e-9);
        }
      }
    }
  }
}

TEST(PlanarSolutions, ForThePositionIncludeTheConfigurationOfThePose) {
  testing::Random random;
  for (const std::string& mix : all_mixes(2)) {
    for (int i = 0; i < 300; ++i) {
      const Arm arm = random_planar_arm(mix, 1, random);
      const Configuration q = random.configuration(arm), seed = random.configuration(arm);
      Pose pose = forward_kinematics(arm, q);
      pose.linear() = random.rotation();
      const std::vector<Configuration> found = planar_solutions(arm, pose, Task::position(), seed);
      EXPECT_TRUE(among(arm, q, found, 1e-5)) << mix;
      expect_reached(arm, pose, Task::position(), found, 1e-11);
      const Task point{{true, true, false, false, false, false}};
      pose.translation().z() += random.uniform(-1, 1);
      EXPECT_EQ(planar_solutions(arm, pose, point, seed), found) << mix;
    }
  }
}

TEST(PlanarSolutions, AreTwoForATriangleAndOneOtherwise) {
  testing::Random random;
  for (const std::string& mix : all_mixes(3)) {
    const auto turns = std::count(mix.begin(), mix.end(), 'R');
    const std::size_t expected =
        mix.size() == 3 && turns >= 2 ? 2 : 1;  // a circle meets a circle or a line twice
    for (int i = 0; i < 100; ++i) {
      const Arm arm = random_planar_arm(mix, 1, random);
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      const auto found = planar_solutions(arm, pose, Task::planar(), random.configuration(arm));
      EXPECT_EQ(found.size(), expected) << mix;
      EXPECT_TRUE(found.size() < 2 || !same_posture(arm, found[0], found[1])) << mix;
    }
  }
}

TEST(PlanarSolutions, IncludeEverySolutionThatTheNumericalMethodFinds) {
  testing::Random random;
  int runs = 0, converged = 0;
  for (const std::string& mix : all_mixes(3)) {
    if (mix == "PPP") continue;
    for (int i = 0; i < 20; ++i) {
      const Arm arm = random_planar_arm(mix, 1, random);
      const Pose pose = forward_kinematics(arm, random.configuration(arm));
      const auto found = planar_solutions(arm, pose, Task::planar(), random.configuration(arm));
      for (int start = 0; start < 10; ++start) {
        const NumericalResult run = levenberg_marquardt(arm, pose, Task::planar(), no_bounds(arm),
                                                        random.configuration(arm));
        ++runs;
        if (!run.converged) continue;
        ++converged;
        EXPECT_TRUE(among(arm, run.q, found, 1e-4)) << mix;
      }
    }
  }
  EXPECT_GT(converged, 0.5 * runs) << "of " << runs;  // otherwise it proves little
}

TEST(PlanarSolutions, OfStretchedAndFoldedArmsAreOne) {
  testing::Random random;
  const Arm chapter = built_in("rrr");
  const Arm unequal("unequal", {planar_link(chapter.joints()[0], 1.3),
                                planar_link(chapter.joints()[1], 0.4), chapter.joints()[2]});
  for (const auto& [arm, elbow] : {std::pair{chapter, 0.0}, {unequal, 0.0}, {unequal, pi}}) {
    for (int i = 0; i < 500; ++i) {
      Configuration q = random.configuration(arm);
      q[1] = elbow;
      const Pose pose = forward_kinematics(arm, q);
      const auto found = planar_solutions(arm, pose, Task::planar(), q);
      ASSERT_EQ(found.size(), 1U);
      EXPECT_LT((found[0] - q).cwiseAbs().maxCoeff(), 1e-6);
      expect_reached(arm, pose, Task::planar(), found, 1e-11);
    }
  }
}

TEST(PlanarSolutions, OfNearlyStretchedArmsKeepTheirDigits) {
  testing::Random random;
  const Arm arm = built_in("rrr");
  for (int i = 0; i < 500; ++i) {
    Configuration q = random.configuration(arm);
    q[1] = std::pow(10.0, random.uniform(-9, -1));
    const Pose pose = forward_kinematics(arm, q);
    const auto found = planar_solutions(arm, pose, Task::planar(), q);
    // An elbow below about 2e-6 rad cannot be told from a stretched one: cos(2e-6) = 1 - 2e-12.
    EXPECT_TRUE(among(arm, q, found, 1e-5)) << q.transpose();
    expect_reached(arm, pose, Task::planar(), found, 1e-11);
  }
}

TEST(PlanarSolutions, OfAContinuumAreTheNearestToTheSeed) {
  testing::Random random;
  const Arm chapter = built_in("rrr");
  const Joint turn = chapter.joints()[0];
  Joint hinge = turn, twin = turn;  // two coincident axes
  hinge.name = "hinge";
  hinge.offset = Pose::Identity();
  hinge.screw = rotation_screw(Vector3::UnitZ());
  twin.name = "twin";
  Joint slide = hinge, along = hinge, across = hinge;
  slide.name = "slide", along.name = "along", across.name = "across";
  slide.screw = along.screw = translation_screw({1, 0.2, 0});
  across.screw = translation_screw({-0.3, 1, 0});
  struct Case {
    Arm arm;
    Configuration freedom;  ///< null-space direction: q moves along it with the tool at rest
    double folded;          ///< the value of joint 2 that this requires; NaN: any
  };
  const double any = std::nan("");
  const std::vector<Case> cases{
      {chapter, Eigen::Vector3d(1, 0, -1), pi},
      {Arm("12", {hinge, twin, chapter.joints()[1]}), Eigen::Vector3d(1, -1, 0), any},
      {Arm("23", {chapter.joints()[0], hinge, twin}), Eigen::Vector3d(0, 1, -1), any},
      {Arm("slides", {slide, along}), Eigen::Vector2d(1, -1), any},
      {Arm("turned", {slide, along, turn}), Eigen::Vector3d(1, -1, 0), any},
      {Arm("three", {slide, along, across}), Eigen::Vector3d(1, -1, 0), any}};
  for (const Case& each : cases) {
    for (int i = 0; i < 40; ++i) {
      Configuration q = random.configuration(each.arm);
      if (!std::isnan(each.folded)) q[1] = each.folded;
      const Configuration seed = random.configuration(each.arm);
      const Pose pose = forward_kinematics(each.arm, q);
      const auto found = nearest_planar_solutions(each.arm, pose, Task::planar(), seed);
      ASSERT_FALSE(found.empty());
      double nearest = Limits::none;
      for (const PlanarSolution& solution : found) {
        EXPECT_LE(largest(solution.error), 1e-11) << each.arm.name();
        EXPECT_TRUE(solution.continuum) << each.arm.name();
        nearest = std::min(nearest, (solution.q - seed).norm());
      }
      for (double step = -6; step <= 6; step += 0.03) {
        const Configuration other = q + step * each.freedom;
        ASSERT_LE(
            largest(task_deviation(Task::planar(), pose, forward_kinematics(each.arm, other))),
            1e-11);
        EXPECT_LE(nearest, (other - seed).norm() + 1e-9) << each.arm.name();
      }
    }
  }
}

TEST(PlanarSolutions, OutOfReachAreNoneAndTheNearestIsAtTheBoundary) {
  testing::Random random;
  const Arm arm = built_in("rrr");  // links 3.5, 3.5, 2
  for (int i = 0; i < 500; ++i) {
    const Pose2 goal{random.uniform(-20, 20), random.uniform(-20, 20), random.uniform(-pi, pi)};
    const double wrist =
        std::hypot(goal.x - 2 * std::cos(goal.theta), goal.y - 2 * std::sin(goal.theta));
    const auto found =
        planar_solutions(arm, to_space(goal), Task::planar(), Configuration::Zero(3));
    EXPECT_EQ(found.empty(), wrist > 7);
    if (wrist <= 7) continue;
    const auto edge =
        nearest_planar_solutions(arm, to_space(goal), Task::planar(), Configuration::Zero(3));
    ASSERT_EQ(edge.size(), 1U);
    EXPECT_NEAR(edge[0].error.position, wrist - 7, 1e-9);
    EXPECT_LT(edge[0].error.orientation, 1e-12);
  }
}

TEST(PlanarSolutions, OfATiltedPoseHaveItsHeading) {
  testing::Random random;
  const Arm arm = built_in("rrr");
  for (int i = 0; i < 200; ++i) {
    Pose pose = forward_kinematics(arm, random.configuration(arm));
    pose.linear() =
        pose.linear() * so3_exp(Vector3(random.uniform(-1, 1), random.uniform(-1, 1), 0));
    pose.translation().z() = random.uniform(-1, 1);
    const auto edge = nearest_planar_solutions(arm, pose, Task::planar(), Configuration::Zero(3));
    ASSERT_FALSE(edge.empty());
    for (const PlanarSolution& solution : edge) EXPECT_LT(solution.error.orientation, 1e-12);
  }
}

TEST(PlanarSolutions, AreFoundFromADistantSeed) {
  const Arm arm = built_in("rrr");
  const Configuration q = Eigen::Vector3d(1, -0.9, 0.5);
  const Pose pose = forward_kinematics(arm, q);
  EXPECT_EQ(planar_solutions(arm, pose, Task::planar(), Configuration::Constant(3, 1e15)).size(),
            2U);
}

TEST(PlanarSolutions, RequireAPlanarArmOfAtMostThreeJoints) {
  testing::Random random;
  for (const std::string& mix : all_mixes(4)) {
    const Arm arm = random_planar_arm(mix, 1, random);
    EXPECT_EQ(has_planar_closed_form(arm, Task::planar()), mix.size() <= 3);
    EXPECT_EQ(has_planar_closed_form(arm, Task::position()), mix.size() <= 2);
    EXPECT_FALSE(has_planar_closed_form(arm, Task::spatial()));
  }
  const Arm puma = built_in("puma560");
  EXPECT_FALSE(has_planar_closed_form(puma, Task::planar()));
  EXPECT_THROW(planar_solutions(puma, Pose::Identity(), Task::planar(), Configuration::Zero(6)),
               Error);
  const Arm rrr = built_in("rrr");
  EXPECT_THROW(planar_solutions(rrr, Pose::Identity(), Task::planar(), Configuration::Zero(2)),
               Error);
  Pose nan = Pose::Identity();
  nan.translation().y() = std::nan("");
  EXPECT_THROW(planar_solutions(rrr, nan, Task::planar(), Configuration::Zero(3)), Error);
}

}  // namespace
}  // namespace beeline::internal
