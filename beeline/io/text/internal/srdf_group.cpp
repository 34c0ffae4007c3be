#include <set>
#include <unordered_map>
#include <unordered_set>

#include <beeline/error.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/link_tree.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/srdf_file.h>
#include <beeline/io/text/internal/urdf_chain.h>
#include <beeline/io/text/internal/xacro.h>
#include <beeline/io/text/urdf.h>

namespace beeline {
namespace {

using internal::UrdfFile;

constexpr std::size_t max_chains = 100;  // each takes the time of a walk through the whole tree

/// Collects the members of a group and of the groups in it.
class GroupMembers {
 public:
  GroupMembers(const Srdf& srdf, const UrdfFile& urdf) : srdf_(srdf), urdf_(urdf) {
    for (const Srdf::Group& group : srdf.groups) group_.emplace(group.name, &group);
    for (std::size_t j = 0; j < urdf.joints.size(); ++j) {
      joint_.emplace(urdf.joints[j].name, j);
      joint_above_.emplace(urdf.joints[j].child, j);
    }
    for (const auto& link : urdf.links) links_.insert(link.name);
    virtual_.insert(srdf.virtual_joints.begin(), srdf.virtual_joints.end());
  }

  /// Groups may contain each other: each is added once.
  void add(const std::string& name) {
    std::vector<const Srdf::Group*> pending{&group_called(name)};
    std::set<const Srdf::Group*> known{pending.front()};
    while (!pending.empty()) {
      const Srdf::Group& group = *pending.back();
      pending.pop_back();
      add_members(group);
      for (const std::string& inner : group.groups) {
        const Srdf::Group* const found = &group_called(inner, group.line);
        if (known.insert(found).second) pending.push_back(found);
      }
    }
  }

  const std::vector<ChainEnds>& chains() const { return chains_; }
  const std::set<std::size_t>& joints() const { return joints_; }

 private:
  const Srdf::Group& group_called(const std::string& name, int line = 0) const {
    const auto found = group_.find(name);
    if (found != group_.end()) return *found->second;
    std::vector<std::string> names;
    for (const Srdf::Group& group : srdf_.groups) names.push_back(group.name);
    throw FileError(srdf_.path, line,
                    unknown_name("group", internal::printable(name), names).what());
  }

  void add_members(const Srdf::Group& group) {
    const auto refuse = [&](const char* what, const std::string& name,
                            const std::vector<std::string>& known) {
      throw FileError(srdf_.path, group.line,
                      "group " + group.name + " has an " +
                          unknown_name(what, internal::printable(name), known).what());
    };
    for (const std::string& name : group.joints) {
      const auto joint = joint_.find(name);
      if (joint != joint_.end()) {
        joints_.insert(joint->second);
      } else if (!virtual_.contains(name)) {
        std::vector<std::string> known;
        for (const auto& each : urdf_.joints) known.push_back(each.name);
        refuse("joint", name, known);
      }
    }
    std::vector<std::string> links = group.links;
    for (const ChainEnds& ends : group.chains) {
      chains_.push_back(ends);
      links.insert(links.end(), {ends.base, ends.tip});
    }
    for (const std::string& name : links) {
      if (links_.contains(name)) continue;
      std::vector<std::string> known;
      for (const auto& each : urdf_.links) known.push_back(each.name);
      refuse("link", name, known);
    }
    for (const std::string& name : group.links) {  // a link stands for the joint above it
      const auto joint = joint_above_.find(name);
      if (joint != joint_above_.end()) joints_.insert(joint->second);
    }
  }

  const Srdf& srdf_;
  const UrdfFile& urdf_;
  std::unordered_map<std::string, const Srdf::Group*> group_;
  std::unordered_map<std::string, std::size_t> joint_, joint_above_;
  std::unordered_set<std::string> links_, virtual_;
  std::vector<ChainEnds> chains_;
  std::set<std::size_t> joints_;
};

}  // namespace

ChainEnds internal::group_ends(const Srdf& srdf, const std::string& group, std::string_view urdf,
                               const std::string& path) {
  const ExpandedText expanded(urdf, path);
  const UrdfFile file = parse_link_tree(expanded.text(), path);
  GroupMembers members(srdf, file);
  members.add(group);
  try {
    if (members.joints().empty() && members.chains().size() == 1) return members.chains().front();
    std::set<std::size_t> joints = members.joints();
    if (members.chains().size() > max_chains) {
      throw Error("has more than " + std::to_string(max_chains) + " chains");
    }
    const UrdfTree tree(file);
    for (const ChainEnds& ends : members.chains()) {
      for (const ChainJoint& joint : cut_chain(tree, ends)) joints.insert(joint.index);
    }
    return tree.ends_of({joints.begin(), joints.end()});
  } catch (const FileError&) {
    throw;
  } catch (const Error& error) {
    throw FileError(srdf.path, 0, "group " + group + " " + error.what());
  }
}

ChainEnds group_ends(const Srdf& srdf, const std::string& group, const std::string& urdf_path) {
  if (!has_link_tree_ending(urdf_path)) {
    throw Error("a group selects a chain of a URDF file; " + internal::in_quotes(urdf_path) +
                " is not one");
  }
  return internal::group_ends(srdf, group, read_file(urdf_path), urdf_path);
}

}  // namespace beeline
