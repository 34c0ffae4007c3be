#include <gtest/gtest.h>

#include <beeline/collision/internal/separation.h>
#include <beeline/control/internal/pair_bounds.h>

#include <tests/collision/random_model.h>
#include <tests/control/servo_cell.h>

namespace beeline::internal {
namespace {

using testing::Random;

/// The bounds of the distances of a model's pairs at a configuration, computed without a memory.
class Distances {
 public:
  explicit Distances(const CollisionBodies& bodies) : bodies_(bodies), motion_(bodies.motion) {}

  void move_to(const Configuration& q) {
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(q.size());
    motion_.set({q, zero, zero});
  }

  Separation of(const BodyPair& pair) const {
    const ConvexBody first = in_world(motion_, bodies_.link_bodies[pair.first].carried);
    const ConvexBody second = pair.is_obstacle
                                  ? bodies_.obstacle_bodies[pair.second].body
                                  : in_world(motion_, bodies_.link_bodies[pair.second].carried);
    return separation(first, second, second.centre - first.centre);
  }

 private:
  const CollisionBodies& bodies_;
  ChainMotion motion_;
};

/// A walk of many steps. Each body travels many metres; now and then the distances of some
/// pairs are computed.
void expect_bounds_to_hold(Random& random, const CollisionModel& model) {
  constexpr double rounding = 1e-12;  // m, of a distance
  const Arm& arm = model.arm();
  PairBounds bounds(model.bodies());
  Distances distances(model.bodies());
  Configuration q = middle_configuration(arm);
  int close = 0;
  for (int step = 0; step < testing::cases(600); ++step) {
    q += 0.05 * random.uniform(0, 1) * (random.configuration(arm) - q);
    bounds.move_to(q);
    distances.move_to(q);
    for (std::size_t g = 0; g < bounds.groups().size(); ++g) {
      const PairGroup& group = bounds.groups()[g];
      ASSERT_LT(group.begin, group.end);
      for (std::size_t i = group.begin; i < group.end; ++i) {
        const BodyPair& pair = bounds.pair(i);
        EXPECT_EQ(pair.group, g);
        EXPECT_EQ(pair.first, group.first);
        const Separation found = distances.of(pair);
        ASSERT_LE(bounds.excess(i), found.upper - pair.clearance + rounding) << step << ' ' << i;
        if (random.integer(0, 9) == 0) bounds.set_excess(i, found.lower - pair.clearance);
        if (bounds.excess(i) > found.lower - pair.clearance - 0.05) ++close;
      }
      double least = Limits::none;
      for (std::size_t i = group.begin; i < group.end; ++i) {
        least = std::min(least, bounds.excess(i));
      }
      if (least > -Limits::none) {
        EXPECT_NEAR(bounds.least_excess(g), least, 1e-14);
      } else {
        EXPECT_EQ(bounds.least_excess(g), least);
      }
    }
  }
  EXPECT_GT(close, testing::cases(600));
}

TEST(PairBounds, StayBelowTheDistances) {
  Random random;
  for (const auto& [name, cell] : {std::pair("panda", "corner"), std::pair("ur5", "itself")}) {
    const Arm arm = testing::loop_arm(name, testing::LoopLimits::accelerations);
    expect_bounds_to_hold(random, testing::loop_model(arm, name, testing::loop_scene(cell)));
  }
}

TEST(PairBounds, StayBelowTheDistancesOfAnArmThatSlides) {
  Random random;
  const Arm arm = testing::loop_arm("stanford", testing::LoopLimits::accelerations);
  const std::vector<LinkShapes> links = testing::random_link_shapes(random, arm, 0.1);
  expect_bounds_to_hold(random, CollisionModel(arm, links, testing::loop_scene("corner")));
}

TEST(PairBounds, AreUnknownAtFirstAndAfterAReset) {
  const Arm arm = testing::loop_arm("ur5", testing::LoopLimits::accelerations);
  const CollisionModel model = testing::loop_model(arm, "ur5", testing::loop_scene("wall"));
  PairBounds bounds(model.bodies());
  const auto expect_unknown = [&] {
    for (std::size_t i = 0; i < bounds.size(); ++i) EXPECT_EQ(bounds.excess(i), -Limits::none);
    for (std::size_t g = 0; g < bounds.groups().size(); ++g) {
      EXPECT_EQ(bounds.least_excess(g), -Limits::none);
    }
  };
  expect_unknown();
  for (int step = 0; step < 3; ++step) {
    bounds.move_to(Configuration::Constant(6, 0.1 * step));
    for (std::size_t i = 0; i < bounds.size(); ++i) bounds.set_excess(i, 0.5);
    EXPECT_NEAR(bounds.least_excess(0), 0.5, 1e-15);
  }
  bounds.reset();
  expect_unknown();
}

}  // namespace
}  // namespace beeline::internal
