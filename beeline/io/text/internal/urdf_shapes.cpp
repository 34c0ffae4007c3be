#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <beeline/error.h>
#include <beeline/io/text/internal/link_tree.h>
#include <beeline/io/text/internal/urdf_chain.h>
#include <beeline/io/text/internal/urdf_held_joints.h>
#include <beeline/io/text/internal/urdf_shapes.h>
#include <beeline/io/text/internal/xacro.h>

namespace beeline::internal {
namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

/// A link of the file and the link of the arm that carries it.
struct PlacedLink {
  std::size_t frame = 0;         ///< link of the arm: 0 is the base
  Pose pose = Pose::Identity();  ///< in the frame of that link
  std::size_t joint = none;      ///< joint beside the chain by which it was reached
  std::size_t before = none;     ///< link from which it was reached by that joint
  bool at_proximal_joint = false, at_distal_joint = false;
};

/// Places the links of a file on the links of an arm. Links beside the chain are carried with their
/// joints held at constant values.
class LinkPlacement {
 public:
  LinkPlacement(const UrdfFile& file, const std::vector<ChainJoint>& chain,
                const std::map<std::string, double>& hold, const std::vector<Srdf::State>& states)
      : file_(file),
        joints_(file, chain, hold, states),
        on_chain_(file.joints.size()),
        placed_(file.links.size()) {
    for (std::size_t i = 0; i < file.links.size(); ++i) links_.emplace(file.links[i].name, i);
    for (const ChainJoint& place : chain) on_chain_[place.index] = true;
    place_chain(chain);
    place_others();
  }

  /// The links that only fixed joints connect to link 0, with their poses in its frame; "" is the
  /// root.
  std::map<std::string, Pose> base_links() const {
    std::unordered_set<std::string> children;
    for (const UrdfFile::Joint& joint : file_.joints) children.insert(joint.child);
    std::map<std::string, Pose> found;
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      if (!placed_[i] || placed_[i]->frame != 0 || !is_fixed(i)) continue;
      const std::string& name = file_.links[i].name;
      found.emplace(name, placed_[i]->pose);
      if (!children.contains(name)) found.emplace("", placed_[i]->pose);
    }
    return found;
  }

  /// The links at link 0 that stand in the world beside the arm, see ArmShapes::standing.
  std::unordered_set<std::string> standing() const {
    std::unordered_map<std::string, std::string> parents;
    for (const UrdfFile::Joint& joint : file_.joints) parents.emplace(joint.child, joint.parent);
    // The link below the root on the way to a link, or the root itself; empty without a root world.
    const auto branch_of = [&](const std::string& link) {
      std::string at = link, below = link;
      for (std::size_t i = 0; i < parents.size() && parents.contains(at); ++i) {
        below = std::exchange(at, parents.at(at));
      }
      return at == "world" ? below : "";
    };
    std::unordered_set<std::string> of_arm;
    for (std::size_t i = 0; i < file_.joints.size(); ++i) {
      if (on_chain_[i]) of_arm.insert(branch_of(file_.joints[i].child));
    }
    std::unordered_set<std::string> found;
    for (std::size_t i = 0; i < placed_.size(); ++i) {
      const std::string branch = branch_of(file_.links[i].name);
      const bool at_base = placed_[i] && placed_[i]->frame == 0;
      if (at_base && !branch.empty() && !of_arm.contains(branch)) found.insert(file_.links[i].name);
    }
    return found;
  }

  /// The body of a link with its shapes; the joints that hold it are added to `read`.
  LinkShapes body_of(std::size_t link, std::vector<Shape> shapes, ArmShapes& read) {
    const UrdfFile::Link& of_file = file_.links[link];
    if (!placed_[link]) {
      throw FileError(
          file_.path, of_file.line,
          "link " + of_file.name + " has a collision shape, and no joint connects it to the arm");
    }
    for (std::size_t at = link; placed_[at]->joint != none; at = placed_[at]->before) {
      if (!needed_.insert(placed_[at]->joint).second) break;
      const std::size_t joint = placed_[at]->joint;
      joints_.add_held(joint, of_file.name, read.held);
      const std::string state = joints_.state_of(joint);
      if (!state.empty()) read.held_by_state[file_.joints[joint].name] = state;
    }
    std::map<std::string, double> held;
    for (std::size_t at = link; placed_[at]->joint != none; at = placed_[at]->before) {
      joints_.add_leader(placed_[at]->joint, held);
    }
    const PlacedLink& placed = *placed_[link];
    for (Shape& shape : shapes) shape.pose = placed.pose * shape.pose;
    return {.name = of_file.name,
            .link = placed.frame,
            .shapes = std::move(shapes),
            .at_proximal_joint = placed.at_proximal_joint,
            .at_distal_joint = placed.at_distal_joint,
            .held = std::move(held)};
  }

 private:
  std::size_t link_called(const std::string& name) const {
    const auto found = links_.find(name);
    return found == links_.end() ? none : found->second;
  }

  /// Whether only fixed joints connect a link to the chain.
  bool is_fixed(std::size_t link) const {
    for (std::size_t at = link; placed_[at]->joint != none; at = placed_[at]->before) {
      if (file_.joints[placed_[at]->joint].type != "fixed") return false;
    }
    return true;
  }

