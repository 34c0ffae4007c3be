#include <gtest/gtest.h>

#include <beeline/collision/collision_model.h>
#include <beeline/model/catalog.h>

namespace beeline {
namespace {

/// A scene with one box.
Scene box_at(const Vector3& place) {
  return {.obstacles = {{.name = "box",
                         .shapes = {{.body = Box{Vector3::Constant(0.1)},
                                     .pose = Pose(Eigen::Translation3d(place))}}}}};
}

TEST(Digest, DiffersWithWhatIsChecked) {
  const Arm arm = built_in("ur5");
  std::vector<LinkShapes> links;
  for (std::size_t i = 1; i <= 6; ++i) {
    links.push_back(
        {.name = "link" + std::to_string(i), .link = i, .shapes = {{.body = Sphere{0.03}}}});
  }
  const Scene scene = box_at(Vector3(0.5, 0, 0));
  const auto digest_of = [&](const std::vector<LinkShapes>& shapes, const Scene& around,
                             const CollisionOptions& options) {
    return digest(CollisionModel(arm, shapes, around, options));
  };
  const std::string same = digest_of(links, scene, {});
  EXPECT_EQ(same.size(), 16U);
  EXPECT_EQ(same, digest_of(links, scene, {.budget = {.max_work = 0}}));
  EXPECT_EQ(same, digest(with_mount(CollisionModel(arm, links, scene), Pose::Identity())));
  std::vector<LinkShapes> larger = links;
  std::get<Sphere>(larger.back().shapes[0].body).radius *= 1.01;
  Scene thick = scene;
  thick.obstacles[0].shapes[0].padding = 0.01;
  Scene own = scene;
  own.obstacles[0].clearance = 0.02;
  for (const std::string& other :
       {digest_of(larger, scene, {}), digest_of(links, thick, {}), digest_of(links, own, {}),
        digest_of(links, box_at(Vector3(0.5, 0, 1e-9)), {}),
        digest_of(links, scene, {.clearance = 0.002}),
        digest_of(links, scene, {.self_collision = false}),
        digest_of(links, scene, {.allowed_pairs = {{"link2", "box"}}}),
        digest_of(links, scene, {.allowed_pairs = {{"link2", "link5"}}})}) {
    EXPECT_NE(same, other);
  }
}

TEST(Digest, DoesNotDependOnTheOrderOfObstaclesNorOnPairsOfTheFixedLink) {
  const Arm arm = built_in("ur5");
  const std::vector<LinkShapes> links{{.name = "base", .link = 0, .shapes = {{.body = Sphere{}}}},
                                      {.name = "tool", .link = 6, .shapes = {{.body = Sphere{}}}}};
  Scene scene = box_at(Vector3(0.5, 0, 0));
  scene.obstacles.push_back({.name = "ball", .shapes = {{.body = Sphere{0.2}}}, .clearance = 0.02});
  Scene reversed = scene;
  std::swap(reversed.obstacles[0], reversed.obstacles[1]);
  const auto digest_of = [&](const Scene& around, const std::vector<NamedPair>& allowed) {
    return digest(CollisionModel(arm, links, around, {.allowed_pairs = allowed}));
  };
  EXPECT_EQ(digest_of(scene, {}), digest_of(reversed, {}));
  EXPECT_EQ(digest_of(scene, {}), digest_of(scene, {{"base", "ball"}}));
  EXPECT_EQ(digest_of(scene, {{"tool", "ball"}}), digest_of(reversed, {{"tool", "ball"}}));
  EXPECT_NE(digest_of(scene, {{"tool", "ball"}}), digest_of(scene, {{"tool", "box"}}));
}

}  // namespace
}  // namespace beeline
