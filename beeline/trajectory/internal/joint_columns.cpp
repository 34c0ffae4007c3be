#include <algorithm>
#include <optional>
#include <unordered_map>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/model/catalog.h>
#include <beeline/trajectory/internal/joint_columns.h>

namespace beeline::internal {
namespace {

using Names = std::vector<std::string>;
using Index = std::unordered_map<std::string, Eigen::Index>;

/// Endings of columns of one quantity, as tables of ROS's joint states have them. A velocity has
/// the ending at the same place.
constexpr const char* position_endings[] = {"", "/position", ".position", "_position", "_pos"};
constexpr const char* velocity_endings[] = {"", "/velocity", ".velocity", "_velocity", "_vel"};
constexpr const char* acceleration_endings[] = {"", "/acceleration", ".acceleration",
                                                "_acceleration", "_acc"};

/// The texts before and behind each name of a naming that make the names of columns.
struct Affixes {
  const Names* naming = nullptr;
  std::string front;
  std::size_t ending = 0;
  std::vector<Eigen::Index> columns;
};

/// The lists of names that the arm's joints have: its own, and those of the maker.
std::vector<Names> namings_of(const Arm& arm) {
  std::vector<Names> namings{arm.joint_names()};
  for (const BuiltInArm& about : built_in_arms()) {
    if (about.name != arm.name()) continue;
    if (built_in(about.name).joint_names() != namings.front()) continue;
    namings.insert(namings.end(), about.joint_names.begin(), about.joint_names.end());
  }
  return namings;
}

/// The columns front + name + ending of all names; none if one is missing.
std::optional<std::vector<Eigen::Index>> columns_of(const Index& index, const Names& naming,
                                                    const std::string& front, const char* ending) {
  std::vector<Eigen::Index> columns;
  for (const std::string& joint : naming) {
    const auto found = index.find(front + joint + ending);
    if (found == index.end()) return std::nullopt;
    columns.push_back(found->second);
  }
  return columns;
}

/// All ways to find the names of a naming, with a text in front, in those of the columns.
void find_affixes(const Names& names, const Index& index, const Names& naming,
                  std::vector<Affixes>& found) {
  for (std::size_t e = 0; e < std::size(position_endings); ++e) {
    const std::string last = naming.front() + position_endings[e];
    for (const std::string& name : names) {
      if (!name.ends_with(last)) continue;
      const std::string front = name.substr(0, name.size() - last.size());
      auto columns = columns_of(index, naming, front, position_endings[e]);
      const auto is_same = [&](const Affixes& other) { return other.columns == columns; };
      if (columns && std::none_of(found.begin(), found.end(), is_same)) {
        found.push_back({&naming, front, e, std::move(*columns)});
      }
    }
  }
}

/// The same for all namings.
std::vector<Affixes> affixes_in(const Names& names, const Index& index,
                                const std::vector<Names>& namings) {
  std::vector<Affixes> found;
  for (const Names& naming : namings) find_affixes(names, index, naming, found);
  // Without an ending all columns are joints, so that another one is a joint too many.
  std::erase_if(found, [&](const Affixes& affixes) {
    return affixes.ending == 0 && names.size() != affixes.naming->size();
  });
  return found;
}

Index index_of(const Names& names) {
  Index index;
  for (std::size_t i = 0; i < names.size(); ++i) {
    index.emplace(names[i], static_cast<Eigen::Index>(i));
  }
  return index;
}

Names lower_case(Names names) {
  for (std::string& name : names) name = internal::lower_case(name);
  return names;
}

[[noreturn]] void refuse_names(const Arm& arm, const Names& names) {
  std::vector<std::string> missing, unknown = names;
  for (const std::string& joint : arm.joint_names()) {
    if (std::erase(unknown, joint) == 0) missing.push_back(joint);
  }
  std::string text = "the trajectory does not fit arm " + arm.name() + ":";
  if (!missing.empty()) text += " it lacks " + listed(missing) + ";";
  if (!unknown.empty()) text += " the arm has no " + listed(unknown) + ";";
  text += " the arm's joints are " + listed(arm.joint_names());
  if (!unknown.empty()) {
    text += "; a joint map (joint_map, --joint-map) names the trajectory's joints in this order";
  }
  throw Error(text);
}

JointColumns mapped_columns(const Arm& arm, const Names& names, const Index& index,
                            const JointMap& joint_map) {
  JointColumns columns;
  if (static_cast<int>(joint_map.size()) != arm.dof()) {
    throw Error("the joint_map has " + std::to_string(joint_map.size()) + " names; arm " +
                arm.name() + " needs " + std::to_string(arm.dof()) + ", for " +
                listed(arm.joint_names()));
  }
  for (const MappedJoint& joint : joint_map) {
    const auto found = index.find(joint.name);
    if (found == index.end()) {
      throw unknown_name("joint of the joint_map", joint.name, names);
    }
    if (std::count(columns.positions.begin(), columns.positions.end(), found->second) > 0) {
      throw Error("the joint_map gives " + joint.name + " to two joints");
    }
    columns.positions.push_back(found->second);
  }
  return columns;
}

}  // namespace

JointColumns joint_columns(const Arm& arm, const Names& names, const JointMap& joint_map) {
  const Names own = arm.joint_names();
  if (joint_map.empty() && names == own) {
    JointColumns same;
    for (Eigen::Index k = 0; k < arm.dof(); ++k) same.positions.push_back(k);
    return same;
  }
  Index index = index_of(names);
  if (!joint_map.empty()) return mapped_columns(arm, names, index, joint_map);
  std::vector<Names> namings = namings_of(arm);
  std::vector<Affixes> found = affixes_in(names, index, namings);
  if (found.empty()) {
    const Names lower = lower_case(names);
    index = index_of(lower);
    for (Names& naming : namings) naming = lower_case(naming);
    if (index.size() == names.size()) found = affixes_in(lower, index, namings);
  }
  if (found.size() != 1) refuse_names(arm, names);
  const auto& [naming, front, ending, positions] = found.front();
  JointColumns columns{positions, {}, {}};
  if (ending == 0) return columns;
  const auto rates = [&, &naming = naming, &front = front](const char* behind) {
    return columns_of(index, *naming, front, behind).value_or(std::vector<Eigen::Index>());
  };
  columns.velocities = rates(velocity_endings[ending]);
  if (!columns.velocities.empty()) columns.accelerations = rates(acceleration_endings[ending]);
  return columns;
}

}  // namespace beeline::internal
