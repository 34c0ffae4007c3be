#include <gtest/gtest.h>

#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/mesh_file.h>
#include <beeline/io/text/internal/mesh_hull.h>
#include <beeline/pose/se3.h>

#include <tests/io/text/scene_mesh_samples.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline::internal {
namespace {

using beeline::testing::Random;
using beeline::testing::TemporaryFolder;
using beeline::testing::Triangle;

bool reads_scene_meshes() { return mesh_endings().size() > 2; }

/// The largest distance of a corner from the one at its place.
double farthest_apart(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  if (a.size() != b.size()) return INFINITY;
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).norm());
  return most;
}

std::vector<Vector3> moved(const std::vector<Triangle>& triangles, const Eigen::Matrix4d& pose) {
  std::vector<Vector3> corners;
  for (const Triangle& triangle : triangles) {
    for (const Vector3& corner : triangle) {
      corners.push_back((pose * corner.homogeneous()).head<3>());
    }
  }
  return corners;
}

/// A rigid motion and a change of size.
Eigen::Matrix4d random_transform(Random& random) {
  Pose pose = Pose::Identity();
  pose.linear() = Eigen::AngleAxisd(random.uniform(-3, 3), random.direction()).matrix();
  pose.translation() = random.direction();
  return pose.matrix() * Eigen::Vector4d(random.uniform(0.5, 2), random.uniform(-2, -0.5),
                                         random.uniform(0.5, 2), 1)
                             .asDiagonal();
}

#define SKIP_WITHOUT_ASSIMP() \
  if (!reads_scene_meshes()) GTEST_SKIP() << "a build without BEELINE_ASSIMP"

TEST(MeshScene, NodesAndUnitsAreApplied) {
  SKIP_WITHOUT_ASSIMP();
  Random random;
  const TemporaryFolder folder;
  for (int i = 0; i < beeline::testing::cases(8); ++i) {
    const auto triangles = beeline::testing::random_triangles(random, random.integer(1, 60));
    const Eigen::Matrix4d outer = random_transform(random), inner = random_transform(random);
    const std::vector<Vector3> expected = moved(triangles, outer * inner);
    std::vector<Vector3> in_millimetres = expected;
    for (Vector3& corner : in_millimetres) corner *= 0.001;
    const std::string buffer = beeline::testing::gltf_buffer(triangles);
    const std::string linked = beeline::testing::gltf(triangles, R"("uri":"a.bin",)", outer, inner);
    const std::string whole = beeline::testing::gltf(triangles, "", outer, inner);
    folder.write("a.bin", buffer);
    constexpr double single = 1e-5;  // of coordinates up to 20
    double rounding = 0;
    for (const char* up : {"Z_UP", "Y_UP", "X_UP"}) {
      const std::string text = beeline::testing::collada(triangles, 0.001, outer, inner, up);
      const std::string path = folder.write("a.dae", text);
      EXPECT_LT(farthest_apart(read_mesh(path, &rounding), in_millimetres), 0.001 * single) << up;
      EXPECT_LE(farthest_apart(read_mesh(path), in_millimetres), rounding) << up;
      EXPECT_LT(rounding, 1e-6);
      EXPECT_EQ(mesh_from_text(text, "elsewhere.dae"), read_mesh(path));
    }
    const std::string path = folder.write("a.gltf", linked);
    EXPECT_LT(farthest_apart(read_mesh(path, &rounding), expected), single);
    EXPECT_LE(farthest_apart(read_mesh(path), expected), rounding);
    EXPECT_LT(farthest_apart(read_mesh(folder.write("a.GLB", beeline::testing::glb(whole, buffer))),
                             expected),
              single);
  }
}

