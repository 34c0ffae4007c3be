#include <unordered_set>

#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/arm_format.h>
#include <beeline/io/text/internal/json_write.h>
#include <beeline/io/text/internal/moveit_scene.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/name_json.h>
#include <beeline/io/text/internal/planning_scene.h>
#include <beeline/io/text/internal/point_cloud.h>
#include <beeline/io/text/internal/shape_json.h>
#include <beeline/io/text/internal/yaml.h>
#include <beeline/io/text/numbers.h>
#include <beeline/io/text/scene.h>
#include <beeline/io/text/urdf.h>

namespace beeline {
namespace {

/// Of a message of MoveIt.
constexpr internal::YamlBounds message_bounds{.bytes = std::size_t{1} << 24, .values = 1'000'000};

Obstacle obstacle_from_json(const JsonDocument& document, const Json& json) {
  document.check_keys(json, {"name", "clearance", "shapes", "point_cloud"});
  Obstacle obstacle;
  obstacle.name = internal::name_from_json(document, document.need(json, "name"));
  if (const Json* clearance = document.find(json, "clearance")) {
    obstacle.clearance = document.number(*clearance);
    try {
      check_clearance(*obstacle.clearance);
    } catch (const Error& error) {
      document.refuse(*clearance, std::string("is ") + error.what());
    }
  }
  if (const Json* cloud = document.find(json, "point_cloud")) {
    obstacle.cloud = internal::cloud_from_json(document, *cloud);
    if (document.find(json, "shapes") == nullptr) return obstacle;
  }
  obstacle.shapes = internal::shapes_from_json(document, json);
  if (obstacle.shapes.empty() && !obstacle.cloud)
    document.refuse(document.need(json, "shapes"), "has no shape");
  return obstacle;
}

NamedPair pair_from_json(const JsonDocument& document, const Json& json) {
  const Json::Items& names = document.items(json);
  if (names.size() != 2) document.refuse(json, "must be two names");
  return {internal::name_from_json(document, names[0]),
          internal::name_from_json(document, names[1])};
}

std::vector<NamedPair> pairs_from_json(const JsonDocument& document, const std::string& key) {
  std::vector<NamedPair> pairs;
  if (const Json* list = document.find(document.root(), key)) {
    for (const Json& pair : document.items(*list)) pairs.push_back(pair_from_json(document, pair));
  }
  return pairs;
}

/// Returns the member of a list of pairs; empty for no pair.
std::string pairs_to_json(const std::string& key, const std::vector<NamedPair>& pairs) {
  std::string text;
  for (const NamedPair& pair : pairs) {
    text += std::string(text.empty() ? "" : ", ") + "[" + internal::json_string(pair[0]) + ", " +
            internal::json_string(pair[1]) + "]";
  }
  return text.empty() ? text : ",\n  \"" + key + "\": [" + text + "]";
}

Scene scene_of(const JsonDocument& document) {
  const Json& root = document.root();
  document.check_keys(root, {"obstacles", "allowed_pairs", "exempted_pairs", "$schema"});
  if (const Json* schema = document.find(root, "$schema")) document.text(*schema);
  Scene scene;
  std::unordered_set<std::string> names;
  for (const Json& item : document.items(document.need(root, "obstacles"))) {
    scene.obstacles.push_back(obstacle_from_json(document, item));
    const std::string& name = scene.obstacles.back().name;
    if (!names.insert(name).second) {
      document.refuse(item, "has the name " + internal::in_quotes(name) + " of another obstacle");
    }
  }
  scene.allowed_pairs = pairs_from_json(document, "allowed_pairs");
  scene.exempted_pairs = pairs_from_json(document, "exempted_pairs");
  return scene;
}

/// Returns the frames that a scene of MoveIt may name. "" is the planning frame: the world where no
/// frames are given. "world" is the planning frame, too, unless it has a pose of its own.
std::map<std::string, Pose> moveit_frames(std::map<std::string, Pose> given) {
  if (given.empty()) given.emplace("", Pose::Identity());
  const auto planning = given.find("");
  if (planning != given.end()) given.try_emplace("world", planning->second);
  return given;
}

}  // namespace

Scene scene_from_json(std::string_view text, const std::string& path) {
  return scene_of(JsonDocument(text, path));
}

Scene scene_from_text(std::string_view text, const std::string& path, const ShapeOptions& options) {
  if (is_cloud_path(path)) return internal::cloud_scene(text, path, options.radius);
  if (options.radius) throw internal::no_cloud(path);
  if (has_link_tree_ending(path)) return scene_from_urdf(text, path, options);
  if (!options.hold.empty()) {
    throw Error::of("hold", "only a URDF file has joints that can be held; " + path + " has none");
  }
  const ShapeOptions in_moveit{.package = options.package,
                               .frames = moveit_frames(options.frames),
                               .moving_frames = options.moving_frames};
  const std::string ending = extension(path);
  if (ending == "scene") {
    const auto planning = in_moveit.frames.find("");
    if (planning != in_moveit.frames.end()) {
      return internal::moveit_scene(text, path, planning->second);
    }
    throw FileError(path, 0, "is posed in MoveIt's planning frame, whose pose is not known");
  }
  if (ending == "yaml" || ending == "yml") {
    return internal::planning_scene(internal::parse_yaml(text, path, message_bounds), path,
                                    in_moveit);
  }
  if (ending != "json" && !ending.empty()) {
    std::vector<std::string> endings = internal::known_endings();
    for (const char* of_scenes : {".scene", ".yaml", ".yml", ".ply", ".npy"}) {
      endings.emplace_back(of_scenes);
    }
    throw FileError(path, 0, "is not a known kind of scene; known are " + listed(endings));
  }
  const JsonDocument document(text, path);
  const bool is_message = document.find(document.root(), "world") != nullptr &&
                          document.find(document.root(), "obstacles") == nullptr;
  if (!is_message) return scene_of(document);
  return internal::planning_scene(internal::as_yaml(document.root()), path, in_moveit);
}

Scene read_scene(const std::string& path, const ShapeOptions& options) {
  if (is_cloud_path(path)) return internal::read_cloud_scene(path, options.radius);
  return scene_from_text(read_file(path), path, options);
}

std::string visual_links_note(const std::string& path, const std::vector<std::string>& links) {
  return path + ": links with <visual> and without <collision> are no obstacles: " + listed(links);
}

std::string far_obstacles_note(const std::vector<std::string>& names) {
  return "obstacles farther away than ten times the arm's reach, or larger than a hundred times, "
         "probably in millimetres: " +
         listed(names);
}

std::string scene_to_json(const Scene& scene) {
  std::string text = "{\n  \"obstacles\": [";
  bool first = true;
  for (const Obstacle& obstacle : scene.obstacles) {
    internal::check_name(obstacle.name, "the name of an obstacle");
    if (obstacle.shapes.empty() && !obstacle.cloud) {
      throw Error("the obstacle " + internal::in_quotes(obstacle.name) + " has no shape");
    }
    text += first ? "\n    {\"name\": " : ",\n    {\"name\": ";
    first = false;
    text += internal::json_string(obstacle.name);
    if (obstacle.clearance) text += ", \"clearance\": " + exact(*obstacle.clearance);
    if (obstacle.cloud) text += ", \"point_cloud\": " + internal::cloud_to_json(*obstacle.cloud);
    if (obstacle.shapes.empty()) {
      text += "}";
      continue;
    }
    text += ", \"shapes\": [";
    for (std::size_t i = 0; i < obstacle.shapes.size(); ++i) {
      text += (i == 0 ? "\n      " : ",\n      ") + internal::shape_to_json(obstacle.shapes[i]);
    }
    text += "]}";
  }
  text += first ? "]" : "\n  ]";
  text += pairs_to_json("allowed_pairs", scene.allowed_pairs);
  text += pairs_to_json("exempted_pairs", scene.exempted_pairs);
  return text + "\n}\n";
}

}  // namespace beeline
