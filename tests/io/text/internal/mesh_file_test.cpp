#include <algorithm>
#include <gtest/gtest.h>

#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/mesh_file.h>

#include <tests/io/text/mesh_samples.h>
#include <tests/refusal.h>
#include <tests/temporary_folder.h>

namespace beeline::internal {
namespace {

using beeline::testing::Random;
using beeline::testing::Triangle;

std::vector<Vector3> different(std::vector<Vector3> points) {
  std::sort(points.begin(), points.end(), [](const Vector3& a, const Vector3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  return points;
}

std::vector<Vector3> corners_of(const std::vector<Triangle>& triangles) {
  std::vector<Vector3> corners;
  for (const Triangle& triangle : triangles) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
  return different(corners);
}

TEST(MeshFile, HasTheSameCornersInEveryFormat) {
  Random random;
  const beeline::testing::TemporaryFolder folder;
  for (int i = 0; i < beeline::testing::cases(60); ++i) {
    const auto triangles = beeline::testing::random_triangles(random, random.integer(1, 300));
    const std::vector<Vector3> corners = corners_of(triangles);
    for (const auto& [name, text] :
         {std::pair{"ascii.stl", beeline::testing::ascii_stl(triangles)},
          std::pair{"binary.STL", beeline::testing::binary_stl(triangles)},
          std::pair{"a.b.obj", beeline::testing::obj(triangles)}}) {
      EXPECT_EQ(different(mesh_from_text(text, name)), corners) << name;
      EXPECT_EQ(different(read_mesh(folder.write(name, text))), corners) << name;
    }
  }
}

TEST(MeshFile, AsciiStlIsReadHoweverItsWordsAreSpaced) {
  const std::string plain =
      "solid a vertex 1 in its name\nfacet normal 0 0 1 outer loop\nvertex 0 0 0\n"
      "vertex 1 0 0 vertex +.5 1e0 0\nendloop endfacet\nendsolid a\n";
  const auto corners = mesh_from_text(plain, "a.stl");
  ASSERT_EQ(corners.size(), 3u);
  EXPECT_EQ(corners[2], Vector3(0.5, 1, 0));
  std::string other = plain;
  for (char& c : other) c = c == '\n' ? '\r' : c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  EXPECT_EQ(mesh_from_text(other, "a.stl"), corners) << "upper case, lines that end in CR";
  EXPECT_EQ(mesh_from_text("\xEF\xBB\xBF" + plain, "a.stl"), corners);
  EXPECT_EQ(mesh_from_text(plain + plain, "a.stl").size(), 6u) << "two solids";
}

TEST(MeshFile, ObjFacesSelectTheirVertices) {
  const auto read = [](const std::string& faces) {
    return mesh_from_text("v 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0 1.0\r\nv 5 5 5\n" + faces,
                          "a.obj");
  };
  const std::vector<Vector3> three{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const char* face :
       {"f 1 2 3", "f 1/9 2/9 3/9", "f 1//9 2//9 3//9", "f 1/9/9 2/9/9 3/9/9", "f -4 -3 -2",
        "f 1 \\\n2 \\\n3", "g a\nusemtl b\ns off\nf 3 2 1 # one", "f 1 2 3 2"}) {
    EXPECT_EQ(read(face), three) << face;
  }
  EXPECT_REFUSED(read("f 1 2 5"), "a.obj:5: has a face with vertex 5; 4 vertices are above it");
  EXPECT_REFUSED(read("f 1 2 -5"), "vertex -5");
  EXPECT_REFUSED(read("f 0 1 2"), "\"0\"");
  EXPECT_REFUSED(read("f 1 2"), "2 corners");
  EXPECT_REFUSED(read("f 1 2 99999999999999999999"), "a.obj:5");
  EXPECT_REFUSED(read("f a b c"), "\"a\"");
  EXPECT_REFUSED(read(""), "a.obj: has no triangles");
  EXPECT_REFUSED(read("curv 0 1 1 2 3"), "a.obj:5: has a statement \"curv\"");
  EXPECT_REFUSED(read("v 1 2\nf 1 2 3"), "a.obj:5: a number is missing");
  EXPECT_REFUSED(read("v 1 2 inf\nf 1 2 3"), "\"inf\" must be finite");
}

TEST(MeshFile, DamagedFilesAreRefused) {
  Random random;
  const auto triangles = beeline::testing::random_triangles(random, 40);
  const std::string binary = beeline::testing::binary_stl(triangles);
  const std::string ascii = beeline::testing::ascii_stl(triangles);
  for (std::size_t size = 0; size < binary.size(); size += 7) {
    EXPECT_REFUSED(mesh_from_text(binary.substr(0, size), "a.stl"), "a.stl");
  }
  for (std::size_t size = 0; size + 20 < ascii.size(); size += 7) {
    EXPECT_REFUSED(mesh_from_text(ascii.substr(0, size), "a.stl"), "a.stl");
  }
  EXPECT_REFUSED(mesh_from_text(binary + "x", "a.stl"), "40 triangles it would have 2084 bytes");
  std::string many = binary;
  many.replace(80, 4, "\xff\xff\xff\xff");
  EXPECT_REFUSED(mesh_from_text(many, "a.stl"), "4294967295 triangles");
  std::string nan = binary;
  nan.replace(84 + 50 * 3 + 12, 4, "\xff\xff\xff\xff");
  EXPECT_REFUSED(mesh_from_text(nan, "a.stl"), "triangle 4 has a coordinate that is not a finite");
  EXPECT_REFUSED(mesh_from_text(beeline::testing::binary_stl({}), "a.stl"), "has no triangles");
  EXPECT_REFUSED(mesh_from_text(beeline::testing::ascii_stl({}), "a.stl"), "has no triangles");
  const std::string facet =
      "facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n";
  EXPECT_REFUSED(mesh_from_text("solid a " + facet + facet + "endsolid a\n", "a.stl"),
                 "a.stl:1: has a facet in the line of \"solid\"");
  EXPECT_REFUSED(
      mesh_from_text("solid a\n" + facet + "endsolid a solid b " + facet + "endsolid b\n", "a.stl"),
      "a.stl:3: has a facet in the line of");
  EXPECT_EQ(mesh_from_text("solid normal facet\n" + facet + "endsolid", "a.stl").size(), 3u);
  EXPECT_REFUSED(mesh_from_text("solid a\nfacet normal 0 0 1\nouter lop\n", "a.stl"),
                 "a.stl:3: has \"lop\" in the place of \"loop\"");
  EXPECT_REFUSED(
      mesh_from_text("solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0,5 0\n", "a.stl"),
      "a.stl:4: \"0,5\" is not a number");
  EXPECT_REFUSED(mesh_from_text("", "a.stl"), "is not an STL file");
  EXPECT_REFUSED(mesh_from_text("", "a.obj"), "has no triangles");
  EXPECT_REFUSED(mesh_from_text("v 0 0 " + std::string(2 << 20, '1'), "a.obj"),
                 "longer than 1 MiB");
  EXPECT_REFUSED(
      mesh_from_text("version https://git-lfs.github.com/spec/v1\noid sha256:0\n", "a.stl"),
      "git lfs pull");
  EXPECT_REFUSED(mesh_from_text(binary, "a.wrl"), "known endings: stl, obj");
  EXPECT_REFUSED(read_mesh("no such.stl"), "no such.stl: cannot be read");
}

/// Blocks of 1 MiB divide its lines and triangles anywhere.
TEST(MeshFile, LargeFilesAreReadInBlocks) {
  Random random;
  const int count = beeline::testing::example_size(25'000);
  const auto triangles = beeline::testing::random_triangles(random, count);
  const std::vector<Vector3> corners = corners_of(triangles);
  const beeline::testing::TemporaryFolder folder;
  for (const auto& [name, text] : {std::pair{"a.stl", beeline::testing::ascii_stl(triangles)},
                                   std::pair{"b.stl", beeline::testing::binary_stl(triangles)},
                                   std::pair{"c.obj", beeline::testing::obj(triangles)}}) {
    EXPECT_EQ(different(read_mesh(folder.write(name, text))), corners) << name;
  }
}

}  // namespace
}  // namespace beeline::internal
