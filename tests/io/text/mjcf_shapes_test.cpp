#include <gtest/gtest.h>
#include <numbers>

#include <beeline/collision/collision_model.h>
#include <beeline/io/text/scene.h>
#include <beeline/kinematics/forward.h>

#include <tests/io/text/mesh_samples.h>
#include <tests/io/text/mjcf_samples.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

// Geoms of MJCF files as shapes of links and as obstacles.

namespace beeline {
namespace {

using testing::mujoco;

Shape shape_of_geom(const std::string& geom, const std::string& sections = "") {
  const std::string text = mujoco("<body name=\"a\"><joint/>" + geom + "</body>\n", sections);
  return arm_shapes_from_text(text, "a.xml").links.at(0).shapes.at(0);
}

TEST(MjcfShapes, SizesAreHalvesOfLengths) {
  EXPECT_EQ(std::get<Sphere>(shape_of_geom("<geom size=\"0.1 7 8\"/>").body).radius, 0.1);
  const auto capsule =
      std::get<Capsule>(shape_of_geom("<geom type=\"capsule\" size=\"0.1 0.2\"/>").body);
  EXPECT_EQ(capsule.radius, 0.1);
  EXPECT_EQ(capsule.length, 0.4);
  const auto cylinder =
      std::get<Cylinder>(shape_of_geom("<geom type=\"cylinder\" size=\"0.1 0.2\"/>").body);
  EXPECT_EQ(cylinder.radius, 0.1);
  EXPECT_EQ(cylinder.length, 0.4);
  const auto box = std::get<Box>(shape_of_geom("<geom type=\"box\" size=\"0.1 0.2 0.3\"/>").body);
  EXPECT_EQ(box.size, Vector3(0.2, 0.4, 0.6));
}

TEST(MjcfShapes, EndsGiveTheLengthAndThePose) {
  const Shape capsule =
      shape_of_geom("<geom type=\"capsule\" fromto=\"1 0 0 1 3 4\" size=\"0.1\" pos=\"9 9 9\"/>");
  EXPECT_DOUBLE_EQ(std::get<Capsule>(capsule.body).length, 5);
  EXPECT_LT((capsule.pose.translation() - Vector3(1, 1.5, 2)).norm(), 1e-15);
  EXPECT_LT((capsule.pose.linear().col(2) - Vector3(0, -0.6, -0.8)).norm(), 1e-15);
  const Shape box = shape_of_geom("<geom type=\"box\" fromto=\"0 0 0 0 0 2\" size=\"0.1\"/>");
  EXPECT_EQ(std::get<Box>(box.body).size, Vector3(0.2, 0.2, 2));
}

TEST(MjcfShapes, DefaultsFillTheSizesThatAreNotGiven) {
  const std::string defaults =
      "<default><geom type=\"box\" size=\"1 2 3\" euler=\"0 0 90\"/><default class=\"c\"><geom "
      "size=\"4\"/></default></default>";
  const Shape shape = shape_of_geom("<geom class=\"c\" pos=\"1 0 0\"/>", defaults);
  EXPECT_EQ(std::get<Box>(shape.body).size, Vector3(8, 4, 6));
  EXPECT_LT((shape.pose * Vector3(1, 0, 0) - Vector3(1, 1, 0)).norm(), 1e-15);
}

TEST(MjcfShapes, GeomsWithoutContactAreVisibleOnly) {
  const std::string visual = "<geom size=\"1\" contype=\"0\" conaffinity=\"0\"/>";
  const std::string text = mujoco("<body name=\"a\"><joint/>" + visual + "<body name=\"b\">" +
                                  visual + "<geom size=\"0.5\" contype=\"0\"/></body></body>\n");
  const ArmShapes shapes = arm_shapes_from_text(text, "a.xml");
  ASSERT_EQ(shapes.links.size(), 1u);
  EXPECT_EQ(shapes.links[0].name, "b");
  EXPECT_EQ(shapes.links[0].shapes.size(), 1u);
  EXPECT_EQ(shapes.links_without_shapes, std::vector<std::string>{"a"});
}

TEST(MjcfShapes, MeshesAreHullsInTheFrameOfTheGeom) {
  const testing::TemporaryFolder folder;
  std::filesystem::create_directory(folder.file("meshes"));
  folder.write("meshes/m.stl", testing::binary_stl({{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}},
                                                    {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}}}));
  const auto farthest = [&](const std::string& mesh, const Vector3& direction) {
    const std::string path = folder.write(
        "a.xml", mujoco("<body name=\"a\"><joint/><geom type=\"mesh\" mesh=\"m\" pos=\"0 0 5\"/>"
                        "</body>\n",
                        "<compiler meshdir=\"meshes\" strippath=\"true\"/><asset><mesh "
                        "file=\"elsewhere/m.stl\" " +
                            mesh + "/></asset>"));
    const Shape shape = read_arm_shapes(path).links.at(0).shapes.at(0);
    double most = -1e9;
    for (const Vector3& vertex : std::get<ConvexHull>(shape.body).vertices) {
      most = std::max(most, direction.dot(shape.pose * vertex));
    }
    return most;
  };
  EXPECT_DOUBLE_EQ(farthest("", Vector3::UnitZ()), 6);
  EXPECT_DOUBLE_EQ(farthest("scale=\"2 1 3\"", Vector3::UnitZ()), 8);
  // MuJoCo moves by -refpos, rotates by the inverse of refquat, then scales.
  EXPECT_DOUBLE_EQ(farthest("scale=\"2 1 3\" refpos=\"0 0 0.5\"", Vector3::UnitZ()), 6.5);
  EXPECT_NEAR(farthest("refquat=\"1 1 0 0\" refpos=\"0 0 0.5\"", Vector3::UnitY()), 0.5, 1e-15);
  EXPECT_REFUSED(farthest("refquat=\"1 1 0 0\" scale=\"1 2 1\"", Vector3::UnitY()),
                 "refquat is given beside a scale that differs by axis");
}

