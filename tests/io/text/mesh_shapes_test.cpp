#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>

#include <beeline/io/text/scene.h>

#include <tests/io/text/mesh_samples.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline {
namespace {

using testing::Random;
using testing::TemporaryFolder;
using testing::Triangle;

/// An arm with this mesh on its base.
std::string mesh_arm(const std::string& attributes) {
  return "<robot name=\"r\"><link name=\"a\"><collision><origin xyz=\"0 0 2\"/><geometry>\n<mesh " +
         attributes +
         "/></geometry></collision></link>\n<link name=\"b\"/><joint name=\"j\" "
         "type=\"continuous\"><parent link=\"a\"/><child link=\"b\"/></joint></robot>";
}

Shape mesh_of(const std::string& urdf, const std::string& attributes,
              const ShapeOptions& options = {}) {
  return arm_shapes_from_text(mesh_arm(attributes), urdf, {}, options).links.at(0).shapes.at(0);
}

const std::vector<Vector3>& vertices_of(const Shape& shape) {
  return std::get<ConvexHull>(shape.body).vertices;
}

/// The maximum of direction . x over a shape in its frame.
double reach(const Shape& shape, const Vector3& direction) {
  double most = -INFINITY;
  for (const Vector3& vertex : vertices_of(shape)) most = std::max(most, direction.dot(vertex));
  return most + shape.padding * direction.norm();
}

const std::vector<Triangle> tetrahedron{{{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}},
                                        {{{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}},
                                        {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}};

/// Sets a variable of the environment, and resets it at the end.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    ::setenv(name, value.c_str(), 1);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() { ::unsetenv(name_); }

 private:
  const char* name_;
};

TEST(MeshShapes, AreTheSameHullFromEveryFormat) {
  Random random;
  const TemporaryFolder folder;
  const std::string urdf = folder.file("r.urdf");
  for (int i = 0; i < testing::cases(30); ++i) {
    const auto triangles = testing::random_triangles(random, random.integer(1, 400));
    folder.write("ascii.stl", testing::ascii_stl(triangles));
    folder.write("binary.stl", testing::binary_stl(triangles));
    folder.write("wave.obj", testing::obj(triangles));
    const Shape ascii = mesh_of(urdf, "filename=\"ascii.stl\"");
    for (const char* other : {"filename=\"binary.stl\"", "filename=\"wave.obj\""}) {
      const Shape shape = mesh_of(urdf, other);
      EXPECT_EQ(vertices_of(shape), vertices_of(ascii));
      EXPECT_EQ(shape.padding, ascii.padding);
    }
    EXPECT_EQ(ascii.hull_of, folder.file("ascii.stl"));
    EXPECT_EQ(ascii.pose.translation(), Vector3(0, 0, 2));
    EXPECT_NO_THROW(check_shape(ascii));
    for (const Triangle& triangle : triangles) {
      const Vector3 direction = random.direction();
      for (const Vector3& corner : triangle) {
        EXPECT_LE(direction.dot(corner), reach(ascii, direction) + 1e-14);
      }
    }
  }
}

TEST(MeshShapes, AreScaledAndMirrored) {
  Random random;
  const TemporaryFolder folder;
  const std::string urdf = folder.file("r.urdf");
  for (int i = 0; i < testing::cases(30); ++i) {
    const auto triangles = testing::random_triangles(random, random.integer(1, 60));
    folder.write("a.obj", testing::obj(triangles));
    Vector3 scale = Vector3(1e-3, 2e-3, 5e-3);
    for (double& factor : scale) factor *= random.integer(0, 1) == 0 ? -1 : 1;
    const Shape shape =
        mesh_of(urdf, "filename=\"a.obj\" scale=\"" + testing::coordinates(scale) + "\"");
    for (int k = 0; k < 20; ++k) {
      const Vector3 direction = random.direction();
      double most = -INFINITY;
      for (const Triangle& triangle : triangles) {
        for (const Vector3& corner : triangle) {
          most = std::max(most, direction.dot(corner.cwiseProduct(scale)));
        }
      }
      EXPECT_NEAR(reach(shape, direction), most, 1e-15) << "few corners: all are kept";
    }
  }
  folder.write("a.obj", testing::obj(tetrahedron));
  EXPECT_REFUSED(mesh_of(urdf, "filename=\"a.obj\" scale=\"1 0 1\""), "a scale of 0");
  EXPECT_REFUSED(mesh_of(urdf, "filename=\"a.obj\" scale=\"1\""), "r.urdf:2");
  EXPECT_REFUSED(mesh_of(urdf, "filename=\"a.obj\" scale=\"1 nan 1\""), "r.urdf:2");
  EXPECT_REFUSED(mesh_of(urdf, "filename=\"a.obj\" scale=\"1e9 1 1\""), "a.obj: has a corner");
}

TEST(MeshShapes, AreFoundInPackages) {
  const TemporaryFolder folder;
  namespace fs = std::filesystem;
  const auto put = [&](const std::string& path) {
    fs::create_directories(fs::path(folder.file(path)).parent_path());
    folder.write(path, testing::obj(tetrahedron));
    return folder.file(path);
  };
  const std::string urdf = folder.file("ws/src/arm/urdf/r.urdf");
  fs::create_directories(fs::path(urdf).parent_path());
  const std::string mesh = "filename=\"package://arm/m/a.obj\"";
  const auto found = [&](const ShapeOptions& options = {}) {
    return mesh_of(urdf, mesh, options).hull_of;
  };
  EXPECT_REFUSED(found(), "r.urdf:2: link a: the mesh \"package://arm/m/a.obj\" is not found");
  EXPECT_REFUSED(found(), folder.file("ws/src/arm/m/a.obj"));
  EXPECT_REFUSED(found(), folder.file("ws/arm/m/a.obj"));
  EXPECT_REFUSED(found(), "(--package arm=FOLDER)");
  const std::string above = put("ws/arm/m/a.obj");
  EXPECT_EQ(found(), above) << "in a folder above that contains the package";
  const std::string package = put("ws/src/arm/m/a.obj");
  EXPECT_EQ(found(), package) << "the folder above is the package";
  const std::string ament = put("install/share/arm/m/a.obj");
  const std::string ros = put("ros/arm/m/a.obj");
  {
    const Variable prefix("AMENT_PREFIX_PATH", "/none:" + folder.file("install"));
    EXPECT_EQ(found(), ament);
    const Variable packages("ROS_PACKAGE_PATH", "/none::" + folder.file("ros") + ":/nowhere");
    EXPECT_EQ(found(), ros);
  }
  {
    const Variable packages("ROS_PACKAGE_PATH", folder.file("ros/arm/"));
    EXPECT_EQ(found(), ros) << "a folder that is the package";
  }
  const std::string given = put("elsewhere/m/a.obj");
  EXPECT_EQ(found({.package = {{"arm", folder.file("elsewhere")}}}), given);
  EXPECT_REFUSED(found({.package = {{"arm", "/nowhere"}}}), "looked for at /nowhere/m/a.obj;");
  EXPECT_EQ(mesh_of(urdf, "filename=\"model://arm/m/a.obj\"").hull_of, package);
}

// A repository's folder often has another name than its package.
TEST(MeshShapes, AreFoundInPackagesByPackageXml) {
  const TemporaryFolder folder;
  namespace fs = std::filesystem;
  const auto put = [&](const std::string& path, const std::string& text) {
    fs::create_directories(fs::path(folder.file(path)).parent_path());
    return folder.write(path, text);
  };
  const auto package = [](const std::string& name) {
    return "<?xml version=\"1.0\"?><package format=\"3\"><name>" + name + "</name></package>";
  };
  const std::string urdf = folder.file("src/arm-main/urdf/r.urdf");
  fs::create_directories(fs::path(urdf).parent_path());
  const auto found = [&](const std::string& name) {
    return mesh_of(urdf, "filename=\"package://" + name + "/m/a.obj\"").hull_of;
  };
  const std::string own = put("src/arm-main/m/a.obj", testing::obj(tetrahedron));
  const std::string other = put("src/gripper-2.0/m/a.obj", testing::obj(tetrahedron));
  put("src/gripper-2.0/package.xml", package("gripper"));
  EXPECT_REFUSED(found("arm"), "is not found");
  EXPECT_REFUSED(found("gripper"), "is not found");  // no package.xml above the file
  for (const std::string& broken : {std::string("<package"), package(""), std::string("<name/>"),
                                    package(std::string(70000, 'x'))}) {
    put("src/arm-main/package.xml", broken);
    EXPECT_REFUSED(found("arm"), "is not found");
  }
  put("src/arm-main/package.xml", package("arm"));
  EXPECT_EQ(found("arm"), own);
  EXPECT_EQ(found("gripper"), other);
  EXPECT_REFUSED(found("none"), "is not found");
  const std::string named = put("src/gripper/m/a.obj", testing::obj(tetrahedron));
  EXPECT_EQ(found("gripper"), named) << "the folder of that name first";
}

TEST(MeshShapes, AreFoundByPaths) {
  const TemporaryFolder folder;
  const std::string path = folder.write("a.obj", testing::obj(tetrahedron));
  const std::string urdf = folder.file("r.urdf");
  for (const std::string& name :
       std::vector<std::string>{"a.obj", "./a.obj", path, "file://" + path}) {
    EXPECT_EQ(mesh_of(urdf, "filename=\"" + name + "\"").hull_of, path);
  }
  EXPECT_REFUSED(mesh_of(urdf, "filename=\"b.obj\""), folder.file("b.obj"));
  EXPECT_REFUSED(mesh_of(urdf, "filename=\"http://b.org/a.obj\""), "package://NAME/PATH");
  EXPECT_REFUSED(mesh_of(urdf, "filename=\"package://a.obj\""), "must be package://NAME/PATH");
  EXPECT_REFUSED(mesh_of(urdf, "filename=\"a.wrl\""), "known endings: stl, obj");
  EXPECT_REFUSED(mesh_of(urdf, "filename=\"a.wrl\""), "convex_hull");
  EXPECT_REFUSED(mesh_of(urdf, "filename=\"/dev/zero.stl\""), "is not found");
  EXPECT_REFUSED(mesh_of(urdf, "scale=\"1 1 1\""), "filename");
  folder.write("a.obj", "v 0 0 0\nf 1 2 3\n");
  EXPECT_REFUSED(mesh_of(urdf, "filename=\"a.obj\""), path + ":2: ");
}

TEST(MeshShapes, AreNotOpenedForTheArmAlone) {
  const std::string text = mesh_arm("filename=\"package://none/a.dae\"");
  EXPECT_NO_THROW(arm_from_text(text, "r.urdf"));
}

TEST(MeshShapes, InJsonKeepTheirOrigin) {
  Scene scene;
  Shape hull{.body = ConvexHull{{{0, 0, 0}, {1, 0, 0}}}, .padding = 1e-5, .hull_of = "a \"b\".stl"};
  scene.obstacles.push_back({.name = "a", .shapes = {hull}});
  const Scene read = scene_from_json(scene_to_json(scene), "a.json");
  EXPECT_EQ(read.obstacles.at(0).shapes.at(0).hull_of, hull.hull_of);
  EXPECT_REFUSED(check_shape({.body = Sphere{1}, .hull_of = "a.stl"}), "hull_of");
}

}  // namespace
}  // namespace beeline
