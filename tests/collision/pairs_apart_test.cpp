#include <gtest/gtest.h>

#include <beeline/certificate/clearance.h>
#include <beeline/collision/internal/collision_bodies.h>
#include <beeline/model/catalog.h>
#include <beeline/model/internal/joint_axes.h>

#include <tests/collision/random_model.h>

namespace beeline {
namespace {

using testing::Random;

/// The shapes of an arm on the lines between its joints, thin.
std::vector<LinkShapes> thin_links(const Arm& arm) {
  std::vector<LinkShapes> links;
  for (std::size_t i = 0; i <= arm.joints().size(); ++i) {
    links.push_back({.name = "link" + std::to_string(i), .link = i, .shapes = {{Sphere{0.03}}}});
    if (i == 0) continue;
    const Vector3 back = -(arm.joints()[i - 1].offset.translation());
    Shape capsule{Capsule{0.03, back.norm()}};
    const Vector3 z = (back + Vector3(0, 0, 1e-9)).normalized();
    capsule.pose = internal::frame_along(z.unitOrthogonal(), z, back / 2);
    links.back().shapes.push_back(capsule);
  }
  return links;
}

TEST(PairsApart, NeverComeCloserWithinTheLimits) {
  Random random;
  std::size_t found = 0;
  for (int i = 0; i < testing::cases(60); ++i) {
    Arm arm = i % 3 == 0 ? built_in("ur5e") : testing::random_arm(random, random.integer(2, 5));
    std::map<std::string, LimitOverrides> limits;
    for (const std::string& name : arm.joint_names()) {
      const double middle = random.uniform(-2, 2), half = random.uniform(0.05, 1);
      limits[name] = {.lower = middle - half, .upper = middle + half};
    }
    if (random.integer(0, 2) != 0) arm = with_limits(arm, limits);
    const auto links = i % 3 == 0 ? thin_links(arm) : testing::random_link_shapes(random, arm, 0.1);
    const CollisionOptions options{.clearance = random.uniform(0.001, 0.05)};
    CollisionOptions exhaustive = options;
    exhaustive.budget.max_work = 0;
    const CollisionModel model(arm, links, {}, options), all(arm, links, {}, exhaustive);
    EXPECT_EQ(all.apart_count(), 0);
    EXPECT_EQ(model.pair_count() + model.apart_count(), all.pair_count());
    found += model.apart_count();
    for (int k = 0; k < 200 && all.pair_count() > 0; ++k) {
      const Configuration q = random.configuration(arm);
      EXPECT_EQ(pairs_too_close(model, q).size(), pairs_too_close(all, q).size());
    }
  }
  EXPECT_GT(found, static_cast<std::size_t>(testing::cases(60)));
}

TEST(PairsApart, CountOutsideTheLimits) {
  // Two links fold onto each other only beyond the limit of the joint between them.
  const Arm arm = with_limits(built_in("rrr"), {{"joint2", {.lower = -1, .upper = 1}},
                                                {"joint3", {.lower = -1, .upper = 1}}});
  const std::vector<LinkShapes> links{{.name = "base", .link = 0, .shapes = {{Sphere{0.1}}}},
                                      {.name = "tip", .link = 3, .shapes = {{Sphere{0.1}}}},
                                      {.name = "elbow", .link = 1, .shapes = {{Sphere{0.1}}}}};
  const CollisionModel model(arm, links);
  EXPECT_EQ(model.pair_count(), 0);
  EXPECT_EQ(model.apart_count(), 2);
  const Configuration inside{{0, 0.9, 0.9}};
  EXPECT_TRUE(pairs_too_close(model, inside).empty());
  const Configuration at_base{{0, 2.56208, 1.86055}};  // the links are a triangle
  const auto proof_to = [&](const Configuration& q) {
    return prove_clearance(model, {arm.joint_names(), {0, 1}, {inside, q}, {}, {}});
  };
  EXPECT_TRUE(proof_to(Configuration{{0.5, -0.9, 0.9}}));
  EXPECT_EQ(pairs_too_close(model, at_base).size(), 1);
  EXPECT_EQ(nearest_pair(model, at_base).names, (NamedPair{"tip", "base"}));
  EXPECT_EQ(proof_to(at_base).status, ClearanceStatus::collides);
}

TEST(PairsApart, ArmsWithoutLimitsTurnOnce) {
  // A joint without limits is searched over one revolution.
  Joint joint;
  joint.screw = rotation_screw(Vector3::UnitZ());
  joint.name = "a";
  Joint next = joint;
  next.name = "b";
  next.offset = make_pose({1, 0, 0});
  const Arm arm("free", {joint, next});
  const auto model = [&](double reach) {
    return CollisionModel(
        arm, {{"base", 0, {{Sphere{0.1}}}}, {"tip", 2, {{Sphere{0.1}, make_pose({reach, 0, 0})}}}});
  };
  EXPECT_EQ(model(0.5).apart_count(), 1);
  EXPECT_TRUE(pairs_too_close(model(0.5), Configuration{{100, -50}}).empty());
  EXPECT_EQ(model(0.9).apart_count(), 0) << "the tip comes to 0.1 m from the base";
}

}  // namespace
}  // namespace beeline
