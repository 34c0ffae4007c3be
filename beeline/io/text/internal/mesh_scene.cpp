#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <deque>
#include <exception>
#include <filesystem>
#include <limits>
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

/// The file and, for buffers of glTF, files in its folder and in folders below it. If the file is a
/// symbolic link, its folder is also the one of the file that it leads to.
class MeshFolder : public Assimp::IOSystem {
 public:
  MeshFolder(std::string_view bytes, const std::string& file)
      : bytes_(bytes),
        file_(file),
        folders_{resolved(Path(file).parent_path() / "."), resolved(file).parent_path()} {}

  bool Exists(const char* name) const override { return name == file_ || is_inside(name); }
  char getOsSeparator() const override { return '/'; }
  void Close(Assimp::IOStream* stream) override { delete stream; }

  Assimp::IOStream* Open(const char* name, const char*) override {
    if (name == file_) return stream_of(bytes_);
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(name, unknown)) refuse(name, "is not there");
    if (!is_inside(name)) refuse(name, "is not in the folder of the mesh or in one below it");
    try {
      return stream_of(others_.emplace_back(read_file(name)));
    } catch (const FileError& error) {
      refuse(name, error.fault());
    }
  }

 private:
  /// Keeps the path whole, unless it is very long.
  [[noreturn]] void refuse(const std::string& name, const std::string& fault) const {
    constexpr std::size_t longest = 1000;
    const std::string quoted =
        name.size() <= longest ? "\"" + with_escaped_bytes(name) + "\"" : in_quotes(name);
    throw FileError(file_, 0, "names the file " + quoted + ", which " + fault);
  }

  static Path resolved(const Path& at) {
    std::error_code unresolved;
    Path there = std::filesystem::weakly_canonical(at.empty() ? "." : at, unresolved);
    return unresolved ? Path() : there;
  }

  /// Whether this is a regular file in the folder, by its path and where links lead.
  bool is_inside(const char* name) const {
    const Path there = resolved(name);
    std::error_code unknown;
    if (!std::filesystem::is_regular_file(there, unknown)) return false;
    return std::any_of(folders_.begin(), folders_.end(), [&](const Path& folder) {
      const Path inside = there.lexically_relative(folder);
      return !folder.empty() && !inside.empty() && *inside.begin() != "..";
    });
  }

  static Assimp::IOStream* stream_of(std::string_view bytes) {
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                      bytes.size());
  }

  std::string_view bytes_;
  std::string file_;
  std::array<Path, 2> folders_;
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

/// The frame of a node in the mesh: its pose, and the bound of coordinates on the way.
struct Frame {
  Eigen::Matrix4d pose = Eigen::Matrix4d::Identity();
  int nodes = 0;      ///< from the root to this one
  double gain = 1;    ///< the product of the norms of the nodes' linear parts
  double offset = 0;  ///< the sum of the lengths of the nodes' translations, in the mesh

  Frame child(const Eigen::Matrix4d& transform) const {
    return {.pose = pose * transform,
            .nodes = nodes + 1,
            .gain = gain * transform.topLeftCorner<3, 3>().operatorNorm(),
            .offset = offset + gain * transform.topRightCorner<3, 1>().norm()};
  }

  /// A bound of the error of a corner of single precision: each node adds a few roundings of
  /// coordinates that are at most gain |corner| + offset.
  double rounding(double corner) const {
    constexpr double each = 16 * static_cast<double>(std::numeric_limits<float>::epsilon());
    return each * (nodes + 1) * (gain * corner + offset);
  }
};

/// What is read of a file.
struct Mesh {
  TriangleCorners corners;
  double rounding = 0;  ///< bound of the errors of all corners
  std::size_t visits = 0;
};

