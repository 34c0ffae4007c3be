#include "scene_argument.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include <beeline/error.h>
#include <beeline/io/text/numbers.h>
#include <beeline/io/text/scene.h>
#include <beeline/io/text/urdf.h>

#include "command/streams.h"

namespace beeline::command {
namespace {

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The pair of "A,B". A name may have a comma: the pair is divided at the first one that leaves two
/// known names.
NamedPair allowed_pair(const std::string& text, const std::vector<std::string>& known) {
  const std::size_t first = text.find(',');
  if (first == std::string::npos) throw Error("must be two names, A,B, not " + text);
  for (std::size_t at = first; at != std::string::npos; at = text.find(',', at + 1)) {
    NamedPair pair{text.substr(0, at), text.substr(at + 1)};
    if (is_among(known, pair[0]) && is_among(known, pair[1])) return pair;
  }
  const std::string before = text.substr(0, first);
  throw unknown_name("link or obstacle", is_among(known, before) ? text.substr(first + 1) : before,
                     known);
}

/// The values of "JOINT=VALUE".
std::map<std::string, double> held_values(const std::vector<std::string>& texts) {
  std::map<std::string, double> held;
  for (const std::string& text : texts) {
    const std::size_t equals = text.rfind('=');
    if (equals == std::string::npos || equals == 0) {
      throw Error("--hold must be JOINT=VALUE, not " + text);
    }
    const std::string joint = text.substr(0, equals);
    if (!held.emplace(joint, parse_number(text.substr(equals + 1), "--hold " + joint)).second) {
      throw Error("--hold gives joint " + joint + " two values");
    }
  }
  return held;
}

/// The folders of "NAME=FOLDER".
std::map<std::string, std::string> package_folders(const std::vector<std::string>& texts) {
  std::map<std::string, std::string> folders;
  for (const std::string& text : texts) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
      throw Error("--package must be NAME=FOLDER, not " + text);
    }
    const std::string name = text.substr(0, equals);
    if (!folders.emplace(name, text.substr(equals + 1)).second) {
      throw Error("--package gives package " + name + " two folders");
    }
  }
  return folders;
}

/// A scene and its file.
struct SceneFile {
  std::string path;
  Scene scene;
};

/// Reads the URDF files among the scenes. Their joints take their values from options.hold, which
/// keeps the names that no scene has.
void read_cells(std::vector<SceneFile>& files, ShapeOptions& options) {
  std::map<std::string, double> remaining = options.hold;
  for (SceneFile& file : files) {
    if (!has_link_tree_ending(file.path)) continue;
    ShapeOptions of_file{.package = options.package};
    file.scene = read_scene(file.path, of_file);
    for (const auto& [joint, value] : options.hold) {
      if (file.scene.held.contains(joint)) of_file.hold.emplace(joint, value);
    }
    if (!of_file.hold.empty()) {
      file.scene = for_option("--hold", [&] { return read_scene(file.path, of_file); });
    }
    for (const auto& [joint, value] : of_file.hold) remaining.erase(joint);
  }
  options.hold = std::move(remaining);
}

/// Reads the other scenes. Their frames are the links of the arm's base, which --mount moves, and
/// MoveIt's planning frame, which it does not: the scene stands in the world. If the mount is not
/// fixed, the planning frame alone.
void read_other_scenes(std::vector<SceneFile>& files, const Arm& arm, const ArmShapes& shapes,
                       ShapeOptions options, bool fixed_mount) {
  const std::optional<double> radius = std::exchange(options.radius, std::nullopt);
  options.hold.clear();
  const auto root = shapes.base_links.find("");
  for (const auto& [link, pose] : shapes.base_links) {
    const bool is_planning_frame =
        link.empty() || (link == "world" && root != shapes.base_links.end() &&
                         pose.matrix() == root->second.matrix());
    if (!is_planning_frame && !fixed_mount) {
      options.moving_frames.push_back(link);
      continue;
    }
    options.frames[link] = is_planning_frame ? pose : arm.base() * pose;
  }
  for (SceneFile& file : files) {
    if (has_link_tree_ending(file.path)) continue;
    if (is_cloud_path(file.path)) {
      const ShapeOptions of_cloud{.radius = radius};
      file.scene = for_option("--radius", [&] { return read_scene(file.path, of_cloud); });
    } else {
      file.scene = read_scene(file.path, options);
    }
  }
}

/// The pairs whose names are both known.
std::vector<NamedPair> pairs_among(std::vector<NamedPair> pairs,
                                   const std::vector<std::string>& known) {
  const std::unordered_set<std::string> names(known.begin(), known.end());
  std::erase_if(pairs, [&](const NamedPair& pair) {
    return !names.contains(pair[0]) || !names.contains(pair[1]);
  });
  return pairs;
}

