#include <gtest/gtest.h>

#include <beeline/io/text/scene.h>

#include <tests/random.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::Random;
using testing::refusal;

Scene message(const std::string& text, const ShapeOptions& options = {}) {
  return scene_from_text(text, "cell.yaml", options);
}

/// A message with these collision objects, each given below its dash.
std::string with_objects(const std::string& objects, const std::string& more = "") {
  return "name: cell\n" + more + "world:\n  collision_objects:\n" + objects;
}

const std::string box = R"(    - id: box
      primitives: [{type: 1, dimensions: [1, 2, 3]}]
      primitive_poses: [{position: {x: 1, y: 2, z: 3}, orientation: {x: 0, y: 0, z: 0, w: 1}}]
)";

TEST(PlanningScene, PrimitivesAreReadWithTheirPoses) {
  const Scene scene = message(with_objects(box + R"(    - id: others
      header: {frame_id: world, stamp: {sec: 0}}
      operation: 0
      pose: {position: [0, 0, 1], orientation: [0, 0, 0, 0]}
      primitives:
        - {type: sphere, dimensions: [0.25]}
        - {type: 3, dimensions: [0.5, 0.125]}
        - {type: cone, dimensions: [0.5, 0.125]}
      primitive_poses:
        - {position: [0, 1, 0], orientation: [0, 0, 0, 1]}
        - {position: [0, 2, 0], orientation: [1, 0, 0, 0]}
        - {}
      planes: [{coef: [0, 0, 2, 0]}]
      plane_poses: [{position: [0, 0, 5]}]
      meshes: [{triangles: [{vertex_indices: [0, 1, 2]}],
                vertices: [{x: 0, y: 0, z: 0}, {x: 1, y: 0, z: 0}, {x: 0, y: 1, z: 0}]}]
      mesh_poses: [{position: {x: 0, y: 0, z: 7}, orientation: {x: 0, y: 0, z: 0, w: 1}}]
)"));
  ASSERT_EQ(scene.obstacles.size(), 2U);
  EXPECT_EQ(std::get<Box>(scene.obstacles[0].shapes[0].body).size, Vector3(1, 2, 3));
  EXPECT_EQ(scene.obstacles[0].shapes[0].pose.translation(), Vector3(1, 2, 3));
  const std::vector<Shape>& shapes = scene.obstacles[1].shapes;
  ASSERT_EQ(shapes.size(), 5U);
  EXPECT_EQ(std::get<Sphere>(shapes[0].body).radius, 0.25);
  EXPECT_EQ(std::get<Cylinder>(shapes[1].body).radius, 0.125);
  EXPECT_EQ(std::get<Cylinder>(shapes[1].body).length, 0.5);
  EXPECT_EQ(shapes[1].pose.linear()(2, 2), -1);
  EXPECT_EQ(std::get<ConvexHull>(shapes[2].body).vertices.front(), Vector3(0, 0, 0.25));
  EXPECT_EQ(std::get<ConvexHull>(shapes[3].body).vertices.size(), 3U);
  EXPECT_EQ(std::get<Box>(shapes[4].body).size.z(), 0);
  const double heights[] = {1, 1, 1, 8, 6};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(shapes[i].pose.translation().z(), heights[i]);
}

TEST(PlanningScene, JsonIsTheSameMessage) {
  const std::string json = R"({"name": "cell", "world": {"collision_objects": [
    {"id": "box", "header": {"frame_id": ""}, "operation": 0,
     "primitives": [{"type": 1, "dimensions": [1, 2, 3]}],
     "primitive_poses": [{"position": {"x": 1, "y": 2, "z": 3},
                          "orientation": {"x": 0, "y": 0, "z": 0, "w": 1}}]}]}})";
  const Scene scene = scene_from_text(json, "cell.json");
  EXPECT_EQ(scene_to_json(scene), scene_to_json(message(with_objects(box))));
  // Escapes, half a megabyte on one line, and lines in refusals are JSON's.
  std::string objects, comma;
  for (int i = 0; i < 20'000; ++i) {
    objects += comma + R"({"id": "\ud83d\ude00)" + std::to_string(i) +
               R"(", "planes": [{"coef": [0, 0, 1, 0]}], "plane_poses": [{}]})";
    comma = ",";
  }
  const auto in_world = [](const std::string& text) {
    return "{\"world\": {\"collision_objects\": [\n" + text + "]}}";
  };
  const Scene many = scene_from_text(in_world(objects), "cell.json");
  ASSERT_EQ(many.obstacles.size(), 20'000U);
  EXPECT_EQ(many.obstacles[7].name, "\xf0\x9f\x98\x80" + std::string("7"));
  EXPECT_EQ(refusal([&] { scene_from_text(in_world("{\"id\": null}"), "cell.json"); }),
            "cell.json:2: world.collision_objects[0] has no id");
}

