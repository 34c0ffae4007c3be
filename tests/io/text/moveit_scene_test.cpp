#include <gtest/gtest.h>

#include <beeline/io/text/scene.h>

#include <tests/io/text/mesh_samples.h>
#include <tests/refusal.h>

namespace beeline {
namespace {

using testing::Random;
using testing::refusal;

Scene exported(const std::string& text) { return scene_from_text(text, "cell.scene"); }

/// Two objects in MoveIt's first format: shapes are posed in the planning frame.
const std::string first_version = R"((noname)+
* the table
2
box
1 2 0.05
0.5 0 -0.025
0 0 0 1
0 0 0 0
cylinder
0.03 0.4
0.1 0.2 0.3
0.70710678118654757 0 0 0.70710678118654757
0.9 0.9 0.9 1
* ball
1
sphere
0.1
1 2 3
0 0 0 0
0 0 0 0
.
)";

TEST(MoveitScene, TheFirstVersionHasShapesInThePlanningFrame) {
  const Scene scene = exported(first_version);
  ASSERT_EQ(scene.obstacles.size(), 2U);
  EXPECT_EQ(scene.obstacles[0].name, "the table");
  ASSERT_EQ(scene.obstacles[0].shapes.size(), 2U);
  EXPECT_EQ(std::get<Box>(scene.obstacles[0].shapes[0].body).size, Vector3(1, 2, 0.05));
  EXPECT_EQ(scene.obstacles[0].shapes[0].pose.translation(), Vector3(0.5, 0, -0.025));
  const auto& leg = std::get<Cylinder>(scene.obstacles[0].shapes[1].body);
  EXPECT_EQ(leg.radius, 0.03);
  EXPECT_EQ(leg.length, 0.4);
  const Vector3 along = scene.obstacles[0].shapes[1].pose.linear().col(2);
  EXPECT_NEAR((along - Vector3(0, -1, 0)).norm(), 0, 1e-15);
  // A quaternion of zeros is the identity.
  EXPECT_TRUE(scene.obstacles[1].shapes[0].pose.linear().isIdentity());
}

/// Objects with random poses in the second format, whose products are computed here.
TEST(MoveitScene, TheSecondVersionPosesObjectsAndTheirShapes) {
  Random random;
  for (int i = 0; i < testing::cases(50); ++i) {
    std::string text = "scene\n";
    std::vector<Pose> poses;
    const auto written = [&](const Pose& pose) {
      const Eigen::Quaterniond q(pose.linear());
      return testing::coordinates(pose.translation()) + "\n" + testing::coordinates(q.vec()) + " " +
             exact(q.w()) + "\n";
    };
    const int objects = random.integer(1, 4);
    for (int k = 0; k < objects; ++k) {
      const Pose object = random.pose(), shape = random.pose();
      poses.push_back(object * shape);
      text += "* object " + std::to_string(k) + "\n" + written(object) + "1\nbox\n1 2 3\n" +
              written(shape) + "0.5 0.5 0.5 1\n";
      const int subframes = random.integer(0, 2);
      text += std::to_string(subframes) + "\n";
      for (int j = 0; j < subframes; ++j) text += "frame\n" + written(random.pose());
    }
    const Scene scene = exported(text + ".\n");
    ASSERT_EQ(scene.obstacles.size(), poses.size());
    for (std::size_t k = 0; k < poses.size(); ++k) {
      EXPECT_TRUE(scene.obstacles[k].shapes[0].pose.isApprox(poses[k], 1e-14));
    }
  }
}

TEST(MoveitScene, ConesPlanesAndMeshesAreContained) {
  const std::string end = "\n0 0 0\n0 0 0 1\n0 0 0 0\n.\n";
  const Scene cones = exported("s\n* a\n1\ncone\n0.3 0.8" + end);
  const auto& pyramid = std::get<ConvexHull>(cones.obstacles[0].shapes[0].body).vertices;
  for (int k = 0; k < 1000; ++k) {  // in no direction does the cone's base stand out
    const double angle = 0.006283185307179586 * k;
    const Vector3 n(std::cos(angle), std::sin(angle), 0);
    double support = 0;
    for (const Vector3& vertex : pyramid) support = std::max(support, n.dot(vertex));
    EXPECT_GE(support, 0.3);
    EXPECT_LE(support, 0.3 * 1.0013);
  }
  EXPECT_EQ(pyramid.front(), Vector3(0, 0, 0.4));
  EXPECT_EQ(pyramid.back().z(), -0.4);

  const Scene planes = exported("s\n* a\n1\nplane\n0 3 4 -10" + end);
  const Shape& plane = planes.obstacles[0].shapes[0];
  EXPECT_EQ(std::get<Box>(plane.body).size.z(), 0);
  EXPECT_NEAR((plane.pose.translation() - Vector3(0, 1.2, 1.6)).norm(), 0, 1e-15);
  EXPECT_NEAR((plane.pose.linear().col(2) - Vector3(0, 0.6, 0.8)).norm(), 0, 1e-15);

  const Scene meshes = exported("s\n* a\n1\nmesh\n4 1\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n0 1 2" + end);
  EXPECT_EQ(std::get<ConvexHull>(meshes.obstacles[0].shapes[0].body).vertices.size(), 4U);
  EXPECT_EQ(meshes.obstacles[0].shapes[0].hull_of, "cell.scene");
}

TEST(MoveitScene, RefusalsNameTheLine) {
  const auto of = [](const std::string& text) { return refusal([&] { exported(text); }); };
  const std::string ball = "* a\n1\nsphere\n1\n0 0 0\n0 0 0 1\n0 0 0 0\n";
  EXPECT_EQ(of(""), "cell.scene:1: ends before the line \".\" or an object");
  EXPECT_EQ(of("s\nbox\n"), "cell.scene:2: an object begins with *, not with \"box\"");
  EXPECT_EQ(
      of("s\n* a\n1\ntorus\n"),
      "cell.scene:4: unknown shape \"torus\" (known: box, sphere, cylinder, cone, plane, mesh)");
  EXPECT_EQ(of("s\n* a\n1\nsphere\n-1\n0 0 0\n0 0 0 1\n0 0 0 0\n.\n").substr(0, 13),
            "cell.scene:7:");
  EXPECT_EQ(of("s\n* a\n1\nsphere\nnan\n").substr(0, 13), "cell.scene:5:");
  EXPECT_EQ(of("s\n* a\n1\nsphere\n1\n0 0 0\n0 0 0 2\n").substr(0, 36),
            "cell.scene:7: the orientation of a s");
  EXPECT_EQ(of("s\n* a\n1000000000\n").substr(0, 47),
            "cell.scene:3: the number of shapes of \"a\" is 1e");
  EXPECT_EQ(of("s\n" + ball + ball + ".\n"), "cell.scene:9: has two objects \"a\"");
  EXPECT_EQ(of("s\n* \n0\n.\n").substr(0, 13), "cell.scene:2:");
  EXPECT_EQ(of("s\n* a\n0\n.\n"), "cell.scene:3: object \"a\" has no shapes");
  EXPECT_EQ(of("* a\n1\n.\n").substr(0, 35), "cell.scene:1: begins with an object");
  EXPECT_EQ(of("s\n" + ball + ".\n"), "accepted");
  EXPECT_EQ(of("s\n" + ball + ".\ns\n").substr(0, 28), "cell.scene:10: has text afte");
  EXPECT_EQ(of("s\n* a\n1e7 0 0\n0 0 0 1\n1\nsphere\n1\n0 0 0\n0 0 0 1\n").substr(0, 13),
            "cell.scene:9:");
  EXPECT_EQ(of("s\n* a\n1\nmesh\n3 1\n0 0 0\n1 0 0\n0 1 0\n0 1 3\n").substr(0, 13),
            "cell.scene:9:");
}

}  // namespace
}  // namespace beeline
