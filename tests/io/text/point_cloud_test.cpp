#include <bit>
#include <cstring>
#include <gtest/gtest.h>

#include <beeline/collision/collision_model.h>
#include <beeline/io/text/internal/npy.h>
#include <beeline/io/text/scene.h>

#include <tests/io/text/mesh_samples.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline {
namespace {

using testing::Random;

std::string bytes_of(auto value, bool reversed) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return reversed ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

/// Writes points among other properties, behind another element.
std::string ply(const std::vector<Vector3>& points, const std::string& format, bool is_double) {
  const std::string type = is_double ? "double" : "float";
  std::string text = "ply\nformat " + format +
                     " 1.0\ncomment x\nelement camera 2\nproperty list uchar short s\nproperty "
                     "uint8 b\nelement vertex " +
                     std::to_string(points.size()) + "\nproperty uchar red\nproperty " + type +
                     " z\nproperty " + type + " x\nproperty list uint8 int32 l\nproperty " + type +
                     " y\nelement face 1\nproperty list uchar int i\nend_header\n";
  const bool big = format == "binary_big_endian";
  if (format == "ascii") {
    text += "2 -5 6 7\n0 1\n";
    for (const Vector3& p : points) {
      text += "255 " + exact(p.z()) + " " + exact(p.x()) + " 1 7 " + exact(p.y()) + "\n";
    }
    return text + "3 0 0 0\n";
  }
  text += std::string("\2\1\2\3\4\5", 6) + std::string("\0\1", 2);
  const auto add = [&](double v) {
    text += is_double ? bytes_of(v, big) : bytes_of(static_cast<float>(v), big);
  };
  for (const Vector3& p : points) {
    text += '\n';
    add(p.z());
    add(p.x());
    text += '\1' + bytes_of(std::int32_t{7}, big);
    add(p.y());
  }
  return text + "faces";
}

std::vector<Vector3> random_points(Random& random, int count) {
  std::vector<Vector3> points;
  for (int i = 0; i < count; ++i) {
    points.push_back((1000 * random.vector(2)).array().round() / 1024);
  }
  return points;
}

const std::string ply_front = "ply\nformat ";

Scene read_ply(const std::string& text) { return scene_from_text(text, "a.ply", {.radius = 0.1}); }

const PointCloud& cloud_of(const Scene& scene) { return scene.obstacles.at(0).cloud.value(); }

TEST(PointCloudFile, EveryFormatHasTheSamePoints) {
  Random random;
  const testing::TemporaryFolder folder;
  const ShapeOptions options{.radius = 0.25};
  for (int i = 0; i < testing::cases(30); ++i) {
    const std::vector<Vector3> points = random_points(random, random.integer(1, 5000));
    for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
      for (const bool is_double : {true, false}) {
        const std::string text = ply(points, format, is_double);
        const Scene scene = read_scene(folder.write("a scan.b.ply", text), options);
        EXPECT_EQ(cloud_of(scene).points, points) << format;
        EXPECT_EQ(cloud_of(scene).radius, 0.25);
        EXPECT_EQ(scene.obstacles.at(0).name, "a scan.b");
        EXPECT_EQ(cloud_of(scene_from_text(text, "c.PLY", options)).points, points);
      }
    }
    for (const bool single : {true, false}) {
      internal::NpyWriter writer(folder.file("scan.npy"), 3, single);
      Eigen::MatrixXd block(3, points.size());
      for (std::size_t k = 0; k < points.size(); ++k) {
        block.col(static_cast<Eigen::Index>(k)) = points[k];
      }
      writer.write(block);
      writer.commit();
      EXPECT_EQ(cloud_of(read_scene(folder.file("scan.npy"), options)).points, points);
    }
  }
}

