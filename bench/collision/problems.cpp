#include "problems.h"

#include <algorithm>
#include <filesystem>
#include <yaml-cpp/yaml.h>

#include <beeline/io/text/file.h>
#include <beeline/io/text/scene.h>

namespace beeline::bench {
namespace {

namespace fs = std::filesystem;

Vector3 vector_from(const YAML::Node& node) {
  return {node[0].as<double>(), node[1].as<double>(), node[2].as<double>()};
}

Shape shape_from(const YAML::Node& primitive, const YAML::Node& pose) {
  Shape shape;
  const YAML::Node size = primitive["dimensions"];
  const auto type = primitive["type"].as<std::string>();
  if (type == "box") {
    shape.body = Box{vector_from(size)};
  } else if (type == "cylinder") {
    shape.body = Cylinder{.radius = size[1].as<double>(), .length = size[0].as<double>()};
  } else {
    throw Error("a primitive of type " + type + " is not read");
  }
  const YAML::Node turn = pose["orientation"];  // x, y, z, w
  const Eigen::Quaterniond q(turn[3].as<double>(), turn[0].as<double>(), turn[1].as<double>(),
                             turn[2].as<double>());
  shape.pose = make_pose(vector_from(pose["position"]), q.normalized().toRotationMatrix());
  return shape;
}

Scene scene_from(const YAML::Node& file, const ShapedArm& arm) {
  Scene scene;
  for (const YAML::Node& object : file["world"]["collision_objects"]) {
    Obstacle obstacle{object["id"].as<std::string>(), {}};
    for (std::size_t i = 0; i < object["primitives"].size(); ++i) {
      obstacle.shapes.push_back(shape_from(object["primitives"][i], object["primitive_poses"][i]));
    }
    scene.obstacles.push_back(obstacle);
  }
  const YAML::Node allowed = file["allowed_collision_matrix"];
  const auto names = allowed["entry_names"].as<std::vector<std::string>>();
  const auto has_shapes = [&](const std::string& name) {
    return std::any_of(arm.links.begin(), arm.links.end(),
                       [&](const LinkShapes& link) { return link.name == name; });
  };
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t k = i + 1; k < names.size(); ++k) {
      if (!allowed["entry_values"][i][k].as<bool>()) continue;
      if (has_shapes(names[i]) && has_shapes(names[k])) {
        scene.allowed_pairs.push_back({names[i], names[k]});
      }
    }
  }
  return scene;
}

Configuration goal_from(const YAML::Node& file, const Arm& arm) {
  Configuration goal = Configuration::Zero(arm.dof());
  const std::vector<std::string> names = arm.joint_names();
  for (const YAML::Node& joint : file["goal_constraints"][0]["joint_constraints"]) {
    const auto found = std::find(names.begin(), names.end(), joint["joint_name"].as<std::string>());
    if (found != names.end()) goal[found - names.begin()] = joint["position"].as<double>();
  }
  return goal;
}

Configuration start_from(const YAML::Node& file, const Arm& arm) {
  Configuration start = Configuration::Zero(arm.dof());
  const std::vector<std::string> names = arm.joint_names();
  const YAML::Node state = file["start_state"]["joint_state"];
  for (std::size_t i = 0; i < state["name"].size(); ++i) {
    const auto found = std::find(names.begin(), names.end(), state["name"][i].as<std::string>());
    if (found != names.end()) start[found - names.begin()] = state["position"][i].as<double>();
  }
  return start;
}

/// The text with the fingers' upper limit beyond 0.065 m.
std::string with_wide_fingers(std::string text) {
  const std::string limit = R"(upper="0.04")";
  for (std::size_t at = text.find(limit); at != std::string::npos; at = text.find(limit)) {
    text.replace(at, limit.size(), R"(upper="0.07")");
  }
  return text;
}

}  // namespace

ShapedArm read_shaped_arm(const std::string& path) {
  const std::string text = with_wide_fingers(read_file(path));
  ShapeOptions options;
  if (text.find(R"(name="panda_finger_joint1" type="prismatic")") != std::string::npos) {
    options.hold = {{"panda_finger_joint1", 0.065}};
  }
  ChainEnds ends;
  if (text.find(R"(<link name="panda_link8")") != std::string::npos) ends.tip = "panda_link8";
  return {path, arm_from_urdf(text, path, ends),
          arm_shapes_from_text(text, path, ends, options).links};
}

std::vector<Problem> read_problems(const std::string& folder, const ShapedArm& arm) {
  std::vector<std::string> scenes;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("scene") && entry.path().extension() == ".yaml") {
      scenes.push_back(entry.path().string());
    }
  }
  std::sort(scenes.begin(), scenes.end());
  std::vector<Problem> problems;
  for (const std::string& path : scenes) {
    std::string request = path;
    request.replace(request.rfind("scene"), 5, "request");
    problems.push_back(
        {fs::path(path).parent_path().filename().string() + "/" + fs::path(path).stem().string(),
         scene_from(YAML::LoadFile(path), arm),
         {goal_from(YAML::LoadFile(request), arm.arm)},
         start_from(YAML::LoadFile(request), arm.arm)});
  }
  return problems;
}

std::vector<Problem> random_problems(std::size_t count, std::size_t boxes,
                                     std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> size(0.05, 0.3), place(-1, 1), angle(-3, 3);
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < count; ++i) {
    Problem problem{"boxes" + std::to_string(i), {}, {}};
    for (std::size_t k = 0; k < boxes; ++k) {
      Shape shape{Box{{size(engine), size(engine), size(engine)}}};
      const Vector3 axis(normal(engine), normal(engine), normal(engine));
      shape.pose = make_pose({place(engine), place(engine), place(engine)},
                             so3_exp(Vector3(axis.normalized() * angle(engine))));
      problem.scene.obstacles.push_back({"box" + std::to_string(k), {shape}});
    }
    problems.push_back(problem);
  }
  return problems;
}

Edge edge_from(const Arm& arm, const Configuration& from, std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  for (int tries = 0; tries < 10000; ++tries) {
    Configuration step(arm.dof());
    for (double& value : step) value = normal(engine);
    const Configuration to = from + step.normalized();
    if (limit_violations(arm, to).empty()) return {from, to};
  }
  throw Error("no direction leads to a configuration within the limits");
}

std::vector<Edge> edges_of(const CollisionModel& model, const Problem& problem, std::size_t count,
                           std::mt19937_64& engine) {
  std::vector<Edge> edges;
  for (int tries = 0; edges.size() < count && tries < 10000; ++tries) {
    const Configuration q = random_configuration(model.arm(), engine);
    if (pairs_too_close(model, q).empty()) edges.push_back(edge_from(model.arm(), q, engine));
  }
  for (const Configuration& q : problem.configurations) {
    if (!pairs_too_close(model, q).empty() || !limit_violations(model.arm(), q).empty()) continue;
    for (std::size_t i = 0; i < count; ++i) edges.push_back(edge_from(model.arm(), q, engine));
  }
  return edges;
}

}  // namespace beeline::bench
