#include <algorithm>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/internal/position_columns.h>
#include <beeline/io/internal/recorded_units.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/model/catalog.h>

namespace beeline::internal {
namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::any_of(names.begin(), names.end(),
                     [&name](const std::string& other) { return same_ignoring_case(other, name); });
}

/// Throws Error if the arm's own names are columns beside the columns that are read as positions.
void check_plain_names(const Arm& arm, const std::vector<std::string>& names,
                       const JointColumns& order) {
  const std::string& read = names[static_cast<std::size_t>(order.positions.front())];
  const std::vector<std::string> joints = arm.joint_names();
  if (same_ignoring_case(read, joints.front())) return;
  const auto is_column = [&names](const std::string& joint) { return contains(names, joint); };
  if (!std::all_of(joints.begin(), joints.end(), is_column)) return;
  throw Error("columns " + in_quotes(joints.front()) + " and " + in_quotes(read) +
              " may both be positions of joint " + joints.front() +
              "; a joint map (joint_map, --joint-map) names the columns to read");
}

/// Throws Error for a column of positions whose name states another quantity or unit, apart from
/// the joint's name.
void check_quantities(const Arm& arm, const ColumnsInUnits& columns, const JointColumns& order) {
  const std::vector<std::vector<std::string>> namings = joint_namings(arm);
  for (std::size_t k = 0; k < order.positions.size(); ++k) {
    const auto column = static_cast<std::size_t>(order.positions[k]);
    std::string rest = lower_case(columns.names[column]);
    for (const std::vector<std::string>& naming : namings) {
      const std::string joint = lower_case(naming[k]);
      const std::size_t begin = rest.rfind(joint);
      if (begin == std::string::npos) continue;
      rest.replace(begin, joint.size(), " ");
      break;
    }
    const std::string_view word = other_quantity_in(rest);
    if (word.empty()) continue;
    throw Error("column " + in_quotes(columns.given[column]) + " says " +
                in_quotes(std::string(word)) +
                ", so it is not read as positions in rad, deg, m or mm; a joint map (joint_map, "
                "--joint-map) reads it nevertheless");
  }
}

}  // namespace

std::optional<std::size_t> mapped_column(const ColumnsInUnits& columns, const std::string& name) {
  for (const auto* names : {&columns.given, &columns.names}) {
    const auto found = std::find(names->begin(), names->end(), name);
    if (found != names->end()) return static_cast<std::size_t>(found - names->begin());
  }
  for (const auto* names : {&columns.given, &columns.names}) {
    const auto is_name = [&name](const std::string& other) {
      return same_ignoring_case(other, name);
    };
    if (std::count_if(names->begin(), names->end(), is_name) != 1) continue;
    const auto found = std::find_if(names->begin(), names->end(), is_name);
    return static_cast<std::size_t>(found - names->begin());
  }
  return std::nullopt;
}

void check_positions(const Arm& arm, const ColumnsInUnits& columns, const JointColumns& order) {
  check_plain_names(arm, columns.names, order);
  check_quantities(arm, columns, order);
}

}  // namespace beeline::internal