TEST(MjcfShapes, ExcludedPairsMayTouch) {
  const ArmShapes shapes = arm_shapes_from_text(testing::whole_mjcf, "a.xml", {.tip = "hand"}, {});
  ASSERT_EQ(shapes.allowed_pairs.size(), 1u);
  EXPECT_EQ(shapes.allowed_pairs[0], (NamedPair{"base", "upper"}));
  EXPECT_EQ(shapes.links.size(), 6u);
  EXPECT_EQ(shapes.held.at("left_finger"), 0);
  const Arm arm = arm_from_text(testing::whole_mjcf, "a.xml", {.tip = "hand"});
  EXPECT_NO_THROW(CollisionModel(arm, shapes.links, {}, {}));
}

TEST(MjcfShapes, OfAJointWithACurvedCouplingIsRefused) {
  const std::string text = mujoco(
      "<body name=\"a\"><joint name=\"j\"/><body name=\"b\"><joint name=\"k\"/><geom "
      "size=\"1\"/></body></body>\n",
      "\n<equality><joint joint1=\"k\" joint2=\"j\" polycoef=\"0 1 2\"/></equality>");
  EXPECT_REFUSED(arm_shapes_from_text(text, "a.xml", {.tip = "a"}),
                 "a.xml:2: joint k follows joint j by a polycoef that is not linear");
}

TEST(MjcfShapes, BodiesThatSeveralJointsConnectMayTouch) {
  const ArmShapes shapes = arm_shapes_from_text(
      mujoco("<body name=\"a\"><joint/><geom size=\"1\"/><body name=\"b\"><joint/><joint "
             "axis=\"1 0 0\"/><geom size=\"1\"/></body></body>\n"),
      "a.xml");
  ASSERT_EQ(shapes.links.size(), 2u);
  EXPECT_EQ(shapes.links[1].link, 3u);
  ASSERT_EQ(shapes.allowed_pairs.size(), 1u);
  EXPECT_EQ(shapes.allowed_pairs[0], (NamedPair{"a", "b"}));
}

TEST(MjcfShapes, PlanesThatDoNotMoveAreNoShapesOfTheArm) {
  const std::string plane = "<geom type=\"plane\" size=\"1 1 1\"/>";
  const ArmShapes shapes = arm_shapes_from_text(
      mujoco(plane + "<body name=\"table\">" + plane +
             "<geom size=\"1\"/></body><body name=\"a\"><joint/><geom size=\"1\"/></body>\n"),
      "a.xml", {.tip = "a"});
  EXPECT_EQ(shapes.links_with_planes, (std::vector<std::string>{"world", "table"}));
  ASSERT_EQ(shapes.links.size(), 2u);
  EXPECT_EQ(shapes.links[0].shapes.size(), 1u);
  const std::string drawn = "<geom type=\"plane\" size=\"1 1 1\" contype=\"0\" conaffinity=\"0\"/>";
  const std::string arm = "<body name=\"a\"><joint/><geom size=\"1\"/></body>\n";
  EXPECT_TRUE(arm_shapes_from_text(mujoco(drawn + arm), "a.xml").links_with_planes.empty());
  EXPECT_EQ(arm_shapes_from_text(mujoco(plane + plane + arm), "a.xml").links_with_planes.size(),
            1u);
  EXPECT_REFUSED(arm_shapes_from_text(mujoco("<body name=\"a\"><joint/><body name=\"b\">" + plane +
                                             "</body></body>\n"),
                                      "a.xml"),
                 "type is plane, in body b, which is not supported for collisions; as in MuJoCo");
}

TEST(MjcfShapes, CellsAreScenesWithPlanes) {
  const Scene scene = scene_from_text(
      mujoco("<geom type=\"plane\" size=\"1 1 1\" pos=\"0 0 0.1\"/><body name=\"box\" pos=\"1 0 "
             "0\"><joint name=\"door\" type=\"slide\" range=\"0.2 1\"/><geom type=\"box\" size=\"1 "
             "1 1\"/></body>\n"),
      "cell.xml");
  ASSERT_EQ(scene.obstacles.size(), 2u);
  EXPECT_EQ(scene.obstacles[0].name, "world");
  EXPECT_TRUE(std::holds_alternative<HalfSpace>(scene.obstacles[0].shapes[0].body));
  EXPECT_EQ(scene.obstacles[0].shapes[0].pose.translation().z(), 0.1);
  EXPECT_LT((scene.obstacles[1].shapes[0].pose.translation() - Vector3(1, 0, 0.2)).norm(), 1e-15);
  EXPECT_EQ(scene.held.at("door"), 0.2);
  EXPECT_REFUSED(scene_from_text(mujoco(""), "cell.xml"), "has no geoms that collide");
}

}  // namespace
}  // namespace beeline
