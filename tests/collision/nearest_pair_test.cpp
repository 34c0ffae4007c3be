#include <cmath>
#include <gtest/gtest.h>

#include <beeline/collision/collision_model.h>
#include <beeline/collision/internal/nearest_pair.h>
#include <beeline/collision/internal/separation.h>
#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>

#include <tests/collision/random_model.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::Random;

/// Without the search for pairs that need not count.
const CollisionOptions all_pairs{.budget = {.max_work = 0}};

Shape moved_by(const Pose& pose, Shape shape) {
  shape.pose = pose * shape.pose;
  return shape;
}

/// The distance of every pair that counts, by the shapes' poses in the world.
struct BruteForce {
  double lower = std::numeric_limits<double>::infinity(), upper = lower;

  BruteForce(const Arm& arm, const std::vector<LinkShapes>& links, const Scene& scene,
             const Configuration& q) {
    const std::vector<Pose> poses = link_poses(arm, q);
    const auto add = [&](const Shape& a, const Shape& b) {
      const internal::Separation found =
          internal::separation(internal::convex_body(a), internal::convex_body(b));
      lower = std::min(lower, found.lower);
      upper = std::min(upper, found.upper);
    };
    for (const LinkShapes& link : links) {
      for (const Shape& body : link.shapes) {
        const Shape shape = moved_by(poses[link.link], body);
        for (const LinkShapes& earlier : links) {
          if (earlier.link + 2 > link.link) continue;
          for (const Shape& other : earlier.shapes) {
            add(shape, moved_by(poses[earlier.link], other));
          }
        }
        if (link.link == 0) continue;
        for (const Obstacle& obstacle : scene.obstacles) {
          for (const Shape& other : obstacle.shapes) add(shape, other);
        }
      }
    }
  }
};

TEST(NearestPair, IsTheLeastOfAllPairs) {
  Random random;
  for (int i = 0; i < testing::cases(300); ++i) {
    const Arm arm = testing::random_arm(random, random.integer(2, 7), 4);
    const auto links = testing::random_link_shapes(random, arm, 0.3);
    const Scene scene = testing::random_scene(random, arm, random.integer(0, 20), 0.5, 3);
    const CollisionModel model(arm, links, scene, all_pairs);
    const Configuration q = random.configuration(arm);
    const BruteForce expected(arm, links, scene, q);
    const BodyDistance nearest = nearest_pair(model, q);
    EXPECT_LE(nearest.lower, expected.upper + 1e-12);
    if (expected.lower > 0) {
      EXPECT_NEAR(nearest.lower, expected.lower, 1e-6);
      EXPECT_NEAR((nearest.on_first - nearest.on_second).norm(), nearest.upper, 1e-9);
    }
    for (const BodyDistance& pair : pairs_too_close(model, q)) {
      EXPECT_LT(pair.lower, pair.clearance);
      if (nearest.lower > 0) {
        EXPECT_GE(pair.lower, nearest.lower - 1e-6);
      }
    }
    EXPECT_EQ(pairs_too_close(model, q).empty(), nearest.lower >= nearest.clearance);
  }
}

TEST(NearestPair, HasTheGradientOfTheDistance) {
  Random random;
  int compared = 0;
  for (int i = 0; i < testing::cases(300); ++i) {
    const Arm arm = testing::random_arm(random, random.integer(2, 6), 4);
    // Spheres, whose nearest points do not jump.
    std::vector<LinkShapes> links;
    for (std::size_t l = 0; l <= arm.joints().size(); ++l) {
      links.push_back({"link" + std::to_string(l), l, {{Sphere{0.1}, random.pose(0.5)}}});
    }
    const Scene scene{.obstacles = {{"ball", {{Sphere{0.2}, random.pose(4)}}}}};
    const CollisionModel model(arm, links, scene, all_pairs);
    const Configuration q = random.configuration(arm);
    const BodyDistance here = nearest_pair(model, q);
    if (here.lower < 1e-3) continue;
    constexpr double step = 1e-6;
    for (Eigen::Index k = 0; k < arm.dof(); ++k) {
      const Configuration aside = step * Configuration::Unit(arm.dof(), k);
      const BodyDistance above = nearest_pair(model, q + aside);
      const BodyDistance below = nearest_pair(model, q - aside);
      if (above.names != here.names || below.names != here.names) continue;
      EXPECT_NEAR((above.lower - below.lower) / (2 * step), here.gradient[k], 1e-5);
      ++compared;
    }
  }
  EXPECT_GT(compared, testing::cases(300));
}

TEST(NearestPair, LeavesOutPairsThatDoNotCount) {
  const Arm arm = built_in("rrr");
  const auto link = [](std::size_t i) {
    return LinkShapes{"link" + std::to_string(i), i, {{Sphere{0.1}}}};
  };
  const std::vector<LinkShapes> links{link(0), link(1), link(2), link(3)};
  const Scene scene{.obstacles = {{"ball", {{Sphere{0.1}, make_pose({20, 0, 0})}}}}};
  EXPECT_EQ(CollisionModel(arm, links, scene, all_pairs).pair_count(), 3 + 3)
      << "0-2, 0-3, 1-3; 1, 2, 3";
  EXPECT_EQ(CollisionModel(arm, links, scene, {.self_collision = false}).pair_count(), 3);
  EXPECT_EQ(CollisionModel(arm, links, scene,
                           {.allowed_pairs = {{"ball", "link2"}, {"link3", "link0"}},
                            .budget = all_pairs.budget})
                .pair_count(),
            4);
  EXPECT_EQ(CollisionModel(arm, links, scene).neighbour_pairs(),
            (std::vector<NamedPair>{{"link0", "link1"}, {"link1", "link2"}, {"link2", "link3"}}));
  LinkShapes camera = link(2);
  camera.at_proximal_joint = camera.at_distal_joint = false;
  EXPECT_TRUE(CollisionModel(arm, {link(1), camera}).neighbour_pairs().empty());
  const Configuration folded{{0, 3.1, 3.1}};
  EXPECT_EQ(nearest_pair(CollisionModel(arm, links), folded).names, (NamedPair{"link2", "link0"}));
}

