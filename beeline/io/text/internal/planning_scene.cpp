#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <unordered_set>
#include <utility>

#include <beeline/error.h>
#include <beeline/io/text/internal/collision_matrix.h>
#include <beeline/io/text/internal/mesh_hull.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/planning_scene.h>
#include <beeline/io/text/internal/ros_message.h>
#include <beeline/io/text/internal/ros_shapes.h>

namespace beeline::internal {
namespace {

/// The kinds of shape_msgs/SolidPrimitive, from 1, and their dimensions.
struct Primitive {
  std::string name;
  std::size_t dimensions;
};
const std::array<Primitive, 4> primitives{
    {{"box", 3}, {"sphere", 1}, {"cylinder", 2}, {"cone", 2}}};

/// Reads the objects of a message; frames are given by name, with their poses in the world.
class ObjectReader {
 public:
  ObjectReader(const std::string& path, const ShapeOptions& options)
      : path_(path),
        meshes_(path, options.package),
        frames_(options.frames),
        moving_frames_(options.moving_frames) {}

  /// Adds the frames of `fixed_frame_transforms` whose parent is known.
  void add_frames(const RosMessage& scene) {
    for (const RosMessage& stamped : scene.items("fixed_frame_transforms")) {
      stamped.check_keys({"header", "child_frame_id", "transform"});
      const auto parent = frames_.find(frame_id(stamped));
      const RosMessage child = stamped.need("child_frame_id");
      const Pose pose = stamped.need("transform").pose("translation", "rotation");
      if (parent == frames_.end()) {
        if (moves(frame_id(stamped))) moving_frames_.push_back(without_slash(child.text()));
        continue;
      }
      const auto [known, is_new] =
          frames_.emplace(without_slash(child.text()), parent->second * pose);
      if (is_new || known->second.isApprox(parent->second * pose, 1e-9)) continue;
      child.refuse("is " + in_quotes(child.text()) + ", whose pose is known, and another one");
    }
  }

  Obstacle read(const RosMessage& object) {
    object.check_keys({"header", "pose", "id", "type", "primitives", "primitive_poses", "meshes",
                       "mesh_poses", "planes", "plane_poses", "subframe_names", "subframe_poses",
                       "operation"});
    const RosMessage id = object.need("id");
    Obstacle obstacle{.name = id.text()};
    try {
      check_name(obstacle.name, "the id");
    } catch (const Error& error) {
      id.refuse(std::string("is no name: ") + error.what());
    }
    if (!names_.insert(obstacle.name).second) {
      id.refuse("is " + in_quotes(obstacle.name) + ", which another object has");
    }
    if (const auto operation = object.find("operation")) {
      const std::string& kind = operation->text();
      // The message has a byte, which some programs write as a character.
      if (kind != "0" && kind != "ADD" && kind != "add" && kind != std::string(1, '\0')) {
        operation->refuse("is " + in_quotes(kind) + "; objects of a whole scene are added (0)");
      }
    }
    Pose pose = frame_of(object);
    if (const auto own = object.find("pose")) pose = pose * own->pose("position", "orientation");
    add(obstacle, object, pose, "primitives", "primitive_poses",
        [&](const RosMessage& shape) { return primitive(shape); });
    add(obstacle, object, pose, "meshes", "mesh_poses",
        [&](const RosMessage& shape) { return mesh(shape); });
    add(obstacle, object, pose, "planes", "plane_poses", [](const RosMessage& shape) {
      shape.check_keys({"coef"});
      const std::vector<double> c = shape.need("coef").numbers({"a", "b", "c", "d"});
      return plane(c[0], c[1], c[2], c[3]);
    });
    if (obstacle.shapes.empty()) object.refuse("has no shapes; types of a database are not read");
    return obstacle;
  }

 private:
  /// Returns a name without the slash of tf's first version.
  static std::string without_slash(const std::string& name) {
    return name.starts_with('/') ? name.substr(1) : name;
  }

  /// Returns the name of the frame in the header.
  static std::string frame_id(const RosMessage& stamped) {
    const auto header = stamped.find("header");
    const auto frame = header ? header->find("frame_id") : std::nullopt;
    if (!frame) return "";
    return without_slash(frame->text());
  }

  /// Whether a frame moves with the arm's base.
  bool moves(const std::string& frame) const {
    return std::find(moving_frames_.begin(), moving_frames_.end(), frame) != moving_frames_.end();
  }

  Pose frame_of(const RosMessage& object) const {
    const std::string name = frame_id(object);
    const auto frame = frames_.find(name);
    if (frame != frames_.end()) return frame->second;
    if (moves(name)) {
      object.refuse("is in the frame " + in_quotes(name) +
                    ", which moves with the arm's base; give its pose in the world");
    }
    std::vector<std::string> known;
    for (const auto& [any, pose] : frames_) {
      if (!any.empty()) known.push_back(any);
    }
    object.refuse("is in the frame " + in_quotes(name) +
                  ", whose pose in the world is not known; known frames: " + listed(known) +
                  ", and others by frames={\"" + printable(name) + "\": POSE}");
  }

