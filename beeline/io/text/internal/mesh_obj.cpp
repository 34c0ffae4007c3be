#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include <beeline/error.h>
#include <beeline/io/text/internal/mesh_file.h>
#include <beeline/io/text/internal/name.h>

namespace beeline::internal {
namespace {

/// Statements that change no triangle: normals, textures, names, groups, materials, and points and
/// lines, which have no surface.
constexpr std::array<std::string_view, 18> without_surface{
    "vn",    "vt",       "vp",       "p",   "l",      "g",      "s",      "mg",     "o",
    "bevel", "c_interp", "d_interp", "lod", "usemtl", "mtllib", "usemap", "maplib", "shadow_obj"};

/// The vertices of an OBJ file and the faces that use them.
class ObjMesh {
 public:
  explicit ObjMesh(ByteBlocks& bytes) : bytes_(bytes) {}

  std::vector<Vector3> read() {
    std::string_view line;
    while (bytes_.next_line(line)) {
      if (line.ends_with('\\')) {
        continued_ += line.substr(0, line.size() - 1);
        continued_ += ' ';
        if (continued_.size() > ByteBlocks::max_block) refuse("has a line longer than 1 MiB");
        continue;
      }
      const std::string begun = std::exchange(continued_, {});
      if (begun.empty()) {
        take(line);
      } else {
        take(begun + std::string(line));
      }
    }
    if (!continued_.empty()) take(continued_);
    return used_vertices();
  }

 private:
  [[noreturn]] void refuse(const std::string& fault) const {
    throw FileError(bytes_.path(), bytes_.line(), fault);
  }

  void take(std::string_view line) {
    line = line.substr(0, line.find('#'));
    const std::string_view statement = take_word(line);
    if (statement.empty()) return;
    if (statement == "v") {
      take_vertex(line);
    } else if (statement == "f" || statement == "fo") {
      take_face(line);
    } else if (std::find(without_surface.begin(), without_surface.end(), statement) ==
               without_surface.end()) {
      refuse("has a statement " + in_quotes(statement) +
             ", which is not read; known are v, f and names, materials and normals");
    }
  }

  /// A weight and a colour may follow the coordinates.
  void take_vertex(std::string_view line) {
    if (vertices_.size() == max_mesh_corners) {
      refuse("has more than " + std::to_string(max_mesh_corners) + " vertices; reduce the mesh");
    }
    Vector3 vertex;
    for (double& coordinate : vertex) coordinate = take_number(line, bytes_);
    vertices_.push_back(vertex);
    is_used_.push_back(false);
  }

  /// The corners are "v", "v/vt", "v//vn" or "v/vt/vn". Numbers count from 1, negative ones back
  /// from the last vertex before the face.
  void take_face(std::string_view line) {
    int corners = 0;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
      const std::string_view digits = word.substr(0, word.find('/'));
      long long number = 0;
      const auto [end, fault] =
          std::from_chars(digits.data(), digits.data() + digits.size(), number);
      if (fault != std::errc() || end != digits.data() + digits.size() || number == 0) {
        refuse("has a face with the corner " + in_quotes(word) +
               "; a corner begins with the number of a vertex");
      }
      const auto count = static_cast<long long>(vertices_.size());
      const long long index = number > 0 ? number - 1 : count + number;
      if (index < 0 || index >= count) {
        refuse("has a face with vertex " + std::to_string(number) + "; " + std::to_string(count) +
               " vertices are above it");
      }
      is_used_[static_cast<std::size_t>(index)] = true;
      ++corners;
    }
    if (corners < 3) {
      refuse("has a face with " + std::to_string(corners) + " corners; it must have three or more");
    }
  }

  std::vector<Vector3> used_vertices() {
    std::size_t used = 0;
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      if (is_used_[i]) vertices_[used++] = vertices_[i];
    }
    vertices_.resize(used);
    if (used == 0) throw FileError(bytes_.path(), 0, "has no triangles");
    return std::move(vertices_);
  }

  ByteBlocks& bytes_;
  std::string continued_;  ///< lines that end in a backslash
  std::vector<Vector3> vertices_;
  std::vector<bool> is_used_;
};

}  // namespace

std::vector<Vector3> mesh_from_obj(ByteBlocks& bytes) { return ObjMesh(bytes).read(); }

}  // namespace beeline::internal
