#include <algorithm>
#include <optional>
#include <unordered_map>

#include <beeline/error.h>
#include <beeline/io/text/internal/link_tree.h>
#include <beeline/io/text/internal/urdf_fault.h>
#include <beeline/io/text/internal/urdf_held_joints.h>
#include <beeline/io/text/internal/xacro.h>
#include <beeline/io/text/scene.h>

namespace beeline {
namespace {

using internal::UrdfFile;

/// A link in the world, and the joint above it.
struct PlacedObstacle {
  Pose pose = Pose::Identity();
  std::optional<std::size_t> joint, parent;
};

/// Refuses a file in which a link has no place: its obstacle would be missing.
void check_tree(const UrdfFile& file) {
  const internal::UrdfTree tree(file);
  if (const internal::UrdfFault* fault = tree.first_fault()) throw error_of(file, *fault);
  std::unordered_map<std::string, int> joints_above;
  for (const UrdfFile::Joint& joint : file.joints) ++joints_above[joint.child];
  std::vector<std::string> roots;
  for (const UrdfFile::Link& link : file.links) {
    if (!joints_above.contains(link.name)) roots.push_back(link.name);
  }
  if (roots.size() == 1) return;
  throw FileError(file.path, 0,
                  "has several root links, " + listed(roots) +
                      "; in a scene one root link, the world, is connected to all others");
}

/// The links of a tree, in the file's order.
std::vector<PlacedObstacle> placed_links(const UrdfFile& file, const internal::HeldJoints& held) {
  std::unordered_map<std::string, std::size_t> links;
  for (std::size_t i = 0; i < file.links.size(); ++i) links.emplace(file.links[i].name, i);
  std::vector<std::vector<std::size_t>> joints_below(file.links.size());
  std::vector<bool> is_child(file.links.size());
  for (std::size_t j = 0; j < file.joints.size(); ++j) {
    joints_below[links.at(file.joints[j].parent)].push_back(j);
    is_child[links.at(file.joints[j].child)] = true;
  }
  std::vector<PlacedObstacle> placed(file.links.size());
  const auto root = std::find(is_child.begin(), is_child.end(), false);
  std::vector<std::size_t> reached{static_cast<std::size_t>(root - is_child.begin())};
  for (std::size_t i = 0; i < reached.size(); ++i) {  // it grows
    const std::size_t link = reached[i];
    for (const std::size_t j : joints_below[link]) {
      const std::size_t child = links.at(file.joints[j].child);
      placed[child] = {placed[link].pose * held.pose(j), j, link};
      reached.push_back(child);
    }
  }
  return placed;
}

Scene scene_of_links(std::string_view text, const std::string& path, const ShapeOptions& options) {
  const UrdfFile file = internal::parse_link_tree(text, path);
  check_tree(file);
  const internal::HeldJoints held(file, {}, options.hold);
  const std::vector<PlacedObstacle> placed = placed_links(file, held);
  auto shapes =
      internal::link_tree_shapes(text, path, options.package, internal::MjcfUse::obstacles);
  Scene scene{.links_without_shapes = std::move(shapes.only_visual)};
  std::vector<bool> is_added(file.joints.size());
  for (std::size_t i = 0; i < file.links.size(); ++i) {
    const auto found = shapes.of_link.find(file.links[i].name);
    if (found == shapes.of_link.end()) continue;
    for (Shape& shape : found->second) shape.pose = placed[i].pose * shape.pose;
    scene.obstacles.push_back({.name = file.links[i].name, .shapes = std::move(found->second)});
    for (std::size_t at = i; placed[at].joint && !is_added[*placed[at].joint];
         at = *placed[at].parent) {
      is_added[*placed[at].joint] = true;
      held.add_held(*placed[at].joint, file.links[i].name, scene.held);
    }
  }
  if (!scene.obstacles.empty()) return scene;
  throw FileError(path, 0,
                  std::string("has no ") +
                      (file.is_mjcf ? "geoms that collide" : "<collision> elements") +
                      ", so that no link is an obstacle");
}

}  // namespace

Scene scene_from_urdf(std::string_view text, const std::string& path, const ShapeOptions& options) {
  if (!options.srdf.empty()) throw Error::of("srdf", "exempts pairs of an arm, not of a scene");
  const internal::ExpandedText expanded(text, path);
  return internal::with_lines_of(expanded, path,
                                 [&] { return scene_of_links(expanded.text(), path, options); });
}

}  // namespace beeline
