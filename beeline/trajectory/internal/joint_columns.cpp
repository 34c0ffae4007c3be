#include <algorithm>
#include <optional>
#include <unordered_map>

#include <beeline/error.h>
#include <beeline/internal/derived_quantity.h>
#include <beeline/internal/letter_case.h>
#include <beeline/model/catalog.h>
#include <beeline/trajectory/internal/joint_columns.h>

namespace beeline::internal {
namespace {

using Names = std::vector<std::string>;
using Index = std::unordered_map<std::string, Eigen::Index>;

/// Words of columns of one quantity, as tables of ROS's joint states have them: the position, the
/// velocity and the acceleration.
constexpr std::string_view quantity_words[][3] = {{"position", "velocity", "acceleration"},
                                                  {"positions", "velocities", "accelerations"},
                                                  {"pos", "vel", "acc"}};

/// Endings that a column of positions may have after the name of the joint.
constexpr const char* position_endings[] = {"", "/position", ".position", "_position", "_pos"};

/// The texts before and behind each name of a naming that make the names of columns.
struct Affixes {
  std::string front;
  std::size_t ending = 0;
  std::vector<Eigen::Index> columns;
};

/// Whether characters i to end of the name are a word of it.
bool is_word(std::string_view name, std::size_t i, std::size_t end) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return (i == 0 || !is_letter(name[i - 1])) && (end == name.size() || !is_letter(name[end]));
}

/// The name with the last word `from` replaced; none if it does not have this word.
std::optional<std::string> with_word(const std::string& name, std::string_view from,
                                     std::string_view to) {
  for (std::size_t i = name.rfind(from); i != std::string::npos; i = name.rfind(from, i - 1)) {
    if (is_word(name, i, i + from.size())) return std::string(name).replace(i, from.size(), to);
    if (i == 0) break;
  }
  return std::nullopt;
}

bool says_position(const std::string& text) {
  return std::any_of(
      std::begin(quantity_words), std::end(quantity_words),
      [&text](const auto& words) { return with_word(text, words[0], "").has_value(); });
}

/// The columns of velocities, 1, or accelerations, 2, beside columns of positions with these names;
/// none if one is missing: then those that are there are added to `incomplete`.
std::vector<Eigen::Index> rates_beside(const Names& positions, int quantity, const Index& index,
                                       std::vector<Eigen::Index>& incomplete) {
  std::vector<Eigen::Index> some;
  for (const auto& from : quantity_words) {
    for (const auto& to : quantity_words) {
      std::vector<Eigen::Index> columns;
      for (const std::string& position : positions) {
        const auto name = with_word(position, from[0], to[quantity]);
        const auto found = name ? index.find(*name) : index.end();
        if (found != index.end()) columns.push_back(found->second);
      }
      if (columns.size() == positions.size()) return columns;
      some.insert(some.end(), columns.begin(), columns.end());
    }
  }
  incomplete.insert(incomplete.end(), some.begin(), some.end());
  return {};
}

/// Adds the columns of rates that belong to the columns of positions.
void add_rates(const Names& names, const Index& index, JointColumns& columns) {
  Names positions;
  for (const Eigen::Index i : columns.positions) {
    positions.push_back(names[static_cast<std::size_t>(i)]);
  }
  std::vector<Eigen::Index>& unread = columns.unread_rates;
  columns.velocities = rates_beside(positions, 1, index, unread);
  columns.accelerations = rates_beside(positions, 2, index, unread);
  if (!columns.velocities.empty()) return;
  unread.insert(unread.end(), columns.accelerations.begin(), columns.accelerations.end());
  columns.accelerations.clear();
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

/// Finds all affixes with which the names of a naming are names of columns.
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
        found.push_back({front, e, std::move(*columns)});
      }
    }
  }
}