/// Joins scenes in one. `known` has the names of the links, to which the obstacles' are added.
/// Throws FileError for a name that is given twice, and for an allowed pair of others.
Scene joined(std::vector<SceneFile> files, std::vector<std::string>& known) {
  Scene all;
  std::unordered_set<std::string> taken(known.begin(), known.end());
  std::vector<std::pair<std::string, NamedPair>> pairs;  // with their files
  const std::vector<std::string> links = known;
  for (auto& [path, scene] : files) {
    std::vector<std::string> bodies = links;  // a matrix concerns the scene of its file
    for (Obstacle& obstacle : scene.obstacles) {
      bodies.push_back(obstacle.name);
      if (!taken.insert(obstacle.name).second) {
        throw FileError(path, 0,
                        "has an obstacle \"" + obstacle.name +
                            "\"; a link or an obstacle of another scene has this name");
      }
      known.push_back(obstacle.name);
      all.obstacles.push_back(std::move(obstacle));
    }
    for (const NamedPair& pair : scene.allowed_pairs) pairs.emplace_back(path, pair);
    const std::vector<NamedPair> exempted = pairs_among(std::move(scene.exempted_pairs), bodies);
    all.exempted_pairs.insert(all.exempted_pairs.end(), exempted.begin(), exempted.end());
  }
  for (const auto& [path, pair] : pairs) {
    for (const std::string& name : pair) {
      if (taken.contains(name)) continue;
      throw FileError(
          path, 0,
          std::string("allowed_pairs: ") + unknown_name("link or obstacle", name, known).what());
    }
    all.allowed_pairs.push_back(pair);
  }
  return all;
}

/// The values of the joints of scenes, by file. Throws Error for a joint of --hold that is in the
/// arm too.
std::map<std::string, std::map<std::string, double>> held_in(
    const std::vector<SceneFile>& files, const std::map<std::string, double>& hold,
    const std::map<std::string, double>& held_by_arm) {
  std::map<std::string, std::map<std::string, double>> held;
  for (const auto& [path, scene] : files) {
    if (!scene.held.empty()) held[path] = scene.held;
    for (const auto& [joint, value] : scene.held) {
      if (!hold.contains(joint) || !held_by_arm.contains(joint)) continue;
      throw Error("--hold: both the arm and " + path + " have a joint " + joint +
                  "; rename one of them");
    }
  }
  return held;
}

void add_mesh_hulls(const std::string& body, const std::vector<Shape>& shapes,
                    std::vector<MeshHull>& hulls) {
  for (const Shape& shape : shapes) {
    if (shape.hull_of.empty()) continue;
    hulls.push_back({.body = body,
                     .mesh = shape.hull_of,
                     .vertices = std::get<ConvexHull>(shape.body).vertices.size(),
                     .padding = shape.padding});
  }
}

NoShapesError no_shapes(const std::string& option, const std::string& arm) {
  return NoShapesError(option + ": " + arm +
                       " has no shapes of its links, so no collision could be found; shapes are "
                       "read from the <collision> elements of a .urdf file, or from \"shapes\" in "
                       "an arm file; `beeline show ARM --out FILE.json` writes one to add them to");
}

/// The links of an arm without shapes: those that move, bodies without shapes in its file, and
/// links of a URDF file that are only visible. Links between the joints of a mobile base and a rail
/// have no bodies.
std::vector<std::string> links_without(const Arm& arm, const ArmShapes& read,
                                       const MovingBaseArgument& moving_base) {
  const std::vector<LinkShapes>& shapes = read.links;
  const std::size_t first = std::max<std::size_t>(1, moving_base.joints());
  std::vector<std::string> names;
  for (std::size_t i = first; i <= arm.joints().size(); ++i) {
    const bool has_shapes = std::any_of(shapes.begin(), shapes.end(), [&](const LinkShapes& body) {
      return body.link == i && !body.shapes.empty();
    });
    const Joint& joint = arm.joints()[i - 1];
    if (!has_shapes) names.push_back(joint.link.empty() ? "after " + joint.name : joint.link);
  }
  std::vector<std::string> others = read.links_without_shapes;
  for (const LinkShapes& body : shapes) {
    const bool is_named = body.link > moving_base.joints() && body.at_proximal_joint;  // above
    if (body.shapes.empty() && !is_named) others.push_back(body.name);
  }
  for (const std::string& name : others) {
    if (!is_among(names, name)) names.push_back(name);
  }
  return names;
}

void warn_about(const CheckedScene& scene, const std::vector<std::string>& far) {
  if (!far.empty()) warn(far_obstacles_note(far));
  if (!scene.links_without_shapes.empty()) {
    warn("links without shapes are not checked: " + listed(scene.links_without_shapes));
  }
  for (const auto& [path, links] : scene.scenes_without_shapes) {
    warn(visual_links_note(path, links));
  }
}

}  // namespace

void warn_if_unchecked(const CheckedScene& scene) {
  if (scene.checks_nothing()) warn("no pair of bodies counts: nothing was checked");
}

