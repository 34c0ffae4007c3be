#include <algorithm>
#include <unordered_map>

#include <beeline/error.h>
#include <beeline/read/internal/name.h>
#include <beeline/read/internal/urdf_tree.h>

namespace beeline::internal {
namespace {

using Indices = std::vector<std::size_t>;

constexpr std::size_t no_joint = static_cast<std::size_t>(-1);

/// The tree of links, given as indices into `file.links`. Every link except a root has one parent
/// joint.
class Tree {
 public:
  explicit Tree(const UrdfFile& file)
      : file_(file), parent_joint_(file.links.size(), no_joint), child_joints_(file.links.size()) {
    if (file.links.empty()) refuse("has no links");
    for (std::size_t i = 0; i < file.links.size(); ++i) index_.emplace(file.links[i].name, i);
    for (std::size_t j = 0; j < file.joints.size(); ++j) add_joint(j);
    for (std::size_t i = 0; i < file.links.size(); ++i) {
      if (parent_joint_[i] == no_joint) roots_.push_back(i);
    }
    check_no_cycle();
  }

  std::size_t base(const std::string& name) const {
    if (!name.empty()) return link_called(name, "base link");
    if (roots_.size() > 1) {
      refuse("has " + std::to_string(roots_.size()) + " roots; choose the base: " + names(roots_));
    }
    return roots_.front();
  }

  /// Returns the link called `name` or, if that is empty, an end of the tree that a joint moves.
  std::size_t tip(const std::string& name, std::size_t base,
                  std::vector<std::string>* notes) const {
    if (!name.empty()) return link_called(name, "tip link");
    std::vector<End> ends = moved_ends(base, Way::down);
    const bool below = !ends.empty();
    if (!below) ends = moved_ends(base, Way::any);
    if (ends.empty()) return links_below({base}).back();  // its chain is refused with the reason
    const auto tool = std::find_if(ends.begin(), ends.end(),
                                   [&](const End& end) { return name_of(end.link) == "tool0"; });
    const bool one_body = std::all_of(
        ends.begin(), ends.end(), [&](const End& end) { return end.body == ends.front().body; });
    if (!one_body && tool == ends.end()) {
      refuse("has " + std::to_string(ends.size()) + " tips " + (below ? "below " : "beyond ") +
             name_of(base) + "; choose one as the tip: " + names(links_of(ends)));
    }
    const std::size_t tip = (tool == ends.end() ? ends.front() : *tool).link;
    if (notes != nullptr && ends.size() > 1) {
      ends.erase(std::find_if(ends.begin(), ends.end(),
                              [tip](const End& end) { return end.link == tip; }));
      notes->push_back("the tip is " + name_of(tip) + "; other tips" +
                       (one_body ? ", fixed to the same link: " : ": ") + names(links_of(ends)));
    }
    return tip;
  }

  std::vector<ChainJoint> chain(std::size_t base, std::size_t tip) const {
    std::unordered_map<std::size_t, std::size_t> below;  // from an ancestor of the tip: the joint
    std::size_t top = tip;
    for (; parent_joint_[top] != no_joint; top = parent_of(top)) {
      below.emplace(parent_of(top), parent_joint_[top]);
    }
    std::vector<ChainJoint> joints;
    std::size_t link = base;
    for (; link != tip && !below.contains(link); link = parent_of(link)) {
      if (parent_joint_[link] == no_joint) {
        refuse("tip " + name_of(tip) + " is not connected to base " + name_of(base));
      }
      joints.push_back({parent_joint_[link], true});
    }
    while (link != tip) {
      const std::size_t joint = below.at(link);
      joints.push_back({joint, false});
      link = index_.at(file_.joints[joint].child);
    }
    return joints;
  }

  /// See ends_of_joints().
  ChainEnds ends_of(const Indices& joints) const {
    std::vector<bool> wanted(file_.joints.size(), false);
    for (const std::size_t joint : joints) wanted[joint] = true;
    const std::vector<std::size_t> depths = joint_depths();
    std::size_t last = no_joint;  // the deepest joint that moves
    for (const std::size_t joint : joints) {
      if (!has_one_dof(file_.joints[joint])) continue;
      if (last == no_joint || depths[joint] > depths[last]) last = joint;
    }
    if (last == no_joint) throw Error("has no moving joint");
    std::size_t first = last;
    std::vector<bool> passed(file_.joints.size(), false);
    for (std::size_t joint = last; joint != no_joint;) {  // up to the root
      passed[joint] = true;
      if (wanted[joint]) first = joint;
      joint = parent_joint_[index_.at(file_.joints[joint].parent)];
    }
    for (const std::size_t joint : joints) {
      if (passed[joint] || !has_one_dof(file_.joints[joint])) continue;
      throw Error("is not a chain: joints " + file_.joints[joint].name + " and " +
                  file_.joints[last].name + " are on two branches; select a base and a tip");
    }
    for (std::size_t joint = last; joint != first;) {
      const UrdfFile::Joint& between = file_.joints[joint];
      if (!wanted[joint] && has_one_dof(between) && !between.mimic) {
        throw Error("does not have joint " + between.name +
                    ", which moves between its base and its tip");
      }
      joint = parent_joint_[index_.at(between.parent)];
    }
    return {.base = file_.joints[first].parent, .tip = below_fixed(last, wanted, depths)};
  }

 private:
  /// The number of joints from the root to each joint.
  std::vector<std::size_t> joint_depths() const {
    std::vector<std::size_t> depths(file_.joints.size(), 0);
    for (const std::size_t link : links_below(roots_)) {  // from the roots on
      for (const std::size_t joint : child_joints_[link]) {
        if (parent_joint_[link] != no_joint) depths[joint] = depths[parent_joint_[link]] + 1;
      }
    }
    return depths;
  }

