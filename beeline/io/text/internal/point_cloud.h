#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <beeline/collision/scene.h>
#include <beeline/io/text/json.h>

namespace beeline::internal {

/// Reads the points of a file. Throws FileError for another ending, a file larger than 1 GiB, and
/// what check_cloud() refuses.
std::vector<Vector3> read_points(const std::string& path);

/// Throws FileError for more than max_cloud_points, before they are read.
void check_point_count(std::uint64_t count, const std::string& path);

/// Reads a file of points as a scene of one obstacle, which has the name of the file without its
/// ending. Throws FileError; Error without a radius.
Scene read_cloud_scene(const std::string& path, std::optional<double> radius);
/// The same from the text of a PLY file.
Scene cloud_scene(std::string_view text, const std::string& path, std::optional<double> radius);

/// The error of a radius for a scene that is no file of points.
Error no_cloud(const std::string& path);

/// Reads a cloud of a scene: {"radius", "file" or "points", "pose"}.
PointCloud cloud_from_json(const JsonDocument& document, const Json& json);

/// Returns the cloud as JSON, with its points.
std::string cloud_to_json(const PointCloud& cloud);

}  // namespace beeline::internal
