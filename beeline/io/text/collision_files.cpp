#include <set>

#include <beeline/collision/internal/collision_bodies.h>
#include <beeline/io/text/scene.h>

namespace beeline {
namespace {

/// The bodies of the arm for an arm file. A body at one joint of its link alone is attached to the
/// link; `exempted` gets its pairs that do not count.
std::vector<LinkShapes> bodies_of_file(const CollisionModel& model,
                                       std::vector<NamedPair>& exempted) {
  std::vector<LinkShapes> bodies = model.links();
  std::set<std::string> attached;
  for (LinkShapes& body : bodies) {
    // The base has no joint in front of it, and the last link none behind it.
    if (body.link == 0) body.at_proximal_joint = body.at_distal_joint;
    if (body.link == model.arm().joints().size()) body.at_distal_joint = body.at_proximal_joint;
    if (body.at_proximal_joint == body.at_distal_joint) continue;
    body.at_proximal_joint = body.at_distal_joint = false;
    attached.insert(body.name);
  }
  for (const NamedPair& pair : model.neighbour_pairs()) {
    if (attached.contains(pair[0]) || attached.contains(pair[1])) exempted.push_back(pair);
  }
  return bodies;
}

}  // namespace

CollisionFiles collision_files(const CollisionModel& model) {
  const CollisionOptions& options = model.bodies().options;
  Scene scene = model.scene();
  scene.allowed_pairs.insert(scene.allowed_pairs.end(), options.allowed_pairs.begin(),
                             options.allowed_pairs.end());
  const std::vector<LinkShapes> bodies = bodies_of_file(model, scene.exempted_pairs);
  for (std::size_t i = 0; i < bodies.size() && !options.self_collision; ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      scene.exempted_pairs.push_back({bodies[k].name, bodies[i].name});
    }
  }
  return {.arm = arm_to_json(model.arm(), bodies), .scene = scene_to_json(scene)};
}

}  // namespace beeline
