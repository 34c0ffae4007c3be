#include <algorithm>
#include <string_view>
#include <unordered_map>

#include <beeline/io/text/internal/urdf_joint_faults.h>
#include <beeline/model/internal/axis_direction.h>

namespace beeline::internal {
namespace {

constexpr std::size_t no_leader = static_cast<std::size_t>(-1);

bool has_known_type(const UrdfFile::Joint& joint) {
  const std::vector<std::string>& known = urdf_joint_types();
  return std::find(known.begin(), known.end(), joint.type) != known.end();
}

/// The joints that the joints mimic, as indices into `file.joints`. Of joints of one name the first
/// one leads.
class Leaders {
 public:
  explicit Leaders(const UrdfFile& file) : leader_(file.joints.size(), no_leader) {
    std::unordered_map<std::string_view, std::size_t> index;
    for (std::size_t j = 0; j < file.joints.size(); ++j) index.emplace(file.joints[j].name, j);
    for (std::size_t j = 0; j < file.joints.size(); ++j) {
      if (!file.joints[j].mimic) continue;
      const auto found = index.find(file.joints[j].mimic->leader);
      if (found != index.end()) leader_[j] = found->second;
    }
    find_cycles();
  }

  bool known(std::size_t joint) const { return leader_[joint] != no_leader; }
  /// Whether the leaders of the joint, followed one after another, have no last one.
  bool endless(std::size_t joint) const { return endless_[joint]; }

 private:
  /// A joint is endless if its leader is. A walk that meets itself is; each joint is walked once.
  void find_cycles() {
    constexpr std::size_t never = no_leader;
    endless_.assign(leader_.size(), false);
    std::vector<std::size_t> walked(leader_.size(), never), walk;
    for (std::size_t start = 0; start < leader_.size(); ++start) {
      walk.clear();
      std::size_t joint = start;
      for (; joint != no_leader && walked[joint] == never; joint = leader_[joint]) {
        walked[joint] = start;
        walk.push_back(joint);
      }
      if (joint == no_leader || (walked[joint] != start && !endless_[joint])) continue;
      for (const std::size_t passed : walk) endless_[passed] = true;
    }
  }

  std::vector<std::size_t> leader_;
  std::vector<bool> endless_;
};

}  // namespace

void find_joint_faults(UrdfFile& file) {
  const Leaders leaders(file);
  for (std::size_t j = 0; j < file.joints.size(); ++j) {
    const UrdfFile::Joint& joint = file.joints[j];
    const auto add = [&](ReadWarningKind kind, int line, std::vector<double> numbers,
                         std::string value = "") {
      file.faults.push_back({.warning = {.kind = kind,
                                         .line = line,
                                         .joint = joint.name,
                                         .value = std::move(value),
                                         .numbers = std::move(numbers)},
                             .index = j});
    };
    if (!has_known_type(joint)) add(ReadWarningKind::unknown_type, joint.line, {}, joint.type);
    if (!has_direction(joint.axis)) {
      add(ReadWarningKind::zero_axis, joint.axis_line,
          {joint.axis.x(), joint.axis.y(), joint.axis.z()});
    }
    const Limits& limits = joint.limits;
    if (limits.lower > limits.upper) {
      add(ReadWarningKind::limits_reversed, joint.limit_line, {limits.lower, limits.upper});
    }
    if (limits.velocity < Limits::min_rate) {
      add(ReadWarningKind::velocity_limit, joint.limit_line, {limits.velocity});
    }
    if (joint.mimic && !leaders.known(j)) {
      add(ReadWarningKind::unknown_leader, joint.mimic_line, {}, joint.mimic->leader);
    }
    if (leaders.endless(j)) {
      add(ReadWarningKind::leader_cycle, joint.mimic_line, {}, joint.mimic->leader);
    }
  }
}

}  // namespace beeline::internal
