#include <algorithm>

#include <beeline/error.h>
#include <beeline/internal/nearest_name.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/urdf_fault.h>
#include <beeline/io/text/internal/urdf_tree.h>

namespace beeline::internal {
UrdfTree::UrdfTree(const UrdfFile& file)
    : file_(file),
      faults_(file.faults),
      parent_joint_(file.links.size(), no_joint),
      child_joints_(file.links.size()),
      left_out_(file.joints.size(), false),
      cycle_of_(file.links.size(), no_cycle) {
  if (file.links.empty()) refuse_first_fault_or("has no links");
  for (std::size_t i = 0; i < file.links.size(); ++i) index_.emplace(file.links[i].name, i);
  for (std::size_t j = 0; j < file.joints.size(); ++j) add_joint(j);
  break_cycles();
  for (std::size_t i = 0; i < file.links.size(); ++i) {
    if (parent_joint_[i] == no_joint) roots_.push_back(i);
  }
  find_moving_faults();
  const auto alone = [&](std::size_t link) { return child_joints_[link].empty(); };
  if (std::all_of(roots_.begin(), roots_.end(), alone)) return;
  for (const std::size_t link : roots_) {
    if (!alone(link) || orphans_.contains(link)) continue;
    orphans_.emplace(link, faults_.size());
    faults_.push_back({.warning = {.kind = ReadWarningKind::unconnected_link,
                                   .line = file.links[link].line,
                                   .link = name_of(link)}});
  }
}

void UrdfTree::add_joint(std::size_t j) {
  const UrdfFile::Joint& joint = file_.joints[j];
  const auto parent = index_.find(joint.parent), child = index_.find(joint.child);
  if (parent == index_.end() || child == index_.end()) {
    const bool lacks_parent = parent == index_.end();
    return leave_out(j, {.kind = ReadWarningKind::unknown_link,
                         .link = lacks_parent ? joint.parent : joint.child,
                         .element = lacks_parent ? "<parent>" : "<child>"});
  }
  std::size_t& above = parent_joint_[child->second];
  if (above != no_joint) {
    return leave_out(j, {.kind = ReadWarningKind::two_parents,
                         .link = joint.child,
                         .others = {file_.joints[above].name}});
  }
  above = j;
  child_joints_[parent->second].push_back(j);
}

/// Adds the fault of a joint without a place in the tree.
void UrdfTree::leave_out(std::size_t j, ReadWarning fault) {
  left_out_[j] = true;
  fault.line = file_.joints[j].line;
  fault.joint = file_.joints[j].name;
  faults_.push_back({.warning = std::move(fault), .index = j});
}

/// Walks from each link towards its root. A walk that meets itself has found a cycle.
void UrdfTree::break_cycles() {
  std::vector<std::size_t> walk(file_.links.size(), no_cycle);
  for (std::size_t start = 0; start < file_.links.size(); ++start) {
    std::size_t link = start;
    while (walk[link] == no_cycle && parent_joint_[link] != no_joint) {
      walk[link] = start;
      link = parent_of(link);
    }
    if (walk[link] != start || parent_joint_[link] == no_joint) continue;
    for (std::size_t member = link; cycle_of_[member] == no_cycle; member = parent_of(member)) {
      cycle_of_[member] = link;
    }
    const std::size_t j = parent_joint_[link];
    Indices& beside = child_joints_[parent_of(link)];
    beside.erase(std::find(beside.begin(), beside.end(), j));
    parent_joint_[link] = no_joint;
    leave_out(j, {.kind = ReadWarningKind::cycle, .link = name_of(link)});
  }
}

/// Sets UrdfFault::moves of the faults of the tree, and finds the orphans.
void UrdfTree::find_moving_faults() {
  const auto own = [&](std::size_t j) { return has_one_dof(file_.joints[j]) ? 1 : 0; };
  std::vector<int> longest(file_.links.size(), 0);  // moving joints of a chain down from each link
  const Indices down = links_below(roots_);
  for (auto link = down.rbegin(); link != down.rend(); ++link) {
    for (const std::size_t j : child_joints_[*link]) {
      const std::size_t child = index_.at(file_.joints[j].child);
      longest[*link] = std::max(longest[*link], own(j) + longest[child]);
    }
  }
  for (std::size_t f = file_.faults.size(); f < faults_.size(); ++f) {
    const auto child = index_.find(file_.joints[*faults_[f].index].child);
    if (child == index_.end() || parent_joint_[child->second] != no_joint) continue;
    orphans_.emplace(child->second, f);
  }
  int arm = 0;
  for (const std::size_t root : roots_) {
    if (!orphans_.contains(root)) arm = std::max(arm, longest[root]);
  }
  int compared = 0;
  for (std::size_t f = file_.faults.size(); f < faults_.size(); ++f) {
    UrdfFault& fault = faults_[f];
    const UrdfFile::Joint& joint = file_.joints[*fault.index];
    const auto child = index_.find(joint.child);
    const int moving = own(*fault.index) + (child == index_.end() ? 0 : longest[child->second]);
    fault.moves = moving > 0;
    if (fault.warning.kind != ReadWarningKind::unknown_link || !fault.moves) continue;
    if (index_.contains(joint.parent) || moving >= arm) continue;
    constexpr int most_compared = 20;
    fault.moves = child != index_.end() && (compared++ >= most_compared || misspelt(joint.parent));
  }
}

/// Whether a name resembles the name of a link. True in a very large file.
bool UrdfTree::misspelt(const std::string& name) const {
  constexpr std::size_t most_compared = 1000;
  if (file_.links.size() > most_compared) return true;
  std::vector<std::string> known;
  for (const auto& link : file_.links) known.push_back(link.name);
  return nearest_name(name, known) != nullptr;
}

std::size_t UrdfTree::base(const std::string& name) const {
  if (!name.empty()) return link_called(name, "base link");
  Indices roots;
  for (const std::size_t root : roots_) {
    if (!orphans_.contains(root)) roots.push_back(root);
  }
  if (roots.empty()) {
    std::size_t first = faults_.size();
    for (const auto& [link, fault] : orphans_) first = std::min(first, fault);
    throw error_of(file_, faults_[first]);
  }
  if (roots.size() == 1) return roots.front();
  for (const UrdfFault& fault : faults_) {
    if (parts_tree(fault)) throw error_of(file_, fault);
  }
  if (file_.joints.empty()) refuse("has links, but no joints between them");
  refuse("has " + std::to_string(roots.size()) +
         " roots; choose the base: " + listed(names_of(roots)));
}

UrdfTree::Tip UrdfTree::tip(const std::string& name, std::size_t base) const {
  if (!name.empty()) return {.link = link_called(name, "tip link")};
  std::vector<End> ends = moved_ends(base, Way::down);
  const bool below = !ends.empty();
  if (!below) ends = moved_ends(base, Way::any);
  if (ends.empty()) return {.link = links_below({base}).back()};  // refused with the reason
  const auto tool = std::find_if(ends.begin(), ends.end(),
                                 [&](const End& end) { return name_of(end.link) == "tool0"; });
  const bool one_body = std::all_of(ends.begin(), ends.end(),
                                    [&](const End& end) { return end.body == ends.front().body; });
  const auto names = [&] {
    Indices links;
    for (const End& end : ends) links.push_back(end.link);
    return names_of(links);
  };
  if (!one_body && tool == ends.end()) {
    refuse("has " + std::to_string(ends.size()) + " tips " + (below ? "below " : "beyond ") +
           name_of(base) + "; choose one as the tip: " + listed(names()) +
           before_gripper(ends, base));
  }
  Tip tip{.link = (tool == ends.end() ? ends.front() : *tool).link};
  if (ends.size() == 1) return tip;
  ends.erase(
      std::find_if(ends.begin(), ends.end(), [&](const End& end) { return end.link == tip.link; }));
  tip.choice = one_body ? ReadWarningKind::tip_among_frames : ReadWarningKind::tip_among_branches;
  tip.others = names();
  return tip;
}

std::vector<ChainJoint> UrdfTree::chain(std::size_t base, std::size_t tip) const {
  std::unordered_map<std::size_t, std::size_t> below;  // from an ancestor of the tip: the joint
  for (std::size_t top = tip; parent_joint_[top] != no_joint; top = parent_of(top)) {
    below.emplace(parent_of(top), parent_joint_[top]);
  }
  std::vector<ChainJoint> joints;
  std::size_t link = base;
  for (; link != tip && !below.contains(link); link = parent_of(link)) {
    if (parent_joint_[link] == no_joint) {
      if (const UrdfFault* cause = cause_of_gap(base, tip)) throw error_of(file_, *cause);
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

/// Whether the fault is of a joint that moves and has no place in the tree, or of two parents: it
/// may be why links are not connected.
bool UrdfTree::parts_tree(const UrdfFault& fault) const {
  const ReadWarningKind kind = fault.warning.kind;
  const bool lost = kind == ReadWarningKind::malformed || kind == ReadWarningKind::unknown_element;
  const bool unplaced = (lost && !fault.index) || kind == ReadWarningKind::unknown_link;
  return (unplaced && fault.moves) || kind == ReadWarningKind::two_parents;
}

/// Returns the fault that is the likely reason why two links are not connected; null if there is
/// none.
const UrdfFault* UrdfTree::cause_of_gap(std::size_t base, std::size_t tip) const {
  const UrdfFault* unconnected = nullptr;
  for (const std::size_t end : {tip, base}) {
    const auto orphan = orphans_.find(root_of(end));
    if (orphan == orphans_.end()) continue;
    const UrdfFault& fault = faults_[orphan->second];
    if (fault.warning.kind != ReadWarningKind::unconnected_link) return &fault;
    unconnected = &fault;
  }
  for (const UrdfFault& fault : faults_) {
    if (parts_tree(fault)) return &fault;
  }
  return unconnected;
}

/// Returns the ends of the tree that can be reached from the base through a joint with one degree
/// of freedom, in the file's order.
std::vector<UrdfTree::End> UrdfTree::moved_ends(std::size_t base, Way way) const {
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
      if (file_.links[link].site) continue;
      visits.push_back(
          {link, j, joint.type == "fixed" ? visit.body : link, visit.moved || has_one_dof(joint)});
    }
    if (visits.size() == known && visit.moved) ends.push_back({visit.link, visit.body});
  }
  std::sort(ends.begin(), ends.end(), [](const End& a, const End& b) { return a.link < b.link; });
  return ends;
}

std::size_t UrdfTree::parent_of(std::size_t link) const {
  return index_.at(file_.joints[parent_joint_[link]].parent);
}

std::size_t UrdfTree::root_of(std::size_t link) const {
  while (parent_joint_[link] != no_joint) link = parent_of(link);
  return link;
}

/// Returns `from` and all links below them. Links have one parent, so that this terminates.
UrdfTree::Indices UrdfTree::links_below(Indices from) const {
  for (std::size_t next = 0; next < from.size(); ++next) {
    for (const std::size_t joint : child_joints_[from[next]]) {
      from.push_back(index_.at(file_.joints[joint].child));
    }
  }
  return from;
}

std::size_t UrdfTree::link_called(const std::string& name, const char* what) const {
  const auto found = index_.find(name);
  if (found != index_.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& link : file_.links) known.push_back(link.name);
  refuse(unknown_name(what, printable(name), known).what());
}

std::vector<std::string> UrdfTree::names_of(const Indices& links) const {
  std::vector<std::string> names;
  for (const std::size_t link : links) names.push_back(name_of(link));
  return names;
}

void UrdfTree::refuse(const std::string& message, int line) const {
  throw FileError(file_.path, line, message);
}

void UrdfTree::refuse_first_fault_or(const std::string& message) const {
  if (const UrdfFault* fault = first_fault()) throw error_of(file_, *fault);
  refuse(message);
}

}  // namespace beeline::internal