/// The same for all namings.
std::vector<Affixes> affixes_in(const Names& names, const Index& index,
                                const std::vector<Names>& namings) {
  std::vector<Affixes> found;
  for (const Names& naming : namings) find_affixes(names, index, naming, found);
  // If the names do not say that they are of positions, another column is a joint too many, and
  // they may be of other quantities.
  std::erase_if(found, [&](const Affixes& affixes) {
    return affixes.ending == 0 && !says_position(affixes.front) &&
           (names.size() != affixes.columns.size() || says_derived_quantity(affixes.front));
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

/// The names of the joints' columns beside others, in a naming that has all of them; otherwise the
/// arm's names.
Names names_meant(const Arm& arm, const Names& names) {
  std::vector<Affixes> found;
  for (const Names& naming : joint_namings(arm))
    find_affixes(names, index_of(names), naming, found);
  std::erase_if(found, [](const Affixes& each) { return says_derived_quantity(each.front); });
  if (found.size() != 1) return arm.joint_names();
  Names meant;
  for (const Eigen::Index i : found.front().columns) {
    meant.push_back(names[static_cast<std::size_t>(i)]);
  }
  return meant;
}

[[noreturn]] void refuse_names(const Arm& arm, const Names& names) {
  const Names joints = names_meant(arm, names);
  std::vector<std::string> missing, unknown = names;
  for (const std::string& joint : joints) {
    if (std::erase(unknown, joint) == 0) missing.push_back(joint);
  }
  std::string text = "the trajectory does not fit arm " + arm.name() + ":";
  if (!missing.empty()) text += " it lacks " + listed(missing) + ";";
  for (const Joint& joint : arm.joints()) {
    if (!joint.mimic || std::erase(unknown, joint.name) == 0) continue;
    text += " " + joint.name + " follows " + joint.mimic->leader + ";";
  }
  if (!unknown.empty()) text += " the arm has no " + listed(unknown) + ";";
  text += " the arm's joints are " + listed(joints);
  if (missing.empty()) {
    text += "; a joint map (joint_map, --joint-map) of these names leaves other columns out";
  } else if (!unknown.empty()) {
    text += "; a joint map (joint_map, --joint-map) names the trajectory's joints in this order";
  }
  throw Error(text);
}

/// The column of a name: upper and lower case are alike, except between names that differ only in
/// it.
Eigen::Index column_named(const std::string& name, const Names& names, const Index& index) {
  const auto exact = index.find(name);
  if (exact != index.end()) return exact->second;
  std::optional<Eigen::Index> found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!same_ignoring_case(names[i], name)) continue;
    if (found) throw unknown_name("joint of the joint_map", name, names);
    found = static_cast<Eigen::Index>(i);
  }
  if (!found) throw unknown_name("joint of the joint_map", name, names);
  return *found;
}

JointColumns mapped_columns(const Arm& arm, const Names& names, const Index& index,
                            const JointMap& joint_map) {
  JointColumns columns;
  if (static_cast<int>(joint_map.size()) != arm.dof()) {
    throw Error("the ", "joint_map",
                " has " + std::to_string(joint_map.size()) + " names; arm " + arm.name() +
                    " needs " + std::to_string(arm.dof()) + ", for " + listed(arm.joint_names()));
  }
  for (const MappedJoint& joint : joint_map) {
    const Eigen::Index column = column_named(joint.name, names, index);
    if (std::count(columns.positions.begin(), columns.positions.end(), column) > 0) {
      throw Error("the ", "joint_map", " gives " + joint.name + " to two joints");
    }
    columns.positions.push_back(column);
  }
  add_rates(names, index, columns);
  return columns;
}

}  // namespace

bool names_all_joints(const Arm& arm, const Names& columns) {
  const Names lower = lower_case(columns);
  const std::vector<Names> namings = joint_namings(arm);
  return std::any_of(namings.begin(), namings.end(), [&lower](const Names& naming) {
    return std::all_of(naming.begin(), naming.end(), [&lower](const std::string& joint) {
      const std::string wanted = internal::lower_case(joint);
      return std::any_of(lower.begin(), lower.end(), [&wanted](const std::string& column) {
        return column.find(wanted) != std::string::npos;
      });
    });
  });
}

JointColumns joint_columns(const Arm& arm, const Names& names, const JointMap& joint_map) {
  const Names own = arm.joint_names();
  if (joint_map.empty() && names == own) {
    JointColumns same;
    for (Eigen::Index k = 0; k < arm.dof(); ++k) same.positions.push_back(k);
    return same;
  }
  Names known = names;
  Index index = index_of(known);
  if (!joint_map.empty()) return mapped_columns(arm, names, index, joint_map);
  std::vector<Names> namings = joint_namings(arm);
  std::vector<Affixes> found = affixes_in(known, index, namings);
  if (found.empty()) {
    known = lower_case(names);
    index = index_of(known);
    for (Names& naming : namings) naming = lower_case(naming);
    if (index.size() == names.size()) found = affixes_in(known, index, namings);
  }
  if (found.size() != 1) refuse_names(arm, names);
  JointColumns columns{found.front().columns, {}, {}};
  add_rates(known, index, columns);
  return columns;
}

}  // namespace beeline::internal
