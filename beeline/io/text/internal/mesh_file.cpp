#include <algorithm>

#include <beeline/error.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/internal/mesh_file.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/internal/text_encoding.h>
#include <beeline/io/text/internal/text_fault.h>

namespace beeline::internal {
namespace {

constexpr std::uint64_t max_mesh_size = std::uint64_t{1} << 30;

std::vector<Vector3> read_in_format(ByteBlocks& bytes, [[maybe_unused]] double& rounding) {
  refuse_lfs_pointer(bytes.peek(lfs_pointer_size), bytes.path());
  if (bytes.size() > max_mesh_size) throw FileError(bytes.path(), 0, "is larger than 1 GiB");
  const std::string ending = extension(bytes.path());
  if (ending == "stl") return mesh_from_stl(bytes);
  if (ending == "obj") return mesh_from_obj(bytes);
#ifdef BEELINE_ASSIMP
  if (is_scene_mesh(bytes.path())) return mesh_from_scene_file(bytes, rounding);
#endif
  throw FileError(bytes.path(), 0,
                  "is not a mesh of a known format; known endings: " + listed(mesh_endings()) +
                      (is_scene_mesh(bytes.path()) ? scene_mesh_advice() : ""));
}

}  // namespace

const std::vector<std::string>& mesh_endings() {
#ifdef BEELINE_ASSIMP
  static const std::vector<std::string> endings{"stl", "obj", "dae", "gltf", "glb"};
#else
  static const std::vector<std::string> endings{"stl", "obj"};
#endif
  return endings;
}

bool is_scene_mesh(const std::string& path) {
  const std::string ending = extension(path);
  return ending == "dae" || ending == "gltf" || ending == "glb";
}

std::string scene_mesh_advice() {
  return "; Collada and glTF are read by a build with -DBEELINE_ASSIMP=ON, which needs assimp "
         "(Debian: libassimp-dev)";
}

std::vector<Vector3> read_mesh(const std::string& path, double* rounding) {
  InputFile file(path);
  ByteBlocks bytes(file);
  double bound = 0;
  std::vector<Vector3> corners = read_in_format(bytes, bound);
  if (rounding != nullptr) *rounding = bound;
  return corners;
}

std::vector<Vector3> mesh_from_text(std::string_view text, const std::string& path) {
  ByteBlocks bytes(text, path);
  double rounding = 0;
  return read_in_format(bytes, rounding);
}

std::uint32_t little_endian(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i > 0; --i) {
    value = value << 8 | static_cast<unsigned char>(bytes[at + i - 1]);
  }
  return value;
}

std::string_view take_word(std::string_view& line) {
  constexpr std::string_view blanks = " \t\r\v\f";
  line.remove_prefix(std::min(line.find_first_not_of(blanks), line.size()));
  const std::string_view word = line.substr(0, line.find_first_of(blanks));
  line.remove_prefix(word.size());
  return word;
}

double take_number(std::string_view& line, const ByteBlocks& bytes) {
  const std::string_view word = take_word(line);
  double value = 0;
  const ElementFault fault = read_number(word, value);
  if (fault == ElementFault::none) return value;
  throw FileError(bytes.path(), bytes.line(), clause(fault, word));
}

}  // namespace beeline::internal