std::vector<std::string> SceneArgument::inputs() const {
  std::vector<std::string> files = scenes;
  files.push_back(tool_shape);
  return files;
}

ArmShapes SceneArgument::shapes_of(const ArmArgument& arm_argument, const Arm& arm,
                                   const ShapeOptions& options) const {
  ArmShapes shapes = arm_argument.shapes(options);
  if (!tool_shape.empty()) shapes.links.push_back(arm_argument.tool_shapes(tool_shape));
  const bool any = std::any_of(shapes.links.begin(), shapes.links.end(),
                               [](const LinkShapes& body) { return !body.shapes.empty(); });
  if (!any) throw no_shapes(scenes.empty() ? "--self" : "--scene", arm.name());
  return shapes;
}

void SceneArgument::refuse_without_scene() const {
  const std::pair<const char*, bool> options[] = {
      {"--clearance", clearance.has_value()},
      {"--radius", radius.has_value()},
      {"--allow", !allow.empty()},
      {"--hold", !hold.empty()},
      {"--package", !package.empty()},
      {"--tool-shape", !tool_shape.empty()},
      {"--resolution", resolution.has_value()},
      {"--recover-clearance", recover_clearance.has_value()}};
  for (const auto& [option, typed] : options) {
    if (typed) throw Error(std::string(option) + " needs --scene or --self");
  }
}

ShapeOptions SceneArgument::reading_options() const {
  if (radius && std::none_of(scenes.begin(), scenes.end(), is_cloud_path)) {
    throw Error("--radius needs a point cloud, .ply or .npy, as --scene");
  }
  return {.hold = held_values(hold), .package = package_folders(package), .radius = radius};
}

std::optional<CheckedScene> SceneArgument::read(const ArmArgument& arm_argument,
                                                const Arm& arm) const {
  if (!given()) {
    refuse_without_scene();
    return std::nullopt;
  }
  ShapeOptions reading = reading_options();
  const std::map<std::string, double> hold_of_all = reading.hold;
  std::vector<SceneFile> files;
  for (const std::string& path : scenes) files.push_back({path, {}});
  read_cells(files, reading);
  const ArmShapes shapes = shapes_of(arm_argument, arm, reading);
  read_other_scenes(files, arm, shapes, reading, fixed_mount && !arm_argument.moving_base.given());
  auto scenes_held = held_in(files, hold_of_all, shapes.held);
  std::map<std::string, std::vector<std::string>> scenes_without_shapes;
  for (const SceneFile& file : files) {
    if (file.scene.links_without_shapes.empty()) continue;
    scenes_without_shapes[file.path] = file.scene.links_without_shapes;
  }
  std::vector<std::string> links;
  for (const LinkShapes& body : shapes.links) links.push_back(body.name);
  std::vector<std::string> known = links;
  const Scene scene = joined(std::move(files), known);
  CollisionOptions options{.self_collision = !no_self};
  if (clearance) options.clearance = *clearance;
  for (const std::string& pair : allow) {
    options.allowed_pairs.push_back(
        for_option("--allow", [&] { return allowed_pair(pair, known); }));
  }
  std::vector<NamedPair> allowed = scene.allowed_pairs;
  allowed.insert(allowed.end(), options.allowed_pairs.begin(), options.allowed_pairs.end());
  options.allowed_pairs.insert(options.allowed_pairs.end(), shapes.allowed_pairs.begin(),
                               shapes.allowed_pairs.end());
  CheckedScene checked{
      .model = CollisionModel(arm, shapes.links, scene, options),
      .links = links,
      .obstacles = {known.begin() + static_cast<std::ptrdiff_t>(links.size()), known.end()},
      .clearance = options.clearance,
      .self_collision = !no_self,
      .obstacles_have_clearances =
          std::any_of(scene.obstacles.begin(), scene.obstacles.end(),
                      [](const Obstacle& obstacle) { return obstacle.clearance.has_value(); }),
      .allowed_pairs = std::move(allowed),
      .srdf = arm_argument.srdf,
      .srdf_pairs = shapes.allowed_pairs,
      .exempted_pairs = scene.exempted_pairs,
      .held = shapes.held,
      .held_by_state = shapes.held_by_state,
      .scenes_held = std::move(scenes_held),
      .links_without_shapes = links_without(arm, shapes, arm_argument.moving_base),
      .scenes_without_shapes = std::move(scenes_without_shapes)};
  for (const LinkShapes& body : shapes.links) {
    add_mesh_hulls(body.name, body.shapes, checked.mesh_hulls);
  }
  for (const Obstacle& obstacle : scene.obstacles) {
    add_mesh_hulls(obstacle.name, obstacle.shapes, checked.mesh_hulls);
  }
  warn_about(checked, far_obstacles(arm, scene));
  return checked;
}

}  // namespace beeline::command
