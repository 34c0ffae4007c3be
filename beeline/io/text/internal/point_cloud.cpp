#include <filesystem>

#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/json_write.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/npy.h>
#include <beeline/io/text/internal/ply.h>
#include <beeline/io/text/internal/point_cloud.h>
#include <beeline/io/text/internal/pose_json.h>
#include <beeline/io/text/internal/text_encoding.h>
#include <beeline/io/text/numbers.h>
#include <beeline/io/text/scene.h>

bool beeline::is_cloud_path(const std::string& path) {
  const std::string ending = extension(path);
  return ending == "ply" || ending == "npy";
}

namespace beeline::internal {
namespace {

constexpr std::uint64_t max_points_size = std::uint64_t{1} << 30;

std::vector<Vector3> checked_ply(ByteBlocks& bytes) {
  refuse_lfs_pointer(bytes.peek(lfs_pointer_size), bytes.path());
  if (bytes.size() > max_points_size) throw FileError(bytes.path(), 0, "is larger than 1 GiB");
  return points_from_ply(bytes);
}

/// How to make rows of three numbers, where it is known.
std::string rows_of_three(const NpyHeader& header) {
  if (header.width > 3 && header.last == 3) return ": write array.reshape(-1, 3)";
  if (header.width > 3 && header.last == header.width) return ": write array[:, :3]";
  return "";
}

std::vector<Vector3> points_from_npy(const std::string& path) {
  NpyReader reader(path);
  const NpyHeader& header = reader.header();
  if (header.width != 3) {
    throw FileError(path, 0,
                    "has rows of " + std::to_string(header.width) +
                        " numbers; points are rows of three" + rows_of_three(header));
  }
  check_point_count(static_cast<std::uint64_t>(header.rows), path);
  std::vector<Vector3> points;
  Eigen::MatrixXd block(3, 4096);
  while (const Eigen::Index count = reader.read(block)) {
    for (Eigen::Index k = 0; k < count; ++k) points.emplace_back(block.col(k));
  }
  return points;
}

double needed_radius(const std::string& path, std::optional<double> radius) {
  if (radius) return *radius;
  throw Error::of("radius", path +
                                " is a point cloud, which needs a radius, m, of the spheres "
                                "around its points, such as half their spacing and the error "
                                "of the sensor");
}

Scene scene_of(std::vector<Vector3> points, const std::string& path, double radius) {
  PointCloud cloud{std::move(points), radius};
  const std::string name = with_escaped_bytes(std::filesystem::path(path).stem().string());
  try {
    check_cloud(cloud);
    check_name(name, "the name of the file, which is the obstacle's,");
  } catch (const Error& error) {
    throw FileError(path, 0, error.what());
  }
  return {.obstacles = {{.name = name, .cloud = std::move(cloud)}}};
}

}  // namespace

void check_point_count(std::uint64_t count, const std::string& path) {
  if (count <= max_cloud_points) return;
  throw FileError(path, 0,
                  "has " + std::to_string(count) + " points; at most " +
                      std::to_string(max_cloud_points) + " are possible: reduce it");
}

std::vector<Vector3> read_points(const std::string& path) {
  if (extension(path) == "npy") return points_from_npy(path);
  if (extension(path) != "ply") {
    throw FileError(path, 0, "is not a point cloud of a known format; known endings: ply, npy");
  }
  InputFile file(path);
  ByteBlocks bytes(file);
  return checked_ply(bytes);
}

Scene read_cloud_scene(const std::string& path, std::optional<double> radius) {
  const double needed = needed_radius(path, radius);
  return scene_of(read_points(path), path, needed);
}

Scene cloud_scene(std::string_view text, const std::string& path, std::optional<double> radius) {
  const double needed = needed_radius(path, radius);
  if (extension(path) != "ply") throw FileError(path, 0, "is read from a file, not from its text");
  ByteBlocks bytes(text, path);
  return scene_of(checked_ply(bytes), path, needed);
}

Error no_cloud(const std::string& path) {
  return Error::of("radius",
                   "only a point cloud, .ply or .npy, has a radius; " + path + " is none");
}

PointCloud cloud_from_json(const JsonDocument& document, const Json& json) {
  document.check_keys(json, {"radius", "file", "points", "pose"});
  PointCloud cloud;
  cloud.radius = document.number(document.need(json, "radius"));
  const Json* const file = document.find(json, "file");
  const Json* const points = document.find(json, "points");
  if ((file == nullptr) == (points == nullptr)) {
    document.refuse(json, "needs either \"file\" or \"points\"");
  }
  if (file != nullptr) {
    const std::filesystem::path folder = std::filesystem::path(document.path()).parent_path();
    cloud.points = read_points((folder / document.text(*file)).string());
  } else {
    for (const Json& point : document.items(*points)) {
      cloud.points.push_back(vector_from_json(document, point));
    }
  }
  try {
    check_cloud(cloud);
    if (const Json* const pose = document.find(json, "pose")) {
      const Pose placed = shape_pose_from_json(document, *pose);
      for (Vector3& point : cloud.points) point = placed * point;
      check_cloud(cloud);
    }
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    document.refuse(json, std::string("is no cloud: ") + error.what());
  }
  return cloud;
}

std::string cloud_to_json(const PointCloud& cloud) {
  std::string text = "{\"radius\": " + exact(cloud.radius) + ", \"points\": [";
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    text += (i == 0 ? "" : ", ") + json_numbers(cloud.points[i].data(), 3);
  }
  return text + "]}";
}

}  // namespace beeline::internal
