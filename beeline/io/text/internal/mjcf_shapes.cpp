#include <algorithm>
#include <filesystem>
#include <tinyxml2.h>
#include <unordered_map>
#include <unordered_set>

#include <beeline/error.h>
#include <beeline/io/text/internal/mesh_hull.h>
#include <beeline/io/text/internal/mjcf_file.h>
#include <beeline/io/text/internal/mjcf_shapes.h>
#include <beeline/io/text/internal/name.h>

namespace beeline::internal {
namespace {

using tinyxml2::XMLElement;

/// The meshes of `<asset>`, by name.
class MjcfMeshes {
 public:
  MjcfMeshes(const MjcfModel& model, const std::map<std::string, std::string>& package)
      : model_(model), hulls_(model.file.path, package) {
    for (const XMLElement* at : model.document.in_sections("asset", "mesh")) {
      refuse_misspelt_attribute(
          *at, {"builtin", "class", "content_type", "face", "file", "inertia", "material",
                "maxhullvert", "name", "normal", "params", "refpos", "refquat", "scale",
                "smoothnormal", "texcoord", "vertex"});
      const char* const name = at->Attribute("name");
      const char* const file = at->Attribute("file");
      const std::string own = name != nullptr   ? name
                              : file != nullptr ? std::filesystem::path(file).stem().string()
                                                : "";
      if (meshes_.emplace(own, at).second) continue;
      MjcfDocument::reader_of(*at).refuse(at->GetLineNum(),
                                          "two meshes have the name " + printable(own));
    }
  }

  /// Returns the hull in the frame of the geom.
  Shape shape(const MjcfAttributes& geom) {
    const std::string name = geom.text_or("mesh", "");
    const auto found = meshes_.find(name);
    if (found == meshes_.end()) {
      std::vector<std::string> known;
      for (const auto& [known_name, unused] : meshes_) known.push_back(known_name);
      geom.refuse("mesh", unknown_name("mesh", printable(name), known).what());
    }
    const XMLElement& element = *found->second;
    const auto known = shapes_.find(&element);
    if (known != shapes_.end()) return known->second;
    const MjcfAttributes mesh(element, &model_.defaults,
                              model_.defaults.class_of(element, "class", MjcfDefaults::main_class));
    const Vector3 scale = mesh.vector("scale", Vector3::Ones());
    Shape shape;
    try {
      shape = hull(mesh, scale);
    } catch (const FileError&) {
      throw;
    } catch (const Error& error) {
      MjcfDocument::reader_of(element).refuse(element.GetLineNum(), error.what());
    }
    shape.pose = pose_of_file(mesh, scale);
    return shapes_.emplace(&element, std::move(shape)).first->second;
  }

 private:
  Shape hull(const MjcfAttributes& mesh, const Vector3& scale) {
    const XMLElement& element = mesh.element();
    if (mesh.source("builtin") != nullptr) mesh.refuse("builtin", "is not supported");
    if (mesh.source("file") != nullptr) return hulls_.read(path_of_file(mesh), scale);
    if (mesh.source("vertex") == nullptr) throw Error("the mesh has neither file nor vertex");
    const std::vector<double> numbers = MjcfDocument::reader_of(element).numbers(element, "vertex");
    if (numbers.empty() || numbers.size() % 3 != 0) {
      mesh.refuse("vertex", "has " + std::to_string(numbers.size()) +
                                " numbers; it must have three of each vertex");
    }
    std::vector<Vector3> corners;
    for (std::size_t i = 0; i < numbers.size(); i += 3) {
      corners.push_back(scale.cwiseProduct(Vector3(numbers[i], numbers[i + 1], numbers[i + 2])));
    }
    return hull_of_corners(std::move(corners), model_.file.path);
  }

  /// The path, relative to the folder of the model unless it is absolute.
  std::string path_of_file(const MjcfAttributes& mesh) const {
    std::filesystem::path file = mesh.text_or("file", "");
    if (model_.settings.strip_path) file = file.filename();
    return (std::filesystem::path(model_.settings.mesh_folder) / file).string();
  }