TEST(MeshScene, HullsContainTheMeshDespiteSinglePrecision) {
  SKIP_WITHOUT_ASSIMP();
  const std::vector<Triangle> one{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
  Eigen::Matrix4d far = Eigen::Matrix4d::Identity(), back = far;
  far.topRightCorner<3, 1>() << 1000.123456, 0, 0;
  back.topRightCorner<3, 1>() << -1000, 0, 0;
  const TemporaryFolder folder;
  const std::string buffer = beeline::testing::gltf_buffer(one);
  const std::string path = folder.write(
      "a.glb", beeline::testing::glb(beeline::testing::gltf(one, "", far, back), buffer));
  double rounding = 0;
  const double error = farthest_apart(read_mesh(path, &rounding), moved(one, far * back));
  EXPECT_GT(error, 1e-6);
  EXPECT_LE(error, rounding);
  EXPECT_LT(rounding, 0.02);
  const std::map<std::string, std::string> none;
  MeshHulls hulls(path, none);
  EXPECT_GE(hulls.read("a.glb", {1, -2, 1}).padding, 2 * rounding);
  read_mesh(folder.write("a.stl", beeline::testing::ascii_stl(one)), &rounding);
  EXPECT_EQ(rounding, 0);
}

TEST(MeshScene, BuffersOutsideTheFolderAreNotRead) {
  SKIP_WITHOUT_ASSIMP();
  const std::vector<Triangle> one{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
  const Eigen::Matrix4d none = Eigen::Matrix4d::Identity();
  const TemporaryFolder outside, folder;
  const std::string buffer = outside.write("a.bin", beeline::testing::gltf_buffer(one));
  std::filesystem::create_directory(folder.file("below"));
  const auto with = [&](const std::string& uri) {
    return beeline::testing::gltf(one, "\"uri\":\"" + uri + "\",", none, none);
  };
  std::filesystem::copy_file(buffer, folder.file("below/a.bin"));
  EXPECT_EQ(read_mesh(folder.write("a.gltf", with("below/a.bin"))).size(), 3u);
  std::filesystem::create_symlink(buffer, folder.file("link.bin"));
  std::filesystem::copy_file(buffer, folder.file("a.bin"));
  for (const std::string& uri :
       {buffer, "../" + std::filesystem::path(buffer).parent_path().filename().string() + "/a.bin",
        std::string("link.bin"), std::string("missing.bin"), std::string("/dev/zero")}) {
    EXPECT_REFUSED(read_mesh(folder.write("a.gltf", with(uri))), "a.gltf: ");
  }
  EXPECT_REFUSED(read_mesh(folder.write("below/b.gltf", with("../a.bin"))), "b.gltf: ");
  const std::string fault = "a.gltf: names the file \"" + folder.file("link.bin") +
                            "\", which is not in the folder of the mesh or in one below it";
  const auto message = [&](const std::string& uri) {
    return beeline::testing::refusal([&] { read_mesh(folder.write("a.gltf", with(uri))); });
  };
  EXPECT_TRUE(message("link.bin").ends_with(fault)) << message("link.bin");
  EXPECT_TRUE(message("missing.bin").ends_with("missing.bin\", which is not there"));
  std::filesystem::create_directory(folder.file("share"));
  for (const char* name : {"c.gltf", "a.bin"}) {  // as colcon build --symlink-install does
    std::filesystem::create_symlink("../below/" + std::string(name), folder.file("share/") + name);
  }
  folder.write("below/c.gltf", with("a.bin"));
  EXPECT_EQ(read_mesh(folder.file("share/c.gltf")).size(), 3u);
}

/// The text with one part replaced, which must be there.
std::string with(std::string text, const std::string& part, const std::string& other) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return at == std::string::npos ? text : text.replace(at, part.size(), other);
}

TEST(MeshScene, PositionsThatAssimpMisreadsAreRefused) {
  SKIP_WITHOUT_ASSIMP();
  const std::vector<Triangle> one{{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
  const Eigen::Matrix4d none = Eigen::Matrix4d::Identity();
  const std::string buffer = beeline::testing::gltf_buffer(one);
  const std::string json = beeline::testing::gltf(one, "", none, none);
  const auto read = [&](const std::string& text) {
    return mesh_from_text(beeline::testing::glb(text, buffer), "a.glb");
  };
  const auto with_root = [&](const std::string& member) {
    return read(with(json, R"("scene":0,)", R"("scene":0,)" + member + ","));
  };
  const std::string instances = R"("extensions":{"EXT_mesh_gpu_instancing":{}},)";
  EXPECT_EQ(with_root(R"("extensionsUsed":["KHR_materials_unlit","VENDOR_a"],)"
                      R"("extensionsRequired":["KHR_materials_unlit"])")
                .size(),
            3u);
  EXPECT_REFUSED(with_root(R"("extensionsRequired":["VENDOR_moves_it"])"), "\"VENDOR_moves_it\"");
  for (const char* name :
       {"EXT_mesh_gpu_instancing", "KHR_draco_mesh_compression", "EXT_meshopt_compression"}) {
    EXPECT_REFUSED(with_root(R"("extensionsUsed":[")" + std::string(name) + "\"]"), name);
  }
  EXPECT_REFUSED(read(with(json, R"("mesh":0,)", R"("mesh":0,)" + instances)), "gpu_instancing");
  EXPECT_REFUSED(read(with(json, R"("mesh":0,)", R"("mesh":0,"skin":0,)")), "nodes[1].skin");
  EXPECT_REFUSED(read(with(json, R"("mode":4)", R"("mode":4,"targets":[{"POSITION":0}])")),
                 "primitives[0].targets");
  EXPECT_REFUSED(read(with(json, "5126", "5122")), "accessors[0].componentType");
  EXPECT_REFUSED(read(with(json, R"("type":"VEC3")", R"("type":"VEC3","sparse":{"count":1})")),
                 "accessors[0].sparse");
  EXPECT_REFUSED(read(with(json, R"({"bufferView":0,)", "{")), "bufferView");
  EXPECT_REFUSED(read(with(json, R"("POSITION":0)", R"("POSITION":1)")), "no accessor");
  EXPECT_REFUSED(read(with(json, R"("POSITION":0)", R"("POSITION":0,"POSITION_1":0)")),
                 "POSITION_1");
  EXPECT_REFUSED(mesh_from_text(beeline::testing::glb(json, buffer), "a.gltf"), "a.gltf:1: ");
  EXPECT_REFUSED(mesh_from_text(json, "a.glb"), "does not begin with \"glTF\"");
  const std::string dae = beeline::testing::collada(one, 1, none, none);
  EXPECT_REFUSED(
      mesh_from_text(with(dae, "<instance_geometry url", "<instance_controller url"), "a.dae"),
      "a.dae:1: has an element <instance_controller>");
  EXPECT_REFUSED(
      mesh_from_text(with(dae, "<matrix>", "<skew>0 1 0 0 0 1 1</skew><matrix>"), "a.dae"),
      "<skew>");
}

TEST(MeshScene, CirclesAndDamageAreRefused) {
  SKIP_WITHOUT_ASSIMP();
  Random random;
  const auto triangles = beeline::testing::random_triangles(random, 6);
  const Eigen::Matrix4d none = Eigen::Matrix4d::Identity();
  const std::string dae = beeline::testing::collada(triangles, 1, none, none);
  std::string circle = dae;
  circle.insert(circle.find("<instance_geometry"), "<instance_node url=\"#n\"/>");
  EXPECT_REFUSED(mesh_from_text(circle, "a.dae"), "a.dae: cannot be read");
  std::string no_triangles = dae;
  no_triangles.replace(no_triangles.find("<instance_geometry url=\"#g\"/>"), 29, "");
  EXPECT_REFUSED(mesh_from_text(no_triangles, "a.dae"), "a.dae: has no triangles");
  EXPECT_REFUSED(mesh_from_text("", "a.dae"), "a.dae: ");
  EXPECT_REFUSED(mesh_from_text("PK\3\4", "a.dae"), "a.dae: is a ZIP archive");
  EXPECT_REFUSED(mesh_from_text(beeline::testing::ascii_stl(triangles), "a.dae"), "a.dae: ");
  const std::string whole = beeline::testing::glb(beeline::testing::gltf(triangles, "", none, none),
                                                  beeline::testing::gltf_buffer(triangles));
  for (const auto& [text, path] : {std::pair{dae, "a.dae"}, std::pair{whole, "a.glb"}}) {
    for (int i = 0; i < beeline::testing::cases(60); ++i) {
      std::string damaged = text;
      const int size = static_cast<int>(text.size());
      if (i % 2 == 0) damaged.resize(static_cast<std::size_t>(random.integer(0, size - 1)));
      for (int k = random.integer(0, 4); k > 0 && !damaged.empty(); --k) {
        const auto at = random.integer(0, static_cast<int>(damaged.size()) - 1);
        damaged[static_cast<std::size_t>(at)] = static_cast<char>(random.integer(0, 255));
      }
      try {
        EXPECT_FALSE(mesh_from_text(damaged, path).empty());
      } catch (const FileError& error) {
        EXPECT_EQ(error.path(), path);
        EXPECT_EQ(error.fault().find('\n'), std::string::npos);
      }
    }
  }
}

TEST(MeshScene, ABuildWithoutThemSaysWhatToDo) {
  if (reads_scene_meshes()) GTEST_SKIP() << "a build with BEELINE_ASSIMP";
  for (const char* path : {"a.dae", "a.gltf", "a.GLB"}) {
    EXPECT_REFUSED(mesh_from_text("", path), "known endings: stl, obj; Collada and glTF");
    EXPECT_REFUSED(mesh_from_text("", path), "-DBEELINE_ASSIMP=ON");
  }
}

}  // namespace
}  // namespace beeline::internal
