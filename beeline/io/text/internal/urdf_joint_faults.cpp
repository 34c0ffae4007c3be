#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <unordered_map>

#include <beeline/io/text/internal/urdf_joint_faults.h>
#include <beeline/model/internal/axis_direction.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {
namespace {

constexpr std::size_t no_leader = static_cast<std::size_t>(-1);

bool has_known_type(const UrdfFile& file, const UrdfFile::Joint& joint) {
  if (file.is_mjcf) return true;  // its reader refuses others
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
  std::size_t leader(std::size_t joint) const { return leader_[joint]; }

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

/// The value of a joint whose leaders, followed one after another, end in the fixed joint `leader`.
struct ConstantValue {
  double number = 0;
  std::string leader = {};
};

/// Follows each joint once.
class ConstantValues {
 public:
  ConstantValues(const UrdfFile& file, const Leaders& leaders) : file_(file), leaders_(leaders) {
    values_.resize(file.joints.size());
    visited_.resize(file.joints.size(), false);
  }

  const std::optional<ConstantValue>& of(std::size_t joint) {
    Indices walk;
    for (std::size_t j = joint; follows(j) && !visited_[j]; j = leaders_.leader(j)) {
      visited_[j] = true;
      walk.push_back(j);
    }
    for (auto j = walk.rbegin(); j != walk.rend(); ++j) {
      const std::size_t leader = leaders_.leader(*j);
      const beeline::Mimic& mimic = *file_.joints[*j].mimic;
      if (file_.joints[leader].type == "fixed") {
        values_[*j] = {mimic.offset, file_.joints[leader].name};
      } else if (values_[leader]) {
        values_[*j] = {mimic.multiplier * values_[leader]->number + mimic.offset,
                       values_[leader]->leader};
      }
    }
    return values_[joint];
  }

 private:
  using Indices = std::vector<std::size_t>;

  bool follows(std::size_t joint) const {
    return has_one_dof(file_.joints[joint]) && file_.joints[joint].mimic && leaders_.known(joint) &&
           !leaders_.endless(joint);
  }

  const UrdfFile& file_;
  const Leaders& leaders_;
  std::vector<std::optional<ConstantValue>> values_;
  std::vector<bool> visited_;
};

/// Whether the joint follows a joint that moves, with multiplier 0.
bool is_constant_follower(const UrdfFile& file, const Leaders& leaders, std::size_t j) {
  const UrdfFile::Joint& joint = file.joints[j];
  return has_one_dof(joint) && joint.mimic && joint.mimic->multiplier == 0 && leaders.known(j) &&
         file.joints[leaders.leader(j)].type != "fixed";
}

/// A limit of a rate, by the name that URDF gives it.
struct RateLimit {
  const char* attribute;
  double Limits::*limit;
};
constexpr RateLimit rate_limits[] = {{"velocity", &Limits::velocity},
                                     {"acceleration", &Limits::acceleration},
                                     {"jerk", &Limits::jerk}};

/// Makes the joints that follow a fixed joint fixed themselves.
void fix_constant_joints(UrdfFile& file, const Leaders& leaders) {
  ConstantValues values(file, leaders);
  std::vector<std::pair<std::size_t, double>> constant;
  for (std::size_t j = 0; j < file.joints.size(); ++j) {
    const UrdfFile::Joint& joint = file.joints[j];
    const std::optional<ConstantValue>& value = values.of(j);
    if (!value || !std::isfinite(value->number) || !has_direction(joint.axis)) continue;
    constant.emplace_back(j, value->number);
    file.faults.push_back({.warning = {.kind = ReadWarningKind::constant_mimic,
                                       .line = joint.mimic_line,
                                       .joint = joint.name,
                                       .value = value->leader,
                                       .numbers = {value->number}},
                           .index = j});
  }
  for (const auto& [j, value] : constant) {
    UrdfFile::Joint& joint = file.joints[j];
    const bool slides = joint.type == "prismatic";
    const double angle_or_length = slides ? value : std::remainder(value, 2 * std::numbers::pi);
    joint.origin = joint.origin * se3_exp(screw_of(joint) * angle_or_length);
    joint.type = "fixed";
    joint.mimic.reset();
  }
}

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
    if (!has_known_type(file, joint))
      add(ReadWarningKind::unknown_type, joint.line, {}, joint.type);
    if (!has_direction(joint.axis)) {
      add(ReadWarningKind::zero_axis, joint.axis_line,
          {joint.axis.x(), joint.axis.y(), joint.axis.z()});
    }
    const Limits& limits = joint.limits;
    if (limits.lower > limits.upper) {
      add(ReadWarningKind::limits_reversed, joint.limit_line, {limits.lower, limits.upper});
    }
    for (const RateLimit& rate : rate_limits) {
      if (limits.*rate.limit >= Limits::min_rate) continue;
      add(ReadWarningKind::rate_limit, joint.limit_line, {limits.*rate.limit});
      file.faults.back().warning.attribute = rate.attribute;
    }
    if (joint.mimic && !leaders.known(j)) {
      add(ReadWarningKind::unknown_leader, joint.mimic_line, {}, joint.mimic->leader);
    }
    if (is_constant_follower(file, leaders, j)) {
      add(ReadWarningKind::zero_multiplier, joint.mimic_line, {joint.mimic->offset},
          joint.mimic->leader);
    }
    if (leaders.endless(j)) {
      add(ReadWarningKind::leader_cycle, joint.mimic_line, {}, joint.mimic->leader);
    }
  }
  fix_constant_joints(file, leaders);
}

}  // namespace beeline::internal