  /// The pose of the scaled corners. MuJoCo moves the corners by -refpos, rotates them by the
  /// inverse of refquat and scales them at last.
  static Pose pose_of_file(const MjcfAttributes& mesh, const Vector3& scale) {
    const Vector3 position = mesh.vector("refpos", Vector3::Zero());
    const std::vector<double> q = mesh.numbers("refquat", 4);
    if (q.empty()) return make_pose(-scale.cwiseProduct(position));
    const Eigen::Quaterniond turn(q[0], q[1], q[2], q[3]);
    const double length = turn.norm();
    if (!(length > 1e-10) || length > 1e10) mesh.refuse("refquat", "has no direction");
    if (scale.minCoeff() != scale.maxCoeff()) {
      mesh.refuse("refquat",
                  "is given beside a scale that differs by axis, which is not supported");
    }
    const Rotation back = turn.normalized().toRotationMatrix().transpose();
    return make_pose(back * Vector3(-scale.cwiseProduct(position)), back);
  }

  const MjcfModel& model_;
  MeshHulls hulls_;
  std::map<std::string, const XMLElement*> meshes_;
  std::unordered_map<const XMLElement*, Shape> shapes_;  // hulls of large meshes take a second
};

/// Whether a geom takes part in collisions; the others are visible only.
bool collides(const MjcfAttributes& geom) {
  return geom.number_or("contype", 1) != 0 || geom.number_or("conaffinity", 1) != 0;
}

/// Refuses a type of geom that is not read.
[[noreturn]] void refuse_type(const MjcfAttributes& geom, const std::string& type,
                              const std::string& link) {
  const std::string advice =
      type == "plane" ? "as in MuJoCo, only bodies that do not move have planes"
                      : "replace it by sphere, capsule, cylinder, box or mesh, or set contype and "
                        "conaffinity to 0 if it does not collide";
  geom.refuse("type", "is " + type + ", in body " + link +
                          ", which is not supported for collisions; " + advice);
}

void read_body(const MjcfAttributes& geom, const std::string& link, MjcfUse use, MjcfMeshes& meshes,
               Shape& shape) {
  const std::string type = geom.choice(
      "type",
      {"plane", "hfield", "sphere", "capsule", "ellipsoid", "cylinder", "box", "mesh", "sdf"},
      "sphere");
  if (type == "mesh") {
    shape = meshes.shape(geom);
    return;
  }
  if (geom.source("mesh") != nullptr) {
    geom.refuse("mesh", "is given beside type " + type +
                            ": a shape that is fitted to a mesh is not supported");
  }
  const std::vector<double> size = geom.some_numbers("size", {0, 0, 0});
  const bool has_ends = geom.source("fromto") != nullptr;
  double half_length = size[1];
  if (has_ends) {
    const MjcfEnds ends = mjcf_ends(geom);
    half_length = (ends.to / 2 - ends.from / 2).norm();
    if (type == "sphere" || type == "plane") geom.refuse("fromto", "is given of a " + type);
  }
  const std::size_t needed = type == "sphere" || has_ends ? 1 : type == "box" ? 3 : 2;
  const bool is_sized = type != "plane" && type != "hfield" && type != "sdf";
  for (std::size_t i = 0; i < needed && is_sized; ++i) {
    if (!(size[i] > 0)) {
      geom.refuse("size", "needs " + std::to_string(needed) + " positive numbers of a " + type);
    }
  }
  if (type == "sphere") {
    shape.body = Sphere{size[0]};
  } else if (type == "capsule") {
    shape.body = Capsule{size[0], 2 * half_length};
  } else if (type == "cylinder") {
    shape.body = Cylinder{size[0], 2 * half_length};
  } else if (type == "box") {
    shape.body = Box{2 * (has_ends ? Vector3(size[0], size[0], half_length)
                                   : Vector3(size[0], size[1], size[2]))};
  } else if (type == "plane" && use == MjcfUse::obstacles) {
    shape.body = HalfSpace{};
  } else {
    refuse_type(geom, type, link);
  }
}

Shape read_shape(const MjcfModel& model, const MjcfGeom& read, const MjcfAttributes& geom,
                 MjcfUse use, MjcfMeshes& meshes) {
  Shape shape;
  read_body(geom, model.file.links[read.link].name, use, meshes, shape);
  shape.pose = read.frame * mjcf_pose(geom, model.settings) * shape.pose;
  try {
    check_shape(shape);
  } catch (const Error& error) {
    MjcfDocument::reader_of(geom.element())
        .refuse(geom.line(),
                "the <geom> of body " + model.file.links[read.link].name + ": " + error.what());
  }
  return shape;
}

/// The bodies that no joint moves.
std::unordered_set<std::string> static_links(const UrdfFile& file) {
  std::unordered_set<std::string> found{file.links.front().name};
  for (const UrdfFile::Joint& joint : file.joints) {  // each behind the joints above it
    if (joint.type == "fixed" && found.contains(joint.parent)) found.insert(joint.child);
  }
  return found;
}

/// Returns the pairs of `<contact><exclude>` after those that several joints connect.
std::vector<NamedPair> pairs_that_may_touch(const MjcfModel& model) {
  std::unordered_set<std::string> links;
  for (const UrdfFile::Link& link : model.file.links) links.insert(link.name);
  std::vector<NamedPair> pairs = model.touching;
  for (const XMLElement* at : model.document.in_sections("contact", "exclude")) {
    const XmlElements& reader = MjcfDocument::reader_of(*at);
    NamedPair pair;
    for (std::size_t i = 0; i < 2; ++i) {
      const char* const attribute = i == 0 ? "body1" : "body2";
      pair[i] = with_escaped_bytes(reader.needed_text(*at, attribute));
      if (links.contains(pair[i])) continue;
      reader.refuse(at->GetLineNum(), "<exclude>: " + std::string(attribute) + " " +
                                          in_quotes(pair[i]) + " is no body of the file");
    }
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace

UrdfShapes mjcf_shapes(std::string_view text, const std::string& path,
                       const std::map<std::string, std::string>& package, MjcfUse use) {
  const std::unique_ptr<const MjcfModel> model = read_mjcf(text, path);
  MjcfMeshes meshes(*model, package);
  UrdfShapes shapes;
  shapes.may_touch = pairs_that_may_touch(*model);
  std::unordered_set<std::string> visible, planes;
  const std::unordered_set<std::string> is_static = static_links(model->file);
  for (const MjcfGeom& read : model->geoms) {
    refuse_misspelt_attribute(
        *read.element,
        {"adhesion", "axisangle",  "castshadow",   "class",    "conaffinity", "condim",
         "contype",  "density",    "euler",        "fitscale", "fluidcoef",   "fluidshape",
         "friction", "fromto",     "gap",          "group",    "hfield",      "margin",
         "mass",     "material",   "mesh",         "name",     "pos",         "priority",
         "quat",     "rgba",       "shellinertia", "size",     "solimp",      "solmix",
         "solref",   "surfacevel", "type",         "user",     "xyaxes",      "zaxis"});
    const std::string& link = model->file.links[read.link].name;
    const MjcfAttributes geom(*read.element, &model->defaults, read.of_class);
    if (!collides(geom)) {
      visible.insert(link);
    } else if (use == MjcfUse::links && geom.text_or("type", "") == "plane" &&
               is_static.contains(link)) {
      if (planes.insert(link).second) shapes.planes.push_back(link);
    } else {
      shapes.of_link[link].push_back(read_shape(*model, read, geom, use, meshes));
    }
  }
  for (const UrdfFile::Link& link : model->file.links) {
    if (visible.contains(link.name) && !shapes.of_link.contains(link.name)) {
      shapes.only_visual.push_back(link.name);
    }
  }
  return shapes;
}

}  // namespace beeline::internal
