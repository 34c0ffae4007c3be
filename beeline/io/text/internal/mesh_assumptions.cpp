#include <algorithm>
#include <array>
#include <cmath>

#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/mesh_assumptions.h>
#include <beeline/io/text/internal/mesh_file.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/text_encoding.h>
#include <beeline/io/text/json.h>

namespace beeline::internal {
namespace {

constexpr std::array<std::string_view, 20> harmless_extensions{
    "EXT_texture_avif",
    "EXT_texture_webp",
    "KHR_lights_punctual",
    "KHR_materials_anisotropy",
    "KHR_materials_clearcoat",
    "KHR_materials_dispersion",
    "KHR_materials_emissive_strength",
    "KHR_materials_ior",
    "KHR_materials_iridescence",
    "KHR_materials_pbrSpecularGlossiness",
    "KHR_materials_sheen",
    "KHR_materials_specular",
    "KHR_materials_transmission",
    "KHR_materials_unlit",
    "KHR_materials_variants",
    "KHR_materials_volume",
    "KHR_texture_basisu",
    "KHR_texture_transform",
    "KHR_xmp_json_ld",
    "MSFT_texture_dds"};
/// They have positions of their own, which assimp replaces by others even if they are optional.
constexpr std::array<std::string_view, 4> moving_extensions{
    "EXT_mesh_gpu_instancing", "EXT_meshopt_compression", "KHR_draco_mesh_compression",
    "KHR_meshopt_compression"};

bool is_among(const auto& names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The positions of a glTF file.
class GltfPositions {
 public:
  GltfPositions(std::string_view json, const std::string& path) : document_(json, path) {}

  void check() const {
    for (const Json& name : items_of(document_.root(), "extensionsRequired")) {
      const std::string& extension = document_.text(name);
      if (!is_among(harmless_extensions, extension)) refuse_extension(name, extension);
    }
    for (const Json& name : items_of(document_.root(), "extensionsUsed")) {
      const std::string& extension = document_.text(name);
      if (is_among(moving_extensions, extension)) refuse_extension(name, extension);
    }
    for (const Json& view : items_of(document_.root(), "bufferViews")) check_extensions(view);
    for (const Json& node : items_of(document_.root(), "nodes")) {
      check_extensions(node);
      if (const Json* const skin = document_.find(node, "skin")) {
        document_.refuse(*skin, "is a skin, whose joints move the mesh; export it without one");
      }
    }
    for (const Json& mesh : items_of(document_.root(), "meshes")) {
      for (const Json& primitive : items_of(mesh, "primitives")) check_primitive(primitive);
    }
  }

 private:
  const Json::Items& items_of(const Json& object, std::string_view key) const {
    static const Json::Items none;
    const Json* const list = document_.find(object, key);
    return list == nullptr ? none : document_.items(*list);
  }

  [[noreturn]] void refuse_extension(const Json& at, const std::string& name) const {
    document_.refuse(at, "is the extension " + in_quotes(name) +
                             ", which is not read; export the mesh without it, or as STL or OBJ");
  }

  void check_extensions(const Json& object) const {
    const Json* const extensions = document_.find(object, "extensions");
    if (extensions == nullptr) return;
    for (const auto& [name, value] : document_.members(*extensions)) {
      if (is_among(moving_extensions, name)) refuse_extension(value, name);
    }
  }

  void check_primitive(const Json& primitive) const {
    check_extensions(primitive);
    if (const Json* const targets = document_.find(primitive, "targets")) {
      document_.refuse(*targets,
                       "are morph targets, which move the vertices; export the mesh "
                       "without them");
    }
    if (const Json* const indices = document_.find(primitive, "indices")) accessor(*indices);
    for (const auto& [name, index] : document_.members(document_.need(primitive, "attributes"))) {
      if (!name.starts_with("POSITION")) continue;  // assimp reads POSITION_1 as more positions
      if (name != "POSITION") document_.refuse(index, "is no attribute of glTF");
      const Json& type = document_.need(accessor(index), "componentType");
      constexpr double gltf_float = 5126;
      if (document_.number(type) != gltf_float) {
        document_.refuse(type, "of positions is " + number(document_.number(type)) +
                                   "; only 5126, float, is read: export the mesh without "
                                   "quantization");
      }
    }
  }

  /// The accessor of an index, which must have all its numbers in a buffer.
  const Json& accessor(const Json& index) const {
    const Json::Items& accessors = items_of(document_.root(), "accessors");
    const double k = document_.number(index);
    if (!(k >= 0 && k < static_cast<double>(accessors.size()) && k == std::floor(k))) {
      document_.refuse(index, "is the index of no accessor");
    }
    const Json& found = accessors[static_cast<std::size_t>(k)];
    if (const Json* const sparse = document_.find(found, "sparse")) {
      document_.refuse(*sparse, "is not read; export the mesh without sparse accessors");
    }
    document_.need(found, "bufferView");
    return found;
  }

  JsonDocument document_;
};

/// The JSON in the first chunk of a .glb file (glTF 2.0, section 4.4).
std::string_view json_of_glb(std::string_view bytes, const std::string& path) {
  constexpr std::size_t header = 12, chunk_header = 8;
  if (!bytes.starts_with("glTF") || bytes.size() < header + chunk_header) {
    throw FileError(path, 0, "is not a .glb file: it does not begin with \"glTF\" and a chunk");
  }
  const std::size_t size = little_endian(bytes, header);
  bytes.remove_prefix(header);
  if (bytes.substr(4, 4) != "JSON" || size > bytes.size() - chunk_header) {
    throw FileError(path, 0, "has no whole chunk of JSON at its front");
  }
  return bytes.substr(chunk_header, size);
}

void check_collada(std::string_view text, const std::string& path) {
  for (const auto& [element, advice] :
       {std::pair{"instance_controller", "a skin or a morph, which moves the vertices"},
        std::pair{"skew", "a transform that is not read"}}) {
    const std::size_t at = text.find(std::string("<") + element);
    if (at == std::string_view::npos) continue;
    const auto line =
        std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    throw FileError(path, static_cast<int>(line) + 1,
                    std::string("has an element <") + element + ">, " + advice +
                        "; export the mesh without it, or as STL or OBJ");
  }
}

}  // namespace

void check_mesh_assumptions(std::string_view bytes, const std::string& path) {
  const std::string ending = extension(path);
  if (ending == "dae") return check_collada(text_in(bytes, path), path);
  GltfPositions(ending == "glb" ? json_of_glb(bytes, path) : bytes, path).check();
}

}  // namespace beeline::internal
