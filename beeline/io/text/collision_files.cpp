#include <set>

#include <beeline/collision/internal/collision_bodies.h>
#include <beeline/io/text/internal/arm_to_json.h>
#include <beeline/io/text/scene.h>

namespace beeline {
namespace {

/// The pairs at a joint that an arm file does not describe so, as one of the bodies is attached.
std::vector<NamedPair> neighbours_of_attached(const CollisionModel& model) {
  std::set<std::string> attached;
  for (const LinkShapes& body : model.links()) {
    if (internal::is_attached_in_file(model.arm(), body)) attached.insert(body.name);
  }
  std::vector<NamedPair> pairs = model.neighbour_pairs();
  std::erase_if(pairs, [&](const NamedPair& pair) {
    return !attached.contains(pair[0]) && !attached.contains(pair[1]);
  });
  return pairs;
}

}  // namespace

CollisionFiles collision_files(const CollisionModel& model) {
  const CollisionOptions& options = model.bodies().options;
  Scene scene = model.scene();
  scene.allowed_pairs.insert(scene.allowed_pairs.end(), options.allowed_pairs.begin(),
                             options.allowed_pairs.end());
  const std::vector<NamedPair> neighbours = neighbours_of_attached(model);
  scene.exempted_pairs.insert(scene.exempted_pairs.end(), neighbours.begin(), neighbours.end());
  const std::vector<LinkShapes>& bodies = model.links();
  for (std::size_t i = 0; i < bodies.size() && !options.self_collision; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      scene.exempted_pairs.push_back({bodies[k].name, bodies[i].name});
    }
  }
  return {.arm = arm_to_json(model.arm(), bodies), .scene = scene_to_json(scene)};
}

}  // namespace beeline
