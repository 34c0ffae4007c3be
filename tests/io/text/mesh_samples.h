#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <vector>

#include <beeline/io/text/numbers.h>
#include <beeline/pose/so3.h>

#include <tests/random.h>

namespace beeline::testing {

using Triangle = std::array<Vector3, 3>;

inline std::string coordinates(const Vector3& v) {
  return exact(v.x()) + " " + exact(v.y()) + " " + exact(v.z());
}

inline std::string ascii_stl(const std::vector<Triangle>& triangles) {
  std::string text = "solid of a test\n";
  for (const Triangle& triangle : triangles) {
    text += " facet normal 0 0 nan\n  outer loop\n";
    for (const Vector3& corner : triangle) text += "   vertex " + coordinates(corner) + "\n";
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid of a test\n";
}

inline std::string little_endian_bytes(std::uint32_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xff);
  return bytes;
}

/// Its header begins with "solid", as some programs write it.
inline std::string binary_stl(const std::vector<Triangle>& triangles) {
  std::string bytes = "solid, but binary";
  bytes.resize(80, '\0');
  bytes += little_endian_bytes(static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& triangle : triangles) {
    bytes += std::string(12, '\xff');  // a normal that is NaN
    for (const Vector3& corner : triangle) {
      for (const double coordinate : corner) {
        bytes += little_endian_bytes(std::bit_cast<std::uint32_t>(static_cast<float>(coordinate)));
      }
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

inline std::string obj(const std::vector<Triangle>& triangles) {
  std::string text = "# of a test\no body\nv 99 99 99\n";
  for (const Triangle& triangle : triangles) {
    for (const Vector3& corner : triangle) text += "v " + coordinates(corner) + "\n";
    text += "vn 0 0 1\nf -3//-1 -2//-1 -1//-1\n";
  }
  return text;
}

/// Triangles between points on a sphere of float coordinates, which every format holds exactly.
inline std::vector<Triangle> random_triangles(Random& random, int count) {
  std::vector<Vector3> points;
  for (int i = 0; i < count; ++i) {
    points.push_back((1000 * random.direction()).array().round() / 1024);
  }
  const auto any = [&] { return points[static_cast<std::size_t>(random.integer(0, count - 1))]; };
  std::vector<Triangle> triangles;
  for (const Vector3& point : points) triangles.push_back({point, any(), any()});
  return triangles;
}

}  // namespace beeline::testing
