#include <cstring>
#include <deque>
#include <exception>
#include <filesystem>
#include <new>

#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/child_process.h>
#include <beeline/io/text/internal/mesh_assumptions.h>
#include <beeline/io/text/internal/mesh_corners.h>
#include <beeline/io/text/internal/mesh_file.h>
#include <beeline/io/text/internal/name.h>

#include <assimp/IOSystem.hpp>
#include <assimp/Importer.hpp>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/config.h>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>

namespace beeline::internal {
namespace {

using Path = std::filesystem::path;

constexpr std::size_t max_scene_size = std::size_t{256} << 20;
/// Corners of triangles, counted in each node that has them: nodes may repeat others.
constexpr std::size_t max_visits = 100'000'000;
constexpr ChildLimits child_limits{.memory = std::uint64_t{4} << 30, .seconds = 120};

/// The file and, for buffers of glTF, files in its folder and in folders below it.
class MeshFolder : public Assimp::IOSystem {
 public:
  MeshFolder(std::string_view bytes, const std::string& file)
      : bytes_(bytes), file_(file), folder_(resolved(Path(file).parent_path() / ".")) {}

  bool Exists(const char* name) const override { return name == file_ || is_inside(name); }
  char getOsSeparator() const override { return '/'; }
  void Close(Assimp::IOStream* stream) override { delete stream; }

  Assimp::IOStream* Open(const char* name, const char*) override {
    if (name == file_) return stream_of(bytes_);
    if (!is_inside(name)) {
      throw FileError(file_, 0,
                      "names a file " + in_quotes(name) +
                          ", which is not in the folder of the mesh or in one below it");
    }
    return stream_of(others_.emplace_back(read_file(name)));
  }

 private:
  static Path resolved(const Path& at) {
    std::error_code unresolved;
    Path there = std::filesystem::weakly_canonical(at.empty() ? "." : at, unresolved);
    return unresolved ? Path() : there;
  }

  /// Whether this is a regular file in the folder, by its path and where links lead.
  bool is_inside(const char* name) const {
    const Path there = resolved(name);
    const Path inside = there.lexically_relative(folder_);
    std::error_code unknown;
    return !folder_.empty() && !inside.empty() && *inside.begin() != ".." &&
           std::filesystem::is_regular_file(there, unknown);
  }

  static Assimp::IOStream* stream_of(std::string_view bytes) {
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                      bytes.size());
  }

  std::string_view bytes_;
  std::string file_;
  Path folder_;
  std::deque<std::string> others_;
};

/// Leaves one reader of assimp's, which has dozens: each is chosen by the content of a file too.
void keep_reader(Assimp::Importer& importer, std::string_view name) {
  for (std::size_t i = importer.GetImporterCount(); i > 0; --i) {
    if (importer.GetImporterInfo(i - 1)->mName == name) continue;
    importer.UnregisterLoader(importer.GetImporter(i - 1));  // no longer owned: the process ends
  }
}

Eigen::Matrix4d matrix_of(const aiMatrix4x4& m) {
  return Eigen::Map<const Eigen::Matrix<ai_real, 4, 4, Eigen::RowMajor>>(&m.a1).cast<double>();
}

/// Adds the corners of the faces of a mesh. Points and lines are no surface.
void add_corners(const aiMesh& mesh, const Eigen::Matrix4d& pose, const std::string& file,
                 std::size_t& visits, TriangleCorners& corners) {
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices < 3) continue;
    visits += face.mNumIndices;
    if (visits > max_visits) throw FileError(file, 0, "has too many triangles; reduce the mesh");
    for (unsigned i = 0; i < face.mNumIndices; ++i) {
      if (face.mIndices[i] >= mesh.mNumVertices) {
        throw FileError(file, 0, "has a face with a vertex that is not there");
      }
      const aiVector3D& at = mesh.mVertices[face.mIndices[i]];
      const Vector3 corner = (pose * Eigen::Vector4d(at.x, at.y, at.z, 1)).head<3>();
      if (!corner.allFinite()) {
        throw FileError(file, 0, "has a coordinate that is not a finite number");
      }
      corners.add(corner);
    }
  }
}

std::vector<Vector3> corners_of(const aiScene& scene, const std::string& file) {
  TriangleCorners corners(file);
  std::size_t visits = 0;
  std::vector<std::pair<const aiNode*, Eigen::Matrix4d>> open;
  if (scene.mRootNode != nullptr) open.emplace_back(scene.mRootNode, Eigen::Matrix4d::Identity());
  while (!open.empty()) {
    const auto [node, parent] = open.back();
    open.pop_back();
    const Eigen::Matrix4d pose = parent * matrix_of(node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      if (node->mMeshes[i] >= scene.mNumMeshes) {
        throw FileError(file, 0, "has a node with a mesh that is not there");
      }
      add_corners(*scene.mMeshes[node->mMeshes[i]], pose, file, visits, corners);
    }
    if (++visits > max_visits) throw FileError(file, 0, "has too many nodes; reduce the mesh");
    for (unsigned i = 0; i < node->mNumChildren; ++i) open.emplace_back(node->mChildren[i], pose);
  }
  return corners.take();
}

void rethrow_bad_alloc(const std::exception_ptr& fault) {
  try {
    if (fault) std::rethrow_exception(fault);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (...) {  // has a message
  }
}

std::string read_scene_corners(std::string_view bytes, const std::string& file) {
  Assimp::Importer importer;
  importer.SetIOHandler(new MeshFolder(bytes, file));  // which the importer owns
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);  // of nodes without meshes
  keep_reader(importer, extension(file) == "dae" ? "Collada Importer" : "glTF2 Importer");
  const aiScene* const scene = importer.ReadFile(file, 0);
  if (scene == nullptr) {
    rethrow_bad_alloc(importer.GetException());
    throw FileError(file, 0, "cannot be read: " + printable(importer.GetErrorString()));
  }
  const std::vector<Vector3> corners = corners_of(*scene, file);
  return {reinterpret_cast<const char*>(corners.data()), corners.size() * sizeof(Vector3)};
}

/// A link in a file may lead the reader in circles: it reads in a process of its own.
std::vector<Vector3> read_isolated(std::string_view bytes, const std::string& file) {
  std::optional<std::string> answer;
  try {
    answer = in_child_process([&] { return read_scene_corners(bytes, file); }, child_limits);
  } catch (const Error& error) {
    throw FileError(file, 0, error.what());
  }
  if (!answer) {
    throw FileError(file, 0,
                    "cannot be read: the reader (assimp) crashed, or needed more than 4 GiB or "
                    "2 minutes; convert the mesh to STL or OBJ");
  }
  std::vector<Vector3> corners(answer->size() / sizeof(Vector3));
  std::memcpy(static_cast<void*>(corners.data()), answer->data(), corners.size() * sizeof(Vector3));
  return corners;
}

}  // namespace

std::vector<Vector3> mesh_from_scene_file(ByteBlocks& bytes) {
  if (bytes.size() > max_scene_size) throw FileError(bytes.path(), 0, "is larger than 256 MiB");
  std::string whole;
  while (true) {
    const std::string_view block = bytes.peek(ByteBlocks::max_block);
    if (block.empty()) break;
    whole += block;
    bytes.skip(block.size());
  }
  if (whole.starts_with("PK")) throw FileError(bytes.path(), 0, "is a ZIP archive; unpack it");
  check_mesh_assumptions(whole, bytes.path());
  return read_isolated(whole, bytes.path());
}

}  // namespace beeline::internal