TEST(PlanningScene, FramesAreKnownOrRefused) {
  Random random;
  const Pose base = random.pose(), fixed = random.pose();
  const Eigen::Quaterniond q(fixed.linear());
  const std::string transforms =
      "fixed_frame_transforms:\n  - {header: {frame_id: base}, child_frame_id: camera, transform: "
      "{translation: [" +
      exact(fixed.translation().x()) + ", " + exact(fixed.translation().y()) + ", " +
      exact(fixed.translation().z()) + "], rotation: [" + exact(q.x()) + ", " + exact(q.y()) +
      ", " + exact(q.z()) + ", " + exact(q.w()) + "]}}\n";
  const auto in_frame = [&](const std::string& frame) {
    return with_objects("    - id: ball\n      header: {frame_id: " + frame + R"(}
      primitives: [{type: 2, dimensions: [1]}]
)",
                        transforms);
  };
  const ShapeOptions options{.frames = {{"", Pose::Identity()}, {"base", base}}};
  const auto pose_in = [&](const std::string& frame) {
    return message(in_frame(frame), options).obstacles.at(0).shapes.at(0).pose;
  };
  EXPECT_EQ(pose_in("/base").matrix(), base.matrix());
  EXPECT_TRUE(pose_in("camera").isApprox(base * fixed, 1e-14));
  EXPECT_TRUE(pose_in("world").isApprox(Pose::Identity()));
  const auto moved = [&](const std::string& child) {
    return message(with_objects(box, "fixed_frame_transforms: [{child_frame_id: " + child +
                                         ", transform: {translation: [0, 0, 5]}}]\n"),
                   {.frames = {{"", Pose::Identity()}, {"base", base}}});
  };
  EXPECT_REFUSED(moved("base"), "is \"base\", whose pose is known, and another one");
  EXPECT_REFUSED(moved("world"), "is \"world\", whose pose is known, and another one");
  EXPECT_EQ(refusal([&] { message(in_frame("hand"), options); }),
            "cell.yaml:6: world.collision_objects[0] is in the frame \"hand\", whose pose in the "
            "world is not known; known frames: base, camera, world, and others by "
            "frames={\"hand\": POSE}");
}

TEST(PlanningScene, TheMatrixExemptsPairs) {
  const std::string matrix = R"(allowed_collision_matrix:
  entry_names: [a, b, c]
  entry_values:
    - {enabled: [false, true, true]}
    - [true, false, false]
    - [false, false, false]
  default_entry_names: [box, c, d]
  default_entry_values: [true, false, true]
)";
  const Scene scene = message(with_objects(box, matrix));
  // a and c: only one of the two entries; c with others: by its default never.
  const std::vector<NamedPair> pairs{{"a", "b"},   {"a", "box"}, {"a", "d"},
                                     {"b", "box"}, {"b", "d"},   {"box", "d"}};
  EXPECT_EQ(scene.exempted_pairs, pairs);
  EXPECT_EQ(scene_from_json(scene_to_json(scene), "again.json").exempted_pairs, pairs);
}

