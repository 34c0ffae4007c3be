#include <gtest/gtest.h>

#include <beeline/io/text/scene.h>

#include <tests/io/text/mesh_samples.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline {
namespace {

using testing::Random;

const std::string ball = "<collision><geometry><sphere radius=\"0.1\"/></geometry></collision>";

std::string cell_joint(const std::string& name, const std::string& type, const std::string& parent,
                       const std::string& child, const std::string& more = "") {
  return "<joint name=\"" + name + "\" type=\"" + type + "\"><parent link=\"" + parent +
         "\"/><child link=\"" + child + "\"/>" + more + "</joint>\n";
}

std::string cell_link(const std::string& name, const std::string& inside = ball) {
  return "<link name=\"" + name + "\">" + inside + "</link>\n";
}

Scene cell_of(const std::string& elements, const ShapeOptions& options = {}) {
  return scene_from_urdf("<robot name=\"cell\">\n" + elements + "</robot>", "cell.urdf", options);
}

/// Chains of links with random origins and axes; the poses are multiplied up here by themselves.
TEST(UrdfScene, ObstaclesAreWhereTheTreeHasThem) {
  Random random;
  for (int i = 0; i < testing::cases(90); ++i) {
    std::string text = cell_link("world", random.integer(0, 1) == 0 ? "" : ball);
    std::vector<Pose> poses{Pose::Identity()};
    std::map<std::string, double> held, hold;
    const int count = random.integer(1, 6);
    for (int k = 1; k <= count; ++k) {
      const int parent = random.integer(0, k - 1), type = random.integer(0, 2);
      const Vector3 xyz = random.vector(), axis = random.direction();
      const std::string name = "j" + std::to_string(k);
      double value = type == 0 ? 0 : 0.25;  // the limit next to 0
      if (type != 0 && random.integer(0, 1) == 0) value = hold[name] = random.uniform(0.25, 2);
      if (type != 0) held[name] = value;
      text +=
          cell_link("l" + std::to_string(k)) +
          cell_joint(name, std::array{"fixed", "revolute", "prismatic"}[std::size_t(type)],
                     parent == 0 ? "world" : "l" + std::to_string(parent), "l" + std::to_string(k),
                     "<origin xyz=\"" + testing::coordinates(xyz) + "\"/><axis xyz=\"" +
                         testing::coordinates(axis) + "\"/><limit lower=\"0.25\" upper=\"2\"/>");
      Pose pose = poses[static_cast<std::size_t>(parent)] * Eigen::Translation3d(xyz);
      if (type == 1) pose.rotate(Eigen::AngleAxisd(value, axis));
      if (type == 2) pose.translate(value * axis);
      poses.push_back(pose);
    }
    const Scene scene = cell_of(text, {.hold = hold});
    EXPECT_EQ(scene.held, held);
    const std::size_t first = scene.obstacles.at(0).name == "world" ? 0 : 1;
    ASSERT_EQ(scene.obstacles.size() + first, poses.size());
    for (std::size_t k = first; k < poses.size(); ++k) {
      const Obstacle& obstacle = scene.obstacles[k - first];
      EXPECT_EQ(obstacle.name, k == 0 ? "world" : "l" + std::to_string(k));
      EXPECT_TRUE(obstacle.shapes.at(0).pose.isApprox(poses[k], 1e-12));
    }
  }
}

TEST(UrdfScene, JointsWithoutShapesAreNotReportedAndMimicJointsFollow) {
  const std::string tree = cell_link("world") + cell_link("door") + cell_link("handle", "") +
                           cell_link("twin") + cell_joint("hinge", "continuous", "world", "door") +
                           cell_joint("turn", "continuous", "door", "handle") +
                           cell_joint("other", "prismatic", "world", "twin",
                                      "<mimic joint=\"hinge\" multiplier=\"2\" offset=\"1\"/>") +
                           cell_link("part") + cell_joint("loose", "floating", "world", "part");
  EXPECT_EQ(cell_of(tree).held,
            (std::map<std::string, double>{{"hinge", 0}, {"loose", 0}, {"other", 1}}));
  EXPECT_EQ(cell_of(tree, {.hold = {{"hinge", 0.5}}}).held.at("other"), 2);
  EXPECT_REFUSED(cell_of(tree, {.hold = {{"other", 1}}}), "hold that one");
  EXPECT_REFUSED(cell_of(tree, {.hold = {{"hing", 1}}}), "did you mean \"hinge\"");
  EXPECT_REFUSED(cell_of(cell_link("world"), {.hold = {{"hinge", 1}}}), "no joint moves");
}

TEST(UrdfScene, WhatWouldLoseAnObstacleIsRefused) {
  EXPECT_EQ(cell_of(cell_link("world")).obstacles.size(), 1u);
  EXPECT_REFUSED(cell_of(cell_link("world", "")), "cell.urdf: has no <collision> elements");
  EXPECT_REFUSED(cell_of(cell_link("a") + cell_link("b")), "several root links, a, b");
  const std::string two = cell_link("a") + cell_link("b");
  EXPECT_REFUSED(cell_of(two + cell_joint("j", "fixed", "a", "c")), "unknown child link \"c\"");
  EXPECT_REFUSED(cell_of(two + "<joint name=\"j\" type=\"fixed\"><parent link=\"a\"/></joint>"),
                 "cell.urdf:4");
  EXPECT_REFUSED(
      cell_of(two + cell_joint("j", "fixed", "a", "b") + cell_joint("k", "fixed", "b", "a")),
      "cycle");
  EXPECT_REFUSED(cell_of(two + cell_link("a") + cell_joint("j", "fixed", "a", "b")), "the name a");
  EXPECT_REFUSED(cell_of(two + cell_joint("j", "hinged", "a", "b")), "hinged");
  EXPECT_REFUSED(cell_of(cell_link("world"), {.srdf = "a.srdf"}), "not of a scene");
  EXPECT_REFUSED(scene_from_urdf("{}", "cell.urdf"), "cell.urdf");
}

TEST(UrdfScene, LinksThatAreOnlyVisibleAreReported) {
  const std::string visual = "<visual><geometry><box size=\"2 2 2\"/></geometry></visual>";
  const std::string links =
      cell_link("world", "") + cell_link("table", visual) + cell_link("lamp", visual + ball) +
      cell_joint("a", "fixed", "world", "table") + cell_joint("b", "fixed", "world", "lamp");
  const Scene scene = cell_of(links);
  EXPECT_EQ(scene.obstacles.size(), 1u);
  EXPECT_EQ(scene.links_without_shapes, std::vector<std::string>{"table"});
  const ArmShapes arm =
      arm_shapes_from_text("<robot name=\"r\">" + cell_link("a", visual) + cell_link("b") +
                               cell_joint("j", "continuous", "a", "b") + "</robot>",
                           "r.urdf");
  EXPECT_EQ(arm.links_without_shapes, std::vector<std::string>{"a"});
}

TEST(UrdfScene, ACollisionHasOneBody) {
  const auto read = [](const std::string& inside) {
    return cell_of(cell_link("world", "<collision>\n" + inside + "</collision>"));
  };
  const std::string ball_body = "<sphere radius=\"0.1\"/>", box = "<box size=\"1 1 1\"/>";
  const std::string geometry = "<geometry>" + ball_body + "</geometry>\n";
  EXPECT_EQ(read(geometry).obstacles.size(), 1u);
  EXPECT_REFUSED(read("<geometry>" + ball_body + "\n" + box + "</geometry>"),
                 "cell.urdf:4: link world has <box>, a second body in a <geometry>");
  EXPECT_REFUSED(read(geometry + "<geometry>" + box + "</geometry>"),
                 "cell.urdf:4: link world has <geometry>, a second element of this name");
  EXPECT_REFUSED(read("<origin xyz=\"1 0 0\"/>" + geometry + "<origin xyz=\"2 0 0\"/>"),
                 "cell.urdf:4: link world has <origin>, a second element of this name");
}

TEST(UrdfScene, AFileOfOneIsAScene) {
  const testing::TemporaryFolder folder;
  const std::string path =
      folder.write("cell.urdf", "<robot name=\"cell\">" + cell_link("table") + "</robot>");
  EXPECT_EQ(read_scene(path).obstacles.at(0).name, "table");
  const std::string json = folder.write("cell.json", scene_to_json(read_scene(path)));
  EXPECT_EQ(read_scene(json).obstacles.at(0).name, "table");
  EXPECT_REFUSED(read_scene(json, {.hold = {{"door", 1}}}), "only a URDF file");
}

}  // namespace
}  // namespace beeline