  /// Returns the deepest link below the joint that wanted fixed joints lead to.
  std::string below_fixed(std::size_t last, const std::vector<bool>& wanted,
                          const std::vector<std::size_t>& depths) const {
    Indices fixed{last};
    std::size_t deepest = last;
    for (std::size_t next = 0; next < fixed.size(); ++next) {
      if (depths[fixed[next]] > depths[deepest]) deepest = fixed[next];
      for (const std::size_t joint : child_joints_[index_.at(file_.joints[fixed[next]].child)]) {
        if (wanted[joint] && file_.joints[joint].type == "fixed") fixed.push_back(joint);
      }
    }
    return file_.joints[deepest].child;
  }

  enum class Way { down, any };

  /// An end of the tree, and the link that leads it: links of one body are connected by fixed
  /// joints.
  struct End {
    std::size_t link, body;
  };

  /// Returns the ends of the tree that can be reached from the base through a joint with one degree
  /// of freedom, in the file's order.
  std::vector<End> moved_ends(std::size_t base, Way way) const {
    struct Visit {
      std::size_t link, from, body;
      bool moved;
    };
    std::vector<Visit> visits{{base, no_joint, base, false}};
    std::vector<End> ends;
    for (std::size_t next = 0; next < visits.size(); ++next) {
      const Visit visit = visits[next];
      Indices joints = child_joints_[visit.link];
      if (way == Way::any && parent_joint_[visit.link] != no_joint) {
        joints.push_back(parent_joint_[visit.link]);
      }
      const std::size_t known = visits.size();
      for (const std::size_t j : joints) {
        if (j == visit.from) continue;
        const UrdfFile::Joint& joint = file_.joints[j];
        const bool up = j == parent_joint_[visit.link];
        const std::size_t link = index_.at(up ? joint.parent : joint.child);
        visits.push_back({link, j, joint.type == "fixed" ? visit.body : link,
                          visit.moved || has_one_dof(joint)});
      }
      if (visits.size() == known && visit.moved) ends.push_back({visit.link, visit.body});
    }
    std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.link < b.link; });
    return ends;
  }

  static Indices links_of(const std::vector<End>& ends) {
    Indices links;
    for (const End& end : ends) links.push_back(end.link);
    return links;
  }

  std::size_t parent_of(std::size_t link) const {
    return index_.at(file_.joints[parent_joint_[link]].parent);
  }

  [[noreturn]] void refuse(const std::string& message, int line = 0) const {
    throw FileError(file_.path, line, message);
  }

  const std::string& name_of(std::size_t link) const { return file_.links[link].name; }

  std::string names(const Indices& links) const {
    std::vector<std::string> all;
    for (const std::size_t link : links) all.push_back(name_of(link));
    return listed(all);
  }

  /// Finds a link by name; `owner` is the joint that refers to it, or null.
  std::size_t link_called(const std::string& name, const char* what,
                          const UrdfFile::Joint* owner = nullptr) const {
    const auto found = index_.find(name);
    if (found != index_.end()) return found->second;
    std::vector<std::string> known;
    for (const auto& link : file_.links) known.push_back(link.name);
    const std::string why = unknown_name(what, printable(name), known).what();
    if (owner != nullptr) refuse("joint " + owner->name + " has an " + why, owner->line);
    refuse(why);
  }

  void add_joint(std::size_t j) {
    const UrdfFile::Joint& joint = file_.joints[j];
    const std::size_t parent = link_called(joint.parent, "parent link", &joint);
    const std::size_t child = link_called(joint.child, "child link", &joint);
    if (parent_joint_[child] != no_joint) {
      refuse("link " + name_of(child) + " has two parents, by joints " +
                 file_.joints[parent_joint_[child]].name + " and " + joint.name,
             joint.line);
    }
    parent_joint_[child] = j;
    child_joints_[parent].push_back(j);
  }

  /// Returns `from` and all links below them. Links have one parent, so that this terminates.
  Indices links_below(Indices from) const {
    for (std::size_t next = 0; next < from.size(); ++next) {
      for (const std::size_t joint : child_joints_[from[next]]) {
        from.push_back(index_.at(file_.joints[joint].child));
      }
    }
    return from;
  }

  /// A link that is not below a root has a cycle among its ancestors.
  void check_no_cycle() const {
    std::vector<bool> reached(file_.links.size(), false);
    for (const std::size_t link : links_below(roots_)) reached[link] = true;
    const auto lost = std::find(reached.begin(), reached.end(), false);
    if (lost == reached.end()) return;
    std::size_t link = static_cast<std::size_t>(lost - reached.begin());
    std::vector<bool> visited(file_.links.size(), false);
    while (!visited[link]) {  // towards the root, until the cycle closes
      visited[link] = true;
      link = index_.at(file_.joints[parent_joint_[link]].parent);
    }
    const UrdfFile::Joint& joint = file_.joints[parent_joint_[link]];
    refuse("the links form a cycle through joint " + joint.name + " and link " + name_of(link) +
               "; a chain needs a tree",
           joint.line);
  }

  const UrdfFile& file_;
  std::unordered_map<std::string, std::size_t> index_;  // of a link, by name
  Indices parent_joint_;
  std::vector<Indices> child_joints_;
  Indices roots_;
};

}  // namespace

std::vector<ChainJoint> cut_chain(const UrdfFile& file, const ChainEnds& ends,
                                  std::vector<std::string>* notes) {
  const Tree tree(file);
  const std::size_t base = tree.base(ends.base);
  return tree.chain(base, tree.tip(ends.tip, base, notes));
}

ChainEnds ends_of_joints(const UrdfFile& file, const std::vector<std::size_t>& joints) {
  return Tree(file).ends_of(joints);
}

}  // namespace beeline::internal