/// Adds the corners of the faces of a mesh. Points and lines are no surface.
void add_corners(const aiMesh& mesh, const Frame& frame, const std::string& file, Mesh& found) {
  double farthest = 0;
  for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
    const aiFace& face = mesh.mFaces[f];
    if (face.mNumIndices < 3) continue;
    found.visits += face.mNumIndices;
    if (found.visits > max_visits)
      throw FileError(file, 0, "has too many triangles; reduce the mesh");
    for (unsigned i = 0; i < face.mNumIndices; ++i) {
      if (face.mIndices[i] >= mesh.mNumVertices) {
        throw FileError(file, 0, "has a face with a vertex that is not there");
      }
      const aiVector3D& at = mesh.mVertices[face.mIndices[i]];
      const Vector3 inner(at.x, at.y, at.z);
      const Vector3 corner = (frame.pose * inner.homogeneous()).head<3>();
      if (!corner.allFinite()) {
        throw FileError(file, 0, "has a coordinate that is not a finite number");
      }
      farthest = std::max(farthest, inner.norm());
      found.corners.add(corner);
    }
  }
  const double rounding = frame.rounding(farthest);
  if (!std::isfinite(rounding)) throw FileError(file, 0, "has coordinates that are too large");
  found.rounding = std::max(found.rounding, rounding);
}

Mesh mesh_of(const aiScene& scene, const std::string& file) {
  Mesh found{.corners = TriangleCorners(file)};
  std::vector<std::pair<const aiNode*, Frame>> open;
  if (scene.mRootNode != nullptr) open.emplace_back(scene.mRootNode, Frame());
  while (!open.empty()) {
    const auto [node, parent] = open.back();
    open.pop_back();
    const Frame frame = parent.child(matrix_of(node->mTransformation));
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      if (node->mMeshes[i] >= scene.mNumMeshes) {
        throw FileError(file, 0, "has a node with a mesh that is not there");
      }
      add_corners(*scene.mMeshes[node->mMeshes[i]], frame, file, found);
    }
    if (++found.visits > max_visits) {
      throw FileError(file, 0, "has too many nodes; reduce the mesh");
    }
    for (unsigned i = 0; i < node->mNumChildren; ++i) open.emplace_back(node->mChildren[i], frame);
  }
  return found;
}

/// Rethrows what is not an exception of assimp's, whose message is in the importer.
void rethrow_own(const std::exception_ptr& fault) {
  try {
    if (fault) std::rethrow_exception(fault);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const FileError&) {
    throw;
  } catch (...) {  // has a message
  }
}

/// Returns the bytes of Mesh::rounding and of the corners.
std::string read_scene_corners(std::string_view bytes, const std::string& file) {
  Assimp::Importer importer;
  importer.SetIOHandler(new MeshFolder(bytes, file));  // which the importer owns
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_NO_SKELETON_MESHES, true);  // of nodes without meshes
  keep_reader(importer, extension(file) == "dae" ? "Collada Importer" : "glTF2 Importer");
  const aiScene* const scene = importer.ReadFile(file, 0);
  if (scene == nullptr) {
    rethrow_own(importer.GetException());
    throw FileError(file, 0, "cannot be read: " + printable(importer.GetErrorString()));
  }
  Mesh mesh = mesh_of(*scene, file);
  const std::vector<Vector3> corners = mesh.corners.take();
  std::string answer(sizeof mesh.rounding + corners.size() * sizeof(Vector3), '\0');
  std::memcpy(answer.data(), &mesh.rounding, sizeof mesh.rounding);
  std::memcpy(answer.data() + sizeof mesh.rounding, static_cast<const void*>(corners.data()),
              corners.size() * sizeof(Vector3));
  return answer;
}

/// A link in a file may lead the reader in circles: it reads in a process of its own.
std::vector<Vector3> read_isolated(std::string_view bytes, const std::string& file,
                                   double& rounding) {
  std::optional<std::string> answer;
  try {
    answer = in_child_process([&] { return read_scene_corners(bytes, file); }, child_limits);
  } catch (const Error& error) {
    throw FileError(file, 0, error.what());
  }
  if (!answer || answer->size() < sizeof rounding ||
      (answer->size() - sizeof rounding) % sizeof(Vector3) != 0) {
    throw FileError(file, 0,
                    "cannot be read: the reader (assimp) crashed, or needed more than 4 GiB or "
                    "2 minutes; convert the mesh to STL or OBJ");
  }
  std::memcpy(&rounding, answer->data(), sizeof rounding);
  std::vector<Vector3> corners((answer->size() - sizeof rounding) / sizeof(Vector3));
  std::memcpy(static_cast<void*>(corners.data()), answer->data() + sizeof rounding,
              corners.size() * sizeof(Vector3));
  return corners;
}

}  // namespace

std::vector<Vector3> mesh_from_scene_file(ByteBlocks& bytes, double& rounding) {
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
  return read_isolated(whole, bytes.path(), rounding);
}

}  // namespace beeline::internal
