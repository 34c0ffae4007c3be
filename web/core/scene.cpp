#include "scene.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <optional>

#include <beeline/collision/collision_model.h>
#include <beeline/io/text/arm.h>
#include <beeline/io/text/json.h>
#include <beeline/io/text/scene.h>

#include "fault.h"
#include "guarded_motion.h"
#include "handles.h"

using namespace beeline;
using web::guarded;

namespace {

/// An arm among obstacles. The pairs of links and the pairs with obstacles are in two models: only
/// the second one is prepared again while an obstacle is dragged.
struct ArmInScene {
  Arm arm;
  ArmShapes shapes;
  CollisionOptions options;
  std::map<std::string, int> numbers = {};  ///< of the bodies, by name
  std::vector<NamedPair> allowed = {};      ///< pairs of links of the scene that may touch
  std::optional<CollisionModel> of_links = {}, of_obstacles = {};
  std::unique_ptr<web::GuardedMotion> guard = nullptr;  ///< once it is asked for
};

web::Handles<ArmInScene>& scenes() {
  static web::Handles<ArmInScene> handles("scene");
  return handles;
}

/// The pairs of two links among the pairs that may touch.
std::vector<NamedPair> pairs_of_links(const Scene& scene, const std::vector<LinkShapes>& links) {
  const auto is_link = [&](const std::string& name) {
    return std::any_of(links.begin(), links.end(),
                       [&](const LinkShapes& body) { return body.name == name; });
  };
  std::vector<NamedPair> pairs;
  for (const auto* listed : {&scene.allowed_pairs, &scene.exempted_pairs}) {
    std::copy_if(listed->begin(), listed->end(), std::back_inserter(pairs),
                 [&](const NamedPair& pair) { return is_link(pair[0]) && is_link(pair[1]); });
  }
  return pairs;
}

/// Puts the arm among these obstacles. If they are refused, the others stay.
void set_obstacles(ArmInScene& known, const Scene& scene) {
  CollisionOptions of_links = known.options, of_obstacles = known.options;
  of_obstacles.self_collision = false;
  CollisionModel obstacles(known.arm, known.shapes.links, scene, of_obstacles);
  const std::vector<NamedPair> allowed = pairs_of_links(scene, known.shapes.links);
  if (!known.of_links || allowed != known.allowed) {
    of_links.allowed_pairs = allowed;
    known.of_links.emplace(CollisionModel(known.arm, known.shapes.links, {}, of_links));
    known.allowed = allowed;
  }
  known.of_obstacles.emplace(std::move(obstacles));
  known.guard.reset();
  known.numbers.clear();
  int number = 0;
  for (const LinkShapes& body : known.shapes.links) known.numbers[body.name] = number++;
  for (const Obstacle& body : scene.obstacles) known.numbers[body.name] = number++;
}

}  // namespace

int beeline_scene(const char* arm, const char* base, const char* tip, double clearance) {
  return guarded([&] {
    const ChainEnds ends{.base = base, .tip = tip};
    ArmInScene known{
        .arm = read_arm(arm, ends), .shapes = read_arm_shapes(arm, ends), .options = {}};
    std::erase_if(known.shapes.links, [](const LinkShapes& body) { return body.shapes.empty(); });
    if (clearance != 0) known.options.clearance = clearance;
    set_obstacles(known, {});
    return scenes().add(std::move(known));
  });
}

const char* beeline_scene_links(int scene) {
  return web::text([&] {
    Scene bodies;
    Json links = Json::list();
    for (const LinkShapes& body : scenes().at(scene).shapes.links) {
      bodies.obstacles.push_back({.name = body.name, .shapes = body.shapes});
      links.append(body.link);
    }
    return "{\"bodies\": " + scene_to_json(bodies) + ", \"links\": " + links.text() + "}";
  });
}

double beeline_scene_clearance(int scene) {
  double clearance = -1;
  guarded([&] { return clearance = scenes().at(scene).options.clearance, 0; });
  return clearance;
}

const char* beeline_scene_read(int scene, const char* path) {
  return web::text([&] {
    const ArmInScene& known = scenes().at(scene);
    ShapeOptions options;
    for (const auto& [link, pose] : known.shapes.base_links) {
      options.frames[link] = link.empty() ? pose : known.arm.base() * pose;
    }
    return scene_to_json(read_scene(path, options));
  });
}

int beeline_scene_obstacles(int scene, const char* text) {
  return guarded(
      [&] { return set_obstacles(scenes().at(scene), scene_from_json(text, "scene.json")), 0; });
}

int beeline_scene_nearest(int scene, int of_links, const double* q, double* numbers) {
  return guarded([&] {
    const ArmInScene& known = scenes().at(scene);
    const CollisionModel& model = of_links != 0 ? *known.of_links : *known.of_obstacles;
    const Eigen::Map<const Configuration> at(q, known.arm.dof());
    constexpr double margin = 2e-6;  // within it, pairs that are proved apart do not count
    if (model.pair_count() == 0 && outside_limits(known.arm, at, margin).empty()) return 0;
    if (model.pair_count() + model.apart_count() == 0) return 0;
    const auto found = nearest_pair(model, at);
    for (const std::string& name : found.names) *numbers++ = known.numbers.at(name);
    for (const double length : {found.lower, found.upper, found.clearance}) *numbers++ = length;
    for (const Vector3& point : {found.on_first, found.on_second}) {
      numbers = std::copy_n(point.data(), 3, numbers);
    }
    return 1;
  });
}

int beeline_scene_guard(int scene, int slides, const double* from, const double* to,
                        double* numbers) {
  return guarded([&] {
    ArmInScene& known = scenes().at(scene);
    if (!known.guard) {
      known.guard = std::make_unique<web::GuardedMotion>(
          known.arm, known.shapes.links, known.of_obstacles->scene(), known.options);
    }
    using Values = Eigen::Map<const Configuration>;
    const web::GuardedStep step = known.guard->towards(Values(from, known.arm.dof()),
                                                       Values(to, known.arm.dof()), slides != 0);
    numbers = std::copy_n(step.q.data(), step.q.size(), numbers);
    for (const std::size_t i : {0, 1}) {
      *numbers++ = step.held_by ? known.numbers.at((*step.held_by)[i]) : -1;
    }
    *numbers = step.is_goal_free ? 1 : 0;
    return step.is_on_its_way ? 1 : 0;
  });
}

int beeline_scene_release(int scene) {
  return guarded([&] { return scenes().release(scene), 0; });
}
