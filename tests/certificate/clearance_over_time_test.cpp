#include <gtest/gtest.h>

#include <beeline/certificate/clearance.h>
#include <beeline/model/catalog.h>

#include <tests/certificate/random_motion.h>
#include <tests/collision/random_model.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::Random;

/// The part of the motion that a time is in.
std::size_t part_at(const ClearanceOverTime& clearance, double time) {
  std::size_t part = 0;
  while (part + 1 < clearance.proved.size() && clearance.times[part + 1] < time) ++part;
  return part;
}

TEST(ClearanceOverTime, BoundsTheDistanceInEachPart) {
  Random random;
  int tight = 0, parts = 0;
  for (int i = 0; i < testing::cases(60); ++i) {
    const Arm arm = testing::random_arm(random, random.integer(1, 6), 4);
    Scene scene = testing::random_scene(random, arm, random.integer(1, 12), 0.3, 3);
    if (random.integer(0, 1) == 0) scene.obstacles.front().clearance = 0.05;
    const CollisionModel model(arm, testing::random_link_shapes(random, arm, 0.05), scene,
                               {.self_collision = random.integer(0, 1) == 0,
                                .budget = {.max_work = 200 * random.integer(0, 1)}});
    if (model.pair_count() == 0) continue;
    const Trajectory motion =
        testing::random_motion(random, arm, testing::random_interpolation(random),
                               random.integer(1, 300), random.uniform(0, 0.2));
    const ClearanceOverTime found = clearance_over_time(model, motion);
    EXPECT_EQ(found.ending, Ending::complete);
    ASSERT_EQ(found.times.size(), found.proved.size() + 1);
    ASSERT_EQ(found.sample_times.size(), found.sampled.size());
    EXPECT_EQ(found.clearance.has_value(), !scene.obstacles.front().clearance.has_value());
    EXPECT_EQ(found.times.front(), motion.times.front());
    EXPECT_EQ(found.times.back(),
              motion.size() == 1 ? motion.times.back() + 1 : motion.times.back());
    EXPECT_TRUE(std::is_sorted(found.times.begin(), found.times.end()));
    for (int k = 0; k < 100; ++k) {
      const double time = random.uniform(motion.times.front(), motion.times.back());
      const BodyDistance pair = nearest_pair(model, sample(motion, time).position);
      EXPECT_LE(found.proved[part_at(found, time)], pair.upper - pair.clearance);
    }
    std::size_t k = 0;
    for (std::size_t part = 0; part < found.proved.size(); ++part) {
      double least = k > 0 ? found.sampled[k - 1] : found.sampled[0];
      for (; k < found.sampled.size() && found.sample_times[k] <= found.times[part + 1]; ++k) {
        least = std::min(least, found.sampled[k]);
      }
      EXPECT_LE(found.proved[part], least);
      // Pairs that count outside the limits alone are not sampled inside.
      if (least < 0 || model.apart_count() > 0) continue;
      ++parts;
      tight += found.proved[part] >= 0.9 * least - 0.001 ? 1 : 0;
    }
    EXPECT_EQ(k, found.sampled.size());
  }
  EXPECT_GT(tight, 0.9 * parts);
  EXPECT_GT(parts, 0);
}

TEST(ClearanceOverTime, HasThePairsThatCountOnlyOutsideTheLimits) {
  const Arm arm = with_limits(built_in("rrr"), {{"joint2", {.lower = -1, .upper = 1}},
                                                {"joint3", {.lower = -1, .upper = 1}}});
  const CollisionModel model(arm, {{"base", 0, {{Sphere{0.1}}}}, {"tip", 3, {{Sphere{0.1}}}}});
  ASSERT_EQ(model.pair_count(), 0);
  ASSERT_EQ(model.apart_count(), 1);
  const auto motion_to = [&](const Configuration& q) {
    return Trajectory{arm.joint_names(), {0, 1}, {Configuration{{0, 0.9, 0.9}}, q}, {}, {}};
  };
  const Trajectory inside = motion_to(Configuration{{0.5, -0.9, 0.9}});
  EXPECT_TRUE(clearance_over_time(model, inside).proved.empty());
  EXPECT_EQ(prove_clearance(model, inside).pairs, 0);
  const Trajectory at_base = motion_to(Configuration{{0, 2.56208, 1.86055}});
  const ClearanceOverTime colliding = clearance_over_time(model, at_base);
  ASSERT_FALSE(colliding.proved.empty());
  EXPECT_LT(colliding.sampled.back(), 0);
  EXPECT_LT(colliding.proved.back(), 0);
  EXPECT_GT(colliding.proved.front(), 0.5) << "the pair is known to be far at first";
  EXPECT_EQ(prove_clearance(model, at_base).pairs, 1);
  const ClearanceProof outside =
      prove_clearance(model, motion_to(Configuration{{0, 1.5, 0.9}}), {.closest = true});
  EXPECT_TRUE(outside);
  EXPECT_EQ(outside.pair.names, (NamedPair{"tip", "base"}));
  EXPECT_GT(outside.least_distance, 0.9 * outside.pair.upper);
}

TEST(ClearanceOverTime, EndsWithItsBudgetAndRefusesWhatDoesNotFit) {
  Random random;
  const Arm arm = built_in("panda");
  const CollisionModel model(arm, testing::random_link_shapes(random, arm, 0.02),
                             testing::random_scene(random, arm, 20, 0.02, 1));
  const Trajectory motion = testing::random_motion(random, arm, Interpolation::cubic, 20, 0.1);
  const ClearanceOverTime ended = clearance_over_time(model, motion, {.max_work = 40});
  EXPECT_EQ(ended.ending, Ending::work_limit);
  EXPECT_EQ(ended.times.size(), ended.proved.size() + 1);
  EXPECT_LT(ended.times.back(), motion.times.back());
  EXPECT_REFUSED(clearance_over_time(model, {}), "no samples");
  EXPECT_TRUE(clearance_over_time(CollisionModel(arm, {}), motion).proved.empty());
}

}  // namespace
}  // namespace beeline