  /// Adds the shapes of a list, each with its pose in the other list.
  template <class Read>
  static void add(Obstacle& obstacle, const RosMessage& object, const Pose& frame,
                  std::string_view key, std::string_view poses_key, const Read& read) {
    const std::vector<RosMessage> shapes = object.items(key), poses = object.items(poses_key);
    if (shapes.size() != poses.size() && !(shapes.size() == 1 && poses.empty())) {
      object.refuse("has " + std::to_string(shapes.size()) + " " + std::string(key) + " and " +
                    std::to_string(poses.size()) + " " + std::string(poses_key) +
                    "; there must be one for each");
    }
    for (std::size_t i = 0; i < shapes.size(); ++i) {
      const Pose pose = poses.empty() ? Pose::Identity() : poses[i].pose("position", "orientation");
      try {
        Shape shape = read(shapes[i]);
        shape.pose = frame * pose * shape.pose;
        check_shape(shape);
        obstacle.shapes.push_back(std::move(shape));
      } catch (const FileError&) {
        throw;
      } catch (const Error& error) {
        shapes[i].refuse(std::string("is no shape: ") + error.what());
      }
    }
  }

  static Shape primitive(const RosMessage& shape) {
    shape.check_keys({"type", "dimensions", "polygon"});
    const RosMessage type = shape.need("type");
    std::size_t kind = 0;
    while (kind < primitives.size() && type.text() != primitives[kind].name &&
           type.text() != std::to_string(kind + 1)) {
      ++kind;
    }
    if (kind == primitives.size()) {
      type.refuse("is " + in_quotes(type.text()) +
                  "; it must be 1 (box), 2 (sphere), 3 (cylinder) or 4 (cone)");
    }
    const RosMessage dimensions = shape.need("dimensions");
    const std::vector<double> d = dimensions.numbers();
    if (d.size() != primitives[kind].dimensions) {
      dimensions.refuse("has " + std::to_string(d.size()) + " numbers; a " + primitives[kind].name +
                        " has " + std::to_string(primitives[kind].dimensions));
    }
    switch (kind) {
      case 0:
        return {.body = Box{{d[0], d[1], d[2]}}};
      case 1:
        return {.body = Sphere{d[0]}};
      case 2:
        return {.body = Cylinder{d[1], d[0]}};
      default:
        return cone(d[1], d[0]);
    }
  }

  /// A mesh of corners or, as in files of Robowflex, of a file that `resource` names.
  Shape mesh(const RosMessage& shape) {
    shape.check_keys({"triangles", "vertices", "resource", "dimensions"});
    if (const auto resource = shape.find("resource")) {
      const auto scale = shape.find("dimensions");
      return meshes_.read(resource->text(), scale ? scale->vector() : Vector3::Ones());
    }
    std::vector<Vector3> corners;
    for (const RosMessage& vertex : shape.items("vertices")) corners.push_back(vertex.vector());
    if (corners.empty()) shape.refuse("has no vertices");
    return hull_of_corners(std::move(corners), path_);
  }

  const std::string& path_;
  MeshHulls meshes_;
  std::map<std::string, Pose> frames_;
  std::vector<std::string> moving_frames_;
  std::unordered_set<std::string> names_;
};

/// Refuses what would change the meaning of a proof and is not read.
void refuse_others(const RosMessage& scene) {
  scene.check_keys({"name", "robot_state", "robot_model_name", "fixed_frame_transforms",
                    "allowed_collision_matrix", "link_padding", "link_scale", "object_colors",
                    "world", "is_diff"});
  if (const auto diff = scene.find("is_diff"); diff && diff->boolean()) {
    diff->refuse("is true: the file changes another scene; export the whole scene");
  }
  if (const auto state = scene.find("robot_state")) {
    const std::vector<RosMessage> attached = state->items("attached_collision_objects");
    if (!attached.empty()) attached[0].refuse("is an attached object, which is not read");
  }
  const RosMessage world = scene.need("world");
  world.check_keys({"collision_objects", "octomap"});
  const auto octomap = world.find("octomap");
  const auto map = octomap ? octomap->find("octomap") : std::nullopt;
  if (map && !map->items("data").empty()) map->refuse("is an octree, which is not read");
  const auto refuse_other = [&](std::string_view list, std::string_view key, double usual) {
    for (const RosMessage& entry : scene.items(list)) {
      const auto value = entry.find(key);
      if (value && value->number() != usual) {
        value->refuse("is not applied; set it to " + number(usual) + ", and choose a clearance");
      }
    }
  };
  refuse_other("link_padding", "padding", 0);
  refuse_other("link_scale", "scale", 1);
}

}  // namespace

Scene planning_scene(const Yaml& yaml, const std::string& path, const ShapeOptions& options) {
  if (!std::holds_alternative<Yaml::Members>(yaml.value)) {
    throw FileError(path, yaml.line, "is no message PlanningScene: it must be a map with world");
  }
  const RosMessage message(yaml, path);
  refuse_others(message);
  ObjectReader reader(path, options);
  reader.add_frames(message);
  Scene scene;
  for (const RosMessage& object : message.need("world").items("collision_objects")) {
    scene.obstacles.push_back(reader.read(object));
  }
  if (const auto matrix = message.find("allowed_collision_matrix")) {
    scene.exempted_pairs = exempted_pairs(*matrix, scene);
  }
  return scene;
}

}  // namespace beeline::internal
