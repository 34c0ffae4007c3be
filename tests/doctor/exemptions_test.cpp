#include <gtest/gtest.h>

#include <beeline/collision/collision_model.h>
#include <beeline/doctor/diagnosis.h>
#include <beeline/io/text/arm.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

/// Spheres at the ends of the links of a planar arm, the base's at the origin.
struct Row {
  Arm arm = read_arm("RRR:1,1,1");
  std::vector<LinkShapes> links;

  explicit Row(double radius) {
    for (std::size_t i = 0; i < 4; ++i) {
      links.push_back({"link" + std::to_string(i), i, {{.body = Sphere{radius}}}});
    }
  }

  Exemption examined(const NamedPair& pair, const Scene& scene = {}) const {
    const std::vector<Exemption> found = examine_exemptions(arm, links, scene, {pair});
    EXPECT_EQ(found.size(), 1U);
    return found.front();
  }
};

TEST(Exemptions, CollideAtTheConfigurationThatIsGiven) {
  const Row row(0.1);
  const Exemption found = row.examined({"link1", "link3"});
  ASSERT_EQ(found.status, ExemptionStatus::collides);
  EXPECT_NEAR(found.depth, 0.2, 1e-2) << "the spheres meet where the arm is folded";
  const CollisionModel model(row.arm, row.links);
  bool is_found = false;
  for (const BodyDistance& pair : pairs_too_close(model, found.q)) {
    if (pair.names != NamedPair{"link3", "link1"} && pair.names != NamedPair{"link1", "link3"}) {
      continue;
    }
    is_found = true;
    EXPECT_NEAR(-pair.lower, found.depth, 1e-9);
  }
  EXPECT_TRUE(is_found);
}

/// A thin target, which random configurations hardly meet.
TEST(Exemptions, AreSoughtAlongTheGradient) {
  const Row row(0.1);
  const Scene scene{
      .obstacles = {
          {"pin", {{.body = Sphere{1e-3}, .pose = Pose(Eigen::Translation3d(1.3, 1.1, 0))}}}}};
  EXPECT_EQ(row.examined({"pin", "link3"}, scene).status, ExemptionStatus::collides);
}

TEST(Exemptions, OfBodiesOutOfReachAreProved) {
  const Row row(0.1);
  const Scene scene{
      .obstacles = {{"far", {{.body = Sphere{0.1}, .pose = Pose(Eigen::Translation3d(4, 0, 0))}}}}};
  EXPECT_EQ(row.examined({"link3", "far"}, scene).status, ExemptionStatus::no_collision);
  const LimitOverrides narrow{.lower = -0.1, .upper = 0.1};
  const Arm stiff =
      with_limits(row.arm, {{"joint1", narrow}, {"joint2", narrow}, {"joint3", narrow}});
  const auto found = examine_exemptions(stiff, row.links, {}, {{"link1", "link3"}});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].status, ExemptionStatus::never_close);
}

TEST(Exemptions, OfBodiesThatAlwaysOverlapMayBeMeant) {
  EXPECT_EQ(Row(1.6).examined({"link1", "link3"}).status, ExemptionStatus::always_collides);
}

TEST(Exemptions, OfNeighboursAreNotCheckedAndUnknownNamesAreLeftOut) {
  const Row row(0.6);
  EXPECT_EQ(row.examined({"link1", "link2"}).status, ExemptionStatus::not_checked);
  EXPECT_TRUE(examine_exemptions(row.arm, row.links, {}, {{"link1", "camera"}}).empty());
}

TEST(Exemptions, AreExaminedOnceAndByAtLeastOneConfiguration) {
  const Row row(0.6);
  const std::vector<NamedPair> twice{{"link1", "link3"}, {"link3", "link1"}};
  EXPECT_EQ(examine_exemptions(row.arm, row.links, {}, twice, {.configurations = 1}).size(), 1U);
  EXPECT_REFUSED(examine_exemptions(row.arm, row.links, {}, twice, {.configurations = 0}),
                 "configurations");
}

TEST(Exemptions, ThatTheBudgetEndsAreNotCalledFree) {
  const Row row(0.1);
  const std::vector<NamedPair> pairs{{"link1", "link3"}, {"link0", "link3"}, {"link1", "link2"}};
  const auto statuses = [&](const Budget& budget) {
    std::vector<ExemptionStatus> found;
    for (const Exemption& one : examine_exemptions(row.arm, row.links, {}, pairs,
                                                   {.configurations = 200, .budget = budget})) {
      found.push_back(one.status);
    }
    return found;
  };
  using enum ExemptionStatus;
  EXPECT_EQ(statuses({}), (std::vector{collides, collides, not_checked}));
  EXPECT_EQ(statuses({.max_work = 0}), (std::vector{work_limit, work_limit, not_checked}));
  const auto first_only = statuses({.max_work = 250});
  EXPECT_EQ(first_only, (std::vector{collides, work_limit, not_checked}));
  EXPECT_EQ(statuses({.cancelled = [] { return true; }}),
            (std::vector{cancelled, cancelled, not_checked}));
  double last = -1;
  statuses({.progress = [&last](double fraction) { last = fraction; }});
  EXPECT_GT(last, 0.6);
}

}  // namespace
}  // namespace beeline
