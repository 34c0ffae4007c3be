#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/text/internal/mesh_corners.h>
#include <beeline/io/text/internal/mesh_file.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/text_encoding.h>

namespace beeline::internal {
namespace {

constexpr std::size_t header_size = 84, triangle_size = 50;

std::vector<Vector3> read_binary(ByteBlocks& bytes, std::uint64_t triangles) {
  bytes.skip(header_size);
  TriangleCorners corners(bytes.path());
  for (std::uint64_t triangle = 1; triangle <= triangles; ++triangle) {
    const std::string_view data = bytes.peek(triangle_size);
    if (data.size() < triangle_size) {
      throw FileError(bytes.path(), 0, "is cut off at triangle " + std::to_string(triangle));
    }
    for (std::size_t at = 12; at < 48; at += 12) {  // after the normal
      Vector3 corner;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t bits = little_endian(data, at + 4 * i);
        float coordinate = 0;  // libc++ 14 has no std::bit_cast
        std::memcpy(&coordinate, &bits, sizeof coordinate);
        corner[static_cast<Eigen::Index>(i)] = coordinate;
      }
      if (!corner.allFinite()) {
        throw FileError(bytes.path(), 0,
                        "triangle " + std::to_string(triangle) +
                            " has a coordinate that is not a finite number");
      }
      corners.add(corner);
    }
    bytes.skip(triangle_size);
  }
  return corners.take();
}

/// The words of an ASCII STL file, one after the other:
///     solid NAME { facet normal X Y Z outer loop { vertex X Y Z } x 3 endloop endfacet } endsolid
class AsciiStl {
 public:
  explicit AsciiStl(ByteBlocks& bytes) : bytes_(bytes), corners_(bytes.path()) {}

  std::vector<Vector3> read() {
    std::string_view line;
    while (bytes_.next_line(line)) {
      for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
        if (!take(word)) continue;
        take_name(line);
        break;
      }
    }
    if (in_solid_) throw FileError(bytes_.path(), 0, "is cut off: its last endsolid is missing");
    return corners_.take();
  }

 private:
  static constexpr std::array<std::string_view, 9> facet{
      "facet", "normal", "outer", "loop", "vertex", "vertex", "vertex", "endloop", "endfacet"};

  static bool is(std::string_view word, std::string_view expected) {
    return word == expected || same_ignoring_case(word, expected);
  }

  /// Takes the next word; returns whether the remainder of the line is a name.
  bool take(std::string_view word) {
    if (normal_left_ > 0) {  // it may be NaN
      --normal_left_;
      return false;
    }
    if (coordinates_ < 3) {
      take_coordinate(word);
      return false;
    }
    if (!in_solid_ || (next_ == 0 && is(word, "endsolid"))) {
      if (!is(word, in_solid_ ? "endsolid" : "solid")) refuse(word, "solid");
      in_solid_ = !in_solid_;
      return true;
    }
    if (!is(word, facet[next_])) refuse(word, facet[next_]);
    if (facet[next_] == "normal") normal_left_ = 3;
    if (facet[next_] == "vertex") coordinates_ = 0;
    next_ = (next_ + 1) % facet.size();
    return false;
  }

  /// Takes the remainder of a line, the name of a solid. A facet in it would be lost.
  void take_name(std::string_view line) const {
    bool after_facet = false;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      if (after_facet && is(word, "normal")) {
        throw FileError(
            bytes_.path(), bytes_.line(),
            "has a facet in the line of \"solid\" or \"endsolid\", whose remainder is a "
            "name; begin the facet in a line of its own");
      }
      after_facet = is(word, "facet");
    }
  }

  void take_coordinate(std::string_view word) {
    corner_[coordinates_++] = take_number(word, bytes_);
    if (coordinates_ == 3) corners_.add(corner_);
  }

  [[noreturn]] void refuse(std::string_view word, std::string_view expected) const {
    throw FileError(bytes_.path(), bytes_.line(),
                    "has " + in_quotes(word) + " in the place of " + in_quotes(expected));
  }

  ByteBlocks& bytes_;
  TriangleCorners corners_;
  bool in_solid_ = false;
  std::size_t next_ = 0;  ///< the next word of a facet
  int normal_left_ = 0;   ///< numbers of the normal that follow
  Eigen::Index coordinates_ = 3;
  Vector3 corner_ = Vector3::Zero();
};

bool begins_as_ascii(std::string_view front) {
  if (front.starts_with(utf8_mark)) front.remove_prefix(utf8_mark.size());
  front.remove_prefix(std::min(front.find_first_not_of(" \t\r\n"), front.size()));
  return same_ignoring_case(front.substr(0, 5), "solid") &&
         front.find('\0') == std::string_view::npos;
}

}  // namespace

/// Many binary files begin with "solid" too: their size gives them away.
std::vector<Vector3> mesh_from_stl(ByteBlocks& bytes) {
  const std::string_view front = bytes.peek(header_size);
  std::optional<std::uint64_t> triangles;
  if (front.size() == header_size) triangles = little_endian(front, 80);
  const auto size_of = [](std::uint64_t count) { return header_size + triangle_size * count; };
  if (triangles && bytes.size() == size_of(*triangles)) return read_binary(bytes, *triangles);
  if (begins_as_ascii(front)) return AsciiStl(bytes).read();
  if (!triangles) {
    throw FileError(bytes.path(), 0,
                    "is not an STL file: it does not begin with \"solid\", and is shorter than the "
                    "84 bytes in front of the triangles of a binary file");
  }
  throw FileError(bytes.path(), 0,
                  "is cut off, or not an STL file: it does not begin with \"solid\", and as a "
                  "binary file of " +
                      std::to_string(*triangles) + " triangles it would have " +
                      std::to_string(size_of(*triangles)) + " bytes, not " +
                      std::to_string(bytes.size()));
}

}  // namespace beeline::internal