TEST(PlanningScene, RefusalsNameTheValue) {
  const auto of = [](const std::string& text) { return refusal([&] { message(text); }); };
  EXPECT_EQ(of("name: cell\n"), "cell.yaml:1: the message has no world");
  EXPECT_EQ(of(with_objects("    - {primitives: []}\n")),
            "cell.yaml:4: world.collision_objects[0] has no id");
  EXPECT_EQ(of(with_objects(box + box)).substr(0, 40), "cell.yaml:7: world.collision_objects[1].");
  const auto with = [&](const std::string& dimensions) {
    return with_objects("    - {id: a, primitives: [" + dimensions + "]}\n");
  };
  EXPECT_EQ(of(with("{type: 3, dimensions: [1]}")),
            "cell.yaml:4: world.collision_objects[0].primitives[0].dimensions has 1 numbers; a "
            "cylinder has 2");
  EXPECT_EQ(of(with("{type: 5, dimensions: [1]}")),
            "cell.yaml:4: world.collision_objects[0].primitives[0].type is \"5\"; it must be 1 "
            "(box), 2 (sphere), 3 (cylinder) or 4 (cone)");
  EXPECT_EQ(of(with("{type: 2, dimensions: [.inf]}")).substr(0, 13), "cell.yaml:4: ");
  EXPECT_EQ(of(with("{type: 2, dimensions: [-1]}")).substr(0, 66),
            "cell.yaml:4: world.collision_objects[0].primitives[0] is no shape:");
  EXPECT_EQ(of(with_objects("    - {id: a, primitives: [{}, {}], primitive_poses: [{}]}\n")),
            "cell.yaml:4: world.collision_objects[0] has 2 primitives and 1 primitive_poses; there "
            "must be one for each");
  EXPECT_EQ(of(with_objects("    - {id: a, operation: 1}\n")),
            "cell.yaml:4: world.collision_objects[0].operation is \"1\"; objects of a whole scene "
            "are added (0)");
  EXPECT_EQ(
      of(with_objects("    - {id: a, meshes: [{vertices: [{x: 0}, '...']}]}\n")),
      "cell.yaml:4: world.collision_objects[0].meshes[0].vertices is cut off at \"...\"; ros2 "
      "topic echo --full-length writes all of it");
  EXPECT_EQ(refusal([] { scene_from_text("", "cell.txt"); }),
            "cell.txt: is not a known kind of scene; known are .urdf, .xml, .mjcf, .xacro, .json, "
            ".scene, .yaml, .yml, .ply, .npy");
  // What is misspelt is not lost.
  EXPECT_EQ(of("world: {collision_object: []}\n").substr(0, 30), "cell.yaml:1: world: unknown ke");
  EXPECT_EQ(of(with_objects("    - {id: a, primitive: []}\n")).substr(0, 50),
            "cell.yaml:4: world.collision_objects[0]: unknown k");
  EXPECT_EQ(of(with_objects("    - {id: a, primitives: [{type: 2, dimensions: [1]}], "
                            "primitive_poses: [{orientaton: [0, 0, 0, 1]}]}\n"))
                .substr(0, 13),
            "cell.yaml:4: ");
  EXPECT_EQ(
      of(with_objects("    - {id: a}\n")),
      "cell.yaml:4: world.collision_objects[0] has no shapes; types of a database are not read");
  EXPECT_EQ(of(with_objects(box + "---\n")), "accepted");
  EXPECT_EQ(of(with_objects("    - {id: a, operation: \"\\0\", planes: [{coef: [0, 0, 1, 0]}], "
                            "plane_poses: [{}]}\n")),
            "accepted");
  for (const std::string others :
       {"is_diff: true\n", "link_padding: [{link_name: a, padding: 0.01}]\n",
        "link_scale: [{link_name: a, scale: 1.1}]\n",
        "robot_state: {attached_collision_objects: [{link_name: hand}]}\n"}) {
    EXPECT_NE(of(with_objects(box, others)), "accepted") << others;
  }
  const std::string octomap = "world: {octomap: {octomap: {data: [1]}}, collision_objects: []}\n";
  EXPECT_EQ(of(octomap), "cell.yaml:1: world.octomap.octomap is an octree, which is not read");
}

}  // namespace
}  // namespace beeline
