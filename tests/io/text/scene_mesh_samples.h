#pragma once

#include <cstring>
#include <string>
#include <vector>

#include <tests/io/text/mesh_samples.h>

namespace beeline::testing {

inline std::string row_major(const Eigen::Matrix4d& m) {
  std::string text;
  for (const double value : m.transpose().reshaped()) text += exact(value) + " ";
  return text;
}

inline std::string column_major(const Eigen::Matrix4d& m) {
  std::string text;
  for (const double value : m.reshaped()) text += (text.empty() ? "" : ",") + exact(value);
  return text;
}

/// A Collada file of a mesh in a node in a node.
inline std::string collada(const std::vector<Triangle>& triangles, double unit,
                           const Eigen::Matrix4d& outer, const Eigen::Matrix4d& inner,
                           const std::string& up_axis = "Z_UP") {
  std::string positions, indices;
  const std::size_t count = 3 * triangles.size();
  for (const Triangle& triangle : triangles) {
    for (const Vector3& corner : triangle) positions += coordinates(corner) + " ";
  }
  for (std::size_t i = 0; i < count; ++i) indices += std::to_string(i) + " ";
  return "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" "
         "version=\"1.4.1\"><asset><unit name=\"u\" meter=\"" +
         exact(unit) + "\"/><up_axis>" + up_axis +
         "</up_axis></asset><library_geometries><geometry id=\"g\"><mesh><source "
         "id=\"p\"><float_array id=\"a\" count=\"" +
         std::to_string(3 * count) + "\">" + positions +
         "</float_array><technique_common><accessor source=\"#a\" stride=\"3\" count=\"" +
         std::to_string(count) +
         "\"><param name=\"X\" type=\"float\"/><param name=\"Y\" type=\"float\"/><param "
         "name=\"Z\" type=\"float\"/></accessor></technique_common></source><vertices "
         "id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"" +
         std::to_string(triangles.size()) +
         "\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>" + indices +
         "</p></triangles></mesh></geometry></library_geometries><library_visual_scenes>"
         "<visual_scene id=\"s\"><node id=\"n\"><matrix>" +
         row_major(outer) + "</matrix><node id=\"m\"><matrix>" + row_major(inner) +
         "</matrix><instance_geometry url=\"#g\"/></node></node></visual_scene>"
         "</library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";
}

/// The buffer of a glTF file: coordinates as floats.
inline std::string gltf_buffer(const std::vector<Triangle>& triangles) {
  std::string bytes;
  for (const Triangle& triangle : triangles) {
    for (const Vector3& corner : triangle) {
      for (const double coordinate : corner) {
        bytes += little_endian_bytes(std::bit_cast<std::uint32_t>(static_cast<float>(coordinate)));
      }
    }
  }
  return bytes;
}

/// The JSON of a glTF file of a mesh in a node in a node. `uri` is the member of the buffer.
inline std::string gltf(const std::vector<Triangle>& triangles, const std::string& uri,
                        const Eigen::Matrix4d& outer, const Eigen::Matrix4d& inner) {
  const std::string count = std::to_string(3 * triangles.size()),
                    size = std::to_string(36 * triangles.size());
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[1],)"
         R"("matrix":[)" +
         column_major(outer) + R"(]},{"mesh":0,"matrix":[)" + column_major(inner) +
         R"(]}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"mode":4}]}],)"
         R"("accessors":[{"bufferView":0,"componentType":5126,"count":)" +
         count + R"(,"type":"VEC3","min":[-9,-9,-9],"max":[9,9,9]}],"bufferViews":[{"buffer":0,)" +
         R"("byteLength":)" + size + R"(}],"buffers":[{)" + uri + R"("byteLength":)" + size + "}]}";
}

/// A .glb file: the JSON and the buffer in one.
inline std::string glb(std::string json, const std::string& buffer) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto word = [](std::size_t value) {
    return little_endian_bytes(static_cast<std::uint32_t>(value));
  };
  return "glTF" + word(2) + word(28 + json.size() + buffer.size()) + word(json.size()) + "JSON" +
         json + word(buffer.size()) + std::string("BIN\0", 4) + buffer;
}

}  // namespace beeline::testing