TEST(PointCloudFile, ScenesHaveClouds) {
  const testing::TemporaryFolder folder;
  folder.write("scan.ply", ply({{1, 2, 3}, {0, 0, 1}}, "ascii", true));
  const std::string path = folder.write(
      "scene.json",
      R"({"obstacles": [{"name": "a", "point_cloud": {"radius": 0.5, "file": "scan.ply",
          "pose": {"xyz": [0, 0, 1]}}}, {"name": "b", "clearance": 0.1, "shapes": [],
          "point_cloud": {"radius": 0, "points": [[1, 0, 0]]}}]})");
  const Scene scene = read_scene(path);
  EXPECT_EQ(cloud_of(scene).points, (std::vector<Vector3>{{1, 2, 4}, {0, 0, 2}}));
  ASSERT_EQ(scene.obstacles.size(), 2u);
  const Scene again = scene_from_json(scene_to_json(scene), "again.json");
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again.obstacles[i].cloud->points, scene.obstacles[i].cloud->points);
    EXPECT_EQ(again.obstacles[i].cloud->radius, scene.obstacles[i].cloud->radius);
    EXPECT_EQ(again.obstacles[i].clearance, scene.obstacles[i].clearance);
  }
  const auto with = [](const std::string& cloud) {
    return scene_from_json(R"({"obstacles": [{"name": "a", "point_cloud": )" + cloud + "}]}",
                           "s.json");
  };
  EXPECT_REFUSED(with(R"({"points": [[1, 0, 0]]})"), "radius");
  EXPECT_REFUSED(with(R"({"radius": 1})"), "needs either \"file\" or \"points\"");
  EXPECT_REFUSED(with(R"({"radius": 1, "points": []})"), "has no points");
  EXPECT_REFUSED(with(R"({"radius": 1, "points": [[1, 0]]})"), "points[0]");
  EXPECT_REFUSED(with(R"({"radius": -1, "points": [[1, 0, 0]]})"), "radius of -1 m");
  EXPECT_REFUSED(with(R"({"radius": 1, "file": "missing.ply"})"), "missing.ply");
  EXPECT_REFUSED(with(R"({"radius": 1, "file": "scan.stl"})"), "known endings: ply, npy");
  EXPECT_REFUSED(scene_from_json(R"({"obstacles": [{"name": "a"}]})", "s.json"), "shapes");
}

TEST(PointCloudFile, RadiusAndCloudBelongTogether) {
  const std::string text = ply({{1, 2, 3}}, "ascii", true);
  EXPECT_REFUSED(scene_from_text(text, "a.ply"), "a.ply is a point cloud, which needs a radius");
  EXPECT_REFUSED(scene_from_text(R"({"obstacles": []})", "a.json", {.radius = 1}), "a.json");
  EXPECT_REFUSED(scene_from_text(text, "a.ply", {.radius = -1}), "radius of -1 m");
}

TEST(PointCloudFile, DamagedFilesAreRefused) {
  Random random;
  const std::vector<Vector3> points = random_points(random, 20);
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const std::string text = ply(points, format, false);
    const std::size_t end = text.size() - (format[0] == 'a' ? 30 : 5);
    for (std::size_t size = 0; size < end; size += 7) {
      EXPECT_REFUSED(read_ply(text.substr(0, size)), "a.ply");
    }
    for (int i = 0; i < testing::cases(1000); ++i) {
      std::string damaged = text;
      for (int k = random.integer(1, 4); k > 0; --k) {
        const auto at = random.integer(0, static_cast<int>(text.size()) - 1);
        damaged[static_cast<std::size_t>(at)] = static_cast<char>(random.integer(0, 255));
      }
      try {
        check_cloud(cloud_of(read_ply(damaged)));
      } catch (const FileError& error) {
        EXPECT_EQ(error.path(), "a.ply");
      }
    }
  }
  const std::string front = "ply\nformat ascii 1.0\nelement vertex ";
  const std::string xyz = "property float x\nproperty float y\nproperty float z\nend_header\n";
  EXPECT_REFUSED(read_ply(""), "does not begin with \"ply\"");
  EXPECT_REFUSED(read_ply("solid a"), "does not begin with \"ply\"");
  EXPECT_REFUSED(read_ply(front + "0\n" + xyz), "has no points");
  EXPECT_REFUSED(read_ply(front + "99999999\n" + xyz), "has 99999999 points; at most 1000000");
  EXPECT_REFUSED(read_ply(front + "-1\n" + xyz), "\"-1\"");
  EXPECT_REFUSED(read_ply(front + "2\n" + xyz + "1 2 3\n1 2\n"), "a.ply:9: vertex 1: a number");
  EXPECT_REFUSED(read_ply(front + "2\n" + xyz + "1 2 3\nnan 2 3\n"), "vertex 1: \"nan\"");
  EXPECT_REFUSED(read_ply(front + "2\n" + xyz + "1 2 3\n"), "is cut off at vertex 1 of 2");
  EXPECT_REFUSED(read_ply(front + "1\nproperty float x\nproperty float y\nend_header\n1 2\n"),
                 "lacks a property z");
  EXPECT_REFUSED(read_ply(front + "1\nproperty int x\n" + xyz + "1 1 2 3\n"),
                 "must have one property x, float or double");
  EXPECT_REFUSED(read_ply("ply\nelement vertex 1\n" + xyz + "1 2 3\n"), "has no format");
  EXPECT_REFUSED(read_ply("ply\nformat ascii 2.0\n"), "\"2.0\"");
  EXPECT_REFUSED(read_ply("ply\nformat ascii 1.0\nelement face 99999999999\nend_header\n"),
                 "no element vertex");
  std::string nan = ply(points, "binary_little_endian", false);
  nan.replace(nan.find("end_header\n") + 11 + 8 + 1, 4, "\xff\xff\xff\xff");
  EXPECT_REFUSED(read_ply(nan), "point 0 of a point cloud");
}

