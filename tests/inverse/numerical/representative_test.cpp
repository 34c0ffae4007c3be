#include <gtest/gtest.h>
#include <numbers>

#include <beeline/inverse/numerical/representative.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include <tests/random.h>

namespace beeline {
namespace {

using namespace internal;

using std::numbers::pi;

Joint follower(const Joint& like, const std::string& name, const std::string& leader,
               double ratio) {
  Joint joint = like;
  joint.name = name;
  joint.mimic = Mimic{leader, ratio, 0.1};
  return joint;
}

TEST(Representative, KeepsThePoseAndIsTheNearestWithinBounds) {
  testing::Random random;
  const Arm arm = built_in("ur5");
  for (int i = 0; i < 2000; ++i) {
    Configuration q(6), reference(6);
    Bounds bounds{Configuration(6), Configuration(6)};
    for (int k = 0; k < 6; ++k) {
      q[k] = random.uniform(-20, 20);
      reference[k] = random.uniform(-20, 20);
      bounds.lower[k] = random.uniform(-10, 5);
      bounds.upper[k] = bounds.lower[k] + random.uniform(0, 15);
    }
    const Configuration moved = nearest_representative(arm, q, reference, bounds);
    EXPECT_TRUE(same_posture(arm, moved, q, 1e-12));
    EXPECT_TRUE(forward_kinematics(arm, moved).isApprox(forward_kinematics(arm, q), 1e-12));
    for (int k = 0; k < 6; ++k) {
      // Compared with all multiples of 2 pi.
      double best = Limits::none, best_outside = Limits::none;
      for (int turns = -10; turns <= 10; ++turns) {
        const double value = q[k] + 2 * pi * turns;
        const double outside = std::max({bounds.lower[k] - value, value - bounds.upper[k], 0.0});
        best_outside = std::min(best_outside, outside);
        if (outside == 0) best = std::min(best, std::abs(value - reference[k]));
      }
      const double outside =
          std::max({bounds.lower[k] - moved[k], moved[k] - bounds.upper[k], 0.0});
      EXPECT_NEAR(outside, best_outside, 1e-9);
      if (best_outside > 0) continue;
      EXPECT_NEAR(std::abs(moved[k] - reference[k]), best, 1e-9);
    }
  }
}

TEST(Representative, Of200DegreesWithin170IsMinus160) {
  const Arm arm = built_in("ur5");
  const Bounds bounds{Configuration::Constant(6, -170 * pi / 180),
                      Configuration::Constant(6, 170 * pi / 180)};
  const Configuration q = Configuration::Constant(6, 200 * pi / 180);
  EXPECT_TRUE(nearest_representative(arm, q, q, bounds).isApproxToConstant(-160 * pi / 180, 1e-12));
}

TEST(Representative, ValuesOutsideByRoundingAreSetOnTheBound) {
  const Arm arm = built_in("ur5");
  const Bounds bounds{Configuration::Constant(6, -1), Configuration::Constant(6, 1)};
  const Configuration near = Configuration::Constant(6, 1 + 1e-12 + 2 * pi);
  const Configuration moved = nearest_representative(arm, near, near, bounds);
  EXPECT_TRUE(within(bounds, moved));
  const Configuration far = Configuration::Constant(6, 1.001);
  EXPECT_FALSE(within(bounds, nearest_representative(arm, far, far, bounds)));
}

TEST(Representative, SlidesScrewsAndUnevenFollowersAreNeverWrapped) {
  Joint turn = built_in("ur5").joints()[0];
  turn.limits = {};
  Joint slide = turn, screw = turn;
  slide.screw = translation_screw(Vector3::UnitX());
  screw.screw = rotation_screw(Vector3::UnitX(), Vector3::Zero(), 0.1);
  EXPECT_TRUE(Arm("turn", {turn}).periodic(0));
  EXPECT_FALSE(Arm("slide", {slide}).periodic(0));
  EXPECT_FALSE(Arm("screw", {screw}).periodic(0));
  for (const double ratio : {0.5, 1.0, 2.0, -1.0, -0.3}) {
    const Arm arm("followed", {turn, follower(turn, "follower", turn.name, ratio)});
    EXPECT_EQ(arm.periodic(0), ratio == std::round(ratio)) << ratio;
  }
  EXPECT_FALSE(Arm("rack", {turn, follower(slide, "rack", turn.name, 1)}).periodic(0));
  const Arm sliding("slide", {slide});
  const Configuration seven = Configuration::Constant(1, 7);
  EXPECT_EQ(nearest_representative(sliding, seven, Configuration::Zero(1), no_bounds(sliding)),
            seven);
  EXPECT_FALSE(same_posture(sliding, seven, seven.array() - 2 * pi));
}

}  // namespace
}  // namespace beeline
