#include <gtest/gtest.h>

#include <beeline/io/text/scene.h>

#include <tests/collision/random_shape.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::Random;

Scene scene_of(const std::string& obstacles, const std::string& rest = "") {
  return scene_from_json("{\"obstacles\": [" + obstacles + "]" + rest + "}", "cell.json");
}

Shape shape_of(const std::string& shape) {
  return scene_of("{\"name\": \"a\", \"shapes\": [" + shape + "]}").obstacles.at(0).shapes.at(0);
}

TEST(Scene, ReadsEveryShape) {
  EXPECT_EQ(std::get<Sphere>(shape_of(R"({"sphere": {"radius": 0.5}})").body).radius, 0.5);
  const auto capsule =
      std::get<Capsule>(shape_of(R"({"capsule": {"radius": 1, "length": 2}})").body);
  EXPECT_EQ(capsule.radius, 1);
  EXPECT_EQ(capsule.length, 2);
  EXPECT_EQ(std::get<Box>(shape_of(R"({"box": {"size": [1, 2, 3]}})").body).size.y(), 2);
  EXPECT_EQ(std::get<Cylinder>(shape_of(R"({"cylinder": {"radius": 1, "length": 2}})").body).length,
            2);
  EXPECT_EQ(kind_name(shape_of(R"({"half_space": {}})")), "half_space");
  const Shape hull = shape_of(R"({"convex_hull": {"vertices": [[0, 0, 1], [0, 1, 0]]},
                                  "pose": {"xyz": [1, 0, 0]}, "padding": 0.01})");
  EXPECT_EQ(std::get<ConvexHull>(hull.body).vertices.at(1).y(), 1);
  EXPECT_EQ(hull.pose.translation().x(), 1);
  EXPECT_EQ(hull.padding, 0.01);
}

TEST(Scene, ReadsBackAsItWasWritten) {
  Random random;
  for (int i = 0; i < testing::cases(200); ++i) {
    Scene scene;
    for (int k = random.integer(0, 5); k > 0; --k) {
      Obstacle obstacle{.name = "obstacle \"" + std::to_string(k) + "\""};
      for (int s = random.integer(1, 3); s > 0; --s) {
        obstacle.shapes.push_back(
            testing::random_shape(random, random.integer(0, testing::shape_kinds - 1), 1, 2));
      }
      if (random.integer(0, 1) == 0) obstacle.clearance = random.uniform(1e-4, 0.1);
      scene.obstacles.push_back(obstacle);
    }
    if (random.integer(0, 1) == 0) scene.allowed_pairs = {{"hand", "table"}, {"a", "b"}};
    const std::string text = scene_to_json(scene);
    const Scene read = scene_from_json(text, "cell.json");
    ASSERT_EQ(read.obstacles.size(), scene.obstacles.size());
    EXPECT_EQ(read.allowed_pairs, scene.allowed_pairs);
    for (std::size_t k = 0; k < scene.obstacles.size(); ++k) {
      EXPECT_EQ(read.obstacles[k].clearance, scene.obstacles[k].clearance);
      ASSERT_EQ(read.obstacles[k].shapes.size(), scene.obstacles[k].shapes.size());
    }
    EXPECT_EQ(scene_to_json(read), text);
  }
}

TEST(Scene, RefusesOtherValuesByTheirPlace) {
  EXPECT_REFUSED(scene_from_json("{}", "cell.json"), "cell.json");
  EXPECT_TRUE(scene_from_json(R"({"$schema": "a", "obstacles": []})", "a").obstacles.empty());
  EXPECT_REFUSED(scene_from_json(R"({"$schema": 1, "obstacles": []})", "a"), "$schema");
  EXPECT_REFUSED(scene_of(R"({"name": "a", "shapes": [{"sphere": {"radius": 1},
                              "pose": {"rpy": [0, -90, 0]}}]})"),
                 "rpy has an angle of 90 rad; at most 12.5664, two revolutions, are accepted");
  EXPECT_REFUSED(scene_of(R"({"shapes": []})"), "name");
  EXPECT_REFUSED(scene_of(R"({"name": "a"})"), "shapes");
  EXPECT_REFUSED(scene_of(R"({"name": "", "shapes": []})"), "obstacles[0].name");
  EXPECT_REFUSED(scene_of(R"({"name": "a", "shapes": [], "clearance": 0})"),
                 "obstacles[0].clearance is a clearance of 0 m; it must be above 0");
  EXPECT_REFUSED(scene_of(R"({"name": "a", "shapes": [], "clearance": 2e6})"),
                 "a clearance of 2e+06 m; it must be above 0 and at most 1e+06 m");
  const std::string ball = R"({"name": "a", "shapes": [{"sphere": {"radius": 1}}]})";
  EXPECT_REFUSED(scene_of(ball + ", " + ball), "obstacles[1]");
  EXPECT_REFUSED(scene_of(R"({"name": "a", "shapes": []})"), "obstacles[0].shapes has no shape");
  EXPECT_REFUSED(scene_to_json({.obstacles = {{"a", {}}}}), "\"a\" has no shape");
  EXPECT_REFUSED(scene_of("", R"(, "allowed_pairs": [["a"]])"), "two names");
  EXPECT_REFUSED(scene_of("", R"(, "walls": [])"), "walls");
  EXPECT_REFUSED(shape_of("{}"), "exactly one of the keys");
  EXPECT_REFUSED(shape_of(R"({"box": {"size": [1, 1, 1]}, "sphere": {"radius": 1}})"), "box");
  EXPECT_REFUSED(shape_of(R"({"box": {"size": [1, 1]}})"), "shapes[0].box.size");
  EXPECT_REFUSED(shape_of(R"({"box": {"size": [1, 1, -1]}})"), "a box has an edge of -1 m");
  EXPECT_REFUSED(shape_of(R"({"sphere": {"radius": 1, "length": 2}})"), "length");
  EXPECT_REFUSED(shape_of(R"({"mesh": {}})"), "mesh");
  EXPECT_REFUSED(shape_of(R"({"convex_hull": {"vertices": []}})"), "no vertices");
}

}  // namespace
}  // namespace beeline