TEST(PointCloudFile, RowsThatTheHeaderDoesNotDescribeAreRefused) {
  const std::string front = ply_front + "ascii 1.0\nelement vertex ";
  const std::string axes = "property float x\nproperty float y\nproperty float z\n";
  const std::string xyz = axes + "end_header\n";
  const std::string list =
      ply_front + "ascii 1.0\nelement face 1\nproperty list int double v\nelement vertex 1\n";
  EXPECT_REFUSED(read_ply(list + xyz + "2.5 1 1 1\n2 2 2\n"), "a.ply:10: has a list of 2.5 items");
  EXPECT_REFUSED(read_ply(list + xyz + "-1\n2 2 2\n"), "has a list of -1 items");
  EXPECT_REFUSED(read_ply(list + xyz + "2 1 1 1\n2 2 2\n"), "face 0 has \"1\" behind");
  EXPECT_REFUSED(read_ply(front + "1\n" + xyz + "2 2 2 -0.3 0 0.4\n"),
                 "a.ply:8: vertex 0 has \"-0.3\" behind its properties");
  EXPECT_REFUSED(read_ply(front + "1\n" + axes + "element vertex 1\n" + xyz + "2 2 2\n1 1 1\n"),
                 "a.ply:7: has the element \"vertex\" twice");
  const std::string no_faces = axes + "element face 0\nproperty list uchar int i\nend_header\n";
  for (const std::string& rest : {xyz, no_faces}) {
    EXPECT_REFUSED(read_ply(front + "1\n" + rest + "2 2 2\n\n-0.3 0 0.4\n"),
                   "continues after its 1 rows of vertex");
    EXPECT_EQ(cloud_of(read_ply(front + "1\n" + rest + "2 2 2 \n\n  \n")).points.size(), 1u);
    const std::string binary =
        ply_front + "binary_little_endian 1.0\nelement vertex 1\n" + rest + std::string(12, '\0');
    EXPECT_EQ(cloud_of(read_ply(binary)).points.size(), 1u);
    EXPECT_REFUSED(read_ply(binary + '\0'), "a.ply: continues after its 1 rows of vertex");
  }
}

TEST(PointCloudFile, ArraysOfOtherShapesAreRefused) {
  const testing::TemporaryFolder folder;
  const std::string path = folder.file("a.npy");
  internal::NpyWriter writer(path, 4, false);
  writer.write(Eigen::MatrixXd::Zero(4, 2));
  writer.commit();
  EXPECT_REFUSED(read_scene(path, {.radius = 1}), "rows of 4 numbers; points are rows of three");
  EXPECT_REFUSED(read_scene(path, {.radius = 1}), "write array[:, :3]");
  const auto refusal_of_shape = [&](const std::string& shape, std::size_t count) {
    std::string front = internal::npy_front({false, 1, 1});
    const std::size_t at = front.find("(1, 1)");
    front = front.substr(0, at) + shape + ", }";
    front.resize(127, ' ');
    return testing::refusal([&] {
      read_scene(folder.write("s.npy", front + "\n" + std::string(8 * count, '\0')), {.radius = 1});
    });
  };
  const std::string image = refusal_of_shape("(2, 4, 3)", 24);
  EXPECT_NE(image.find("rows of 12 numbers; points are rows of three: write array.reshape(-1, 3)"),
            std::string::npos)
      << image;
  for (const std::string& narrow : {refusal_of_shape("(6, 2)", 12), refusal_of_shape("(3,)", 3),
                                    refusal_of_shape("(3, 2, 2)", 12)}) {
    EXPECT_TRUE(narrow.ends_with("points are rows of three")) << narrow;
  }
  EXPECT_REFUSED(read_scene(folder.write("b.npy", "x"), {.radius = 1}), "is not an .npy file");
  EXPECT_REFUSED(
      read_scene(folder.write("c.npy", internal::npy_front({false, 2'000'000, 3})), {.radius = 1}),
      "c.npy: declares 2000000 rows");
}

}  // namespace
}  // namespace beeline