TEST(NearestPair, AppliesTheClearanceOfEachObstacle) {
  const Arm arm = built_in("rrr");
  const std::vector<LinkShapes> links{{"tip", 3, {{Sphere{0.1}}}}};
  const Configuration q = Configuration::Zero(3);
  const double x = link_poses(arm, q)[3].translation().x();
  const Scene scene{.obstacles = {{"near", {{Sphere{0.1}, make_pose({x, 0.5, 0})}}},
                                  {"far", {{Sphere{0.1}, make_pose({x, -1, 0})}}, 0.9}}};
  const CollisionModel model(arm, links, scene);
  EXPECT_EQ(nearest_pair(model, q).names[1], "far") << "0.1 m too close, though further away";
  ASSERT_EQ(pairs_too_close(model, q).size(), 1);
  EXPECT_EQ(pairs_too_close(model, q)[0].clearance, 0.9);
}

TEST(CollisionModel, RefusesWhatIsNoModel) {
  const Arm arm = built_in("rrr");
  const std::vector<LinkShapes> links{{"tip", 3, {{Sphere{0.1}}}}};
  const auto model = [&](const std::vector<LinkShapes>& shapes, const Scene& scene = {},
                         const CollisionOptions& options = {}) {
    return CollisionModel(arm, shapes, scene, options).pair_count();
  };
  EXPECT_REFUSED(model({{"tip", 4, {}}}), "rrr has links 0 to 3");
  EXPECT_REFUSED(model({{"tip", 3, {{Sphere{-1}}}}}), "\"tip\": a sphere has a radius of -1 m");
  EXPECT_REFUSED(model({{"tip", 3, {{HalfSpace{}}}}}), "a half_space is an obstacle");
  EXPECT_REFUSED(model({{"tip", 3, {}}, {"tip", 2, {}}}), "two links or obstacles have the name");
  const std::vector<Shape> ball{{Sphere{0.1}}};
  EXPECT_REFUSED(model(links, {.obstacles = {{"", ball}}}), "has no name");
  EXPECT_REFUSED(model(links, {.obstacles = {{"tip", ball}}}), "two links or obstacles");
  EXPECT_REFUSED(model(links, {.obstacles = {{"table", ball, 0.0}}}),
                 "\"table\": a clearance of 0 m; it must be above 0 and at most 1e+06 m");
  EXPECT_REFUSED(model(links, {.obstacles = {{"table", {}}}}),
                 "\"table\": an obstacle has no shape");
  EXPECT_REFUSED(model(links, {}, {.clearance = 0}), "a clearance of 0 m");
  EXPECT_REFUSED(model(links, {}, {.allowed_pairs = {{"tip", "tabel"}}}), "link or obstacle");
  EXPECT_REFUSED(nearest_pair(CollisionModel(arm, {}), Configuration::Zero(3)), "no pair");
  EXPECT_REFUSED(nearest_pair(CollisionModel(arm, links), Configuration::Zero(2)), "2");
}

TEST(SpareClearance, IsTheDistanceOfTheNearestPairBeyondItsClearance) {
  Random random;
  int blocked = 0, free = 0;
  for (int i = 0; i < 100; ++i) {
    const Arm arm = testing::random_arm(random, random.integer(2, 7), 4);
    const CollisionModel model(arm, testing::random_link_shapes(random, arm, 0.3),
                               testing::random_scene(random, arm, random.integer(1, 20), 0.5, 3));
    const Configuration q = random.configuration(arm);
    if (!internal::has_pairs(model, q)) continue;
    const BodyDistance nearest = nearest_pair(model, q);
    const double spare = nearest.lower - nearest.clearance;
    EXPECT_EQ(spare_clearance(model, q), spare);
    EXPECT_EQ(spare_clearance(model, q, 0.01), std::min(spare, 0.01));
    EXPECT_EQ(spare < 0, static_cast<bool>(blocked_by(model, q)));
    (spare < 0 ? blocked : free) += 1;
  }
  EXPECT_GT(blocked, 0);
  EXPECT_GT(free, 0);
}

TEST(SpareClearance, IsTheMostWithoutPairs) {
  const Arm arm = built_in("ur5");
  const CollisionModel model(arm, {}, {});
  EXPECT_EQ(spare_clearance(model, Configuration::Zero(6)), Limits::none);
  EXPECT_EQ(spare_clearance(model, Configuration::Zero(6), 0.1), 0.1);
  EXPECT_REFUSED(spare_clearance(model, Configuration::Zero(5)), "6");
  EXPECT_REFUSED(spare_clearance(model, Configuration::Zero(6), -1), "0 or more");
  EXPECT_REFUSED(spare_clearance(model, Configuration::Zero(6), std::nan("")), "0 or more");
}

}  // namespace
}  // namespace beeline