  void place_chain(const std::vector<ChainJoint>& chain) {
    PlacedLink at;
    for (std::size_t i = 0; i <= chain.size(); ++i) {
      const ChainJoint& place = chain[std::min(i, chain.size() - 1)];
      const UrdfFile::Joint& joint = file_.joints[place.index];
      const std::size_t link =
          link_called((i < chain.size()) == place.reversed ? joint.child : joint.parent);
      at.at_distal_joint = i < chain.size() && joint.type != "fixed";
      placed_[link] = at;
      reached_.push_back(link);
      if (i == chain.size()) break;
      at.at_proximal_joint = joint.type != "fixed";
      if (at.at_proximal_joint) {
        ++at.frame;
        at.pose = Pose::Identity();
      } else {
        at.pose = at.pose * (place.reversed ? joint.origin.inverse() : joint.origin);
      }
    }
  }

  void place_others() {
    std::vector<std::vector<std::size_t>> joints_at(file_.links.size());
    for (std::size_t j = 0; j < file_.joints.size(); ++j) {
      const std::size_t parent = link_called(file_.joints[j].parent);
      const std::size_t child = link_called(file_.joints[j].child);
      if (on_chain_[j] || parent == none || child == none) continue;
      joints_at[parent].push_back(j);
      if (child != parent) joints_at[child].push_back(j);
    }
    for (std::size_t i = 0; i < reached_.size(); ++i) {  // it grows
      const std::size_t link = reached_[i];
      for (const std::size_t j : joints_at[link]) {
        if (j != placed_[link]->joint) place_beside(link, j);
      }
    }
  }

  void place_beside(std::size_t link, std::size_t j) {
    const UrdfFile::Joint& joint = file_.joints[j];
    const bool down = link_called(joint.parent) == link;
    const std::size_t other = link_called(down ? joint.child : joint.parent);
    if (placed_[other]) {
      throw FileError(
          path_of(file_, joint), joint.line,
          "joint " + joint.name + " closes a loop of links; shapes are read of a tree of links");
    }
    const PlacedLink& from = *placed_[link];
    const Pose pose = joints_.pose(j);
    placed_[other] = PlacedLink{.frame = from.frame,
                                .pose = from.pose * (down ? pose : pose.inverse()),
                                .joint = j,
                                .before = link};
    reached_.push_back(other);
  }

  const UrdfFile& file_;
  const HeldJoints joints_;
  std::vector<bool> on_chain_;
  std::unordered_map<std::string, std::size_t> links_;
  std::unordered_set<std::size_t> needed_;  ///< the joints beside the chain that carry shapes
  std::vector<std::optional<PlacedLink>> placed_;
  std::vector<std::size_t> reached_;
};

/// The pairs whose links both have shapes, each once.
std::vector<NamedPair> pairs_with_shapes(const std::vector<NamedPair>& pairs,
                                         const ArmShapes& shapes) {
  std::unordered_set<std::string> links;
  for (const LinkShapes& link : shapes.links) links.insert(link.name);
  std::set<NamedPair> added;
  std::vector<NamedPair> found;
  for (const NamedPair& pair : pairs) {
    const bool known = links.contains(pair[0]) && links.contains(pair[1]) && pair[0] != pair[1];
    const NamedPair sorted{std::min(pair[0], pair[1]), std::max(pair[0], pair[1])};
    if (known && added.insert(sorted).second) found.push_back(pair);
  }
  return found;
}

ArmShapes shapes_of(std::string_view text, const std::string& path, const ChainEnds& ends,
                    const ShapeOptions& options, const std::vector<Srdf::State>& states) {
  arm_from_urdf(text, path, ends);  // refuses what is no arm
  const UrdfFile file = parse_link_tree(text, path);
  LinkPlacement placement(file, cut_chain(file, ends), options.hold, states);
  auto shapes = link_tree_shapes(text, path, options.package, MjcfUse::links);
  ArmShapes read{.links_without_shapes = std::move(shapes.only_visual),
                 .links_with_planes = std::move(shapes.planes),
                 .base_links = placement.base_links()};
  const std::unordered_set<std::string> standing = placement.standing();
  for (std::size_t i = 0; i < file.links.size(); ++i) {
    const auto found = shapes.of_link.find(file.links[i].name);
    if (found == shapes.of_link.end()) continue;
    read.links.push_back(placement.body_of(i, std::move(found->second), read));
    if (standing.contains(file.links[i].name)) read.standing.push_back(file.links[i].name);
  }
  read.allowed_pairs = pairs_with_shapes(shapes.may_touch, read);
  return read;
}

}  // namespace

ArmShapes shapes_from_urdf(std::string_view text, const std::string& path, const ChainEnds& ends,
                           const ShapeOptions& options, const std::vector<Srdf::State>& states) {
  const ExpandedText expanded(text, path);
  return with_lines_of(expanded, path,
                       [&] { return shapes_of(expanded.text(), path, ends, options, states); });
}

}  // namespace beeline::internal
