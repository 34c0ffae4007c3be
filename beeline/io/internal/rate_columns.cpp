#include <algorithm>
#include <iterator>
#include <optional>
#include <unordered_set>

#include <beeline/error.h>
#include <beeline/internal/derived_quantity.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/internal/rate_columns.h>
#include <beeline/io/text/internal/name.h>

namespace beeline::internal {
namespace {

bool ends_with_ignoring_case(std::string_view text, std::string_view suffix) {
  return text.size() >= suffix.size() &&
         same_ignoring_case(text.substr(text.size() - suffix.size()), suffix);
}

/// A column that has a quantity of another one.
struct DerivedColumn {
  std::string of;  ///< the name of the other
  DerivedQuantity quantity = DerivedQuantity::velocity;
};

/// The word is the last part of the name or the first.
std::optional<DerivedColumn> derived_column(const std::string& name, const ColumnIndex& columns) {
  constexpr const char* gaps = "_/. ";
  const std::size_t last = name.find_last_of(gaps), first = name.find_first_of(gaps);
  if (last == std::string::npos) return std::nullopt;
  const std::pair<std::string, std::string> splits[] = {
      {name.substr(0, last), name.substr(last + 1)},
      {name.substr(first + 1), name.substr(0, first)}};
  for (const auto& [of, word] : splits) {
    const std::optional<DerivedQuantity> quantity = derived_quantity(word);
    const bool is_read_or_dropped =
        quantity && *quantity != DerivedQuantity::other && *quantity != DerivedQuantity::property;
    if (is_read_or_dropped && columns.contains(of)) return DerivedColumn{of, *quantity};
  }
  return std::nullopt;
}

}  // namespace

std::string joint_of_rate(const std::string& column) {
  for (const std::string_view suffix : {velocity_suffix, acceleration_suffix}) {
    if (ends_with_ignoring_case(column, suffix)) {
      return column.substr(0, column.size() - suffix.size());
    }
  }
  return {};
}

std::vector<std::string> with_known_suffixes(std::vector<std::string> header) {
  std::unordered_set<std::string> names(header.begin(), header.end());
  for (std::string& name : header) {
    const std::string joint = joint_of_rate(name);
    if (joint.empty() || !names.contains(joint)) continue;
    const std::string known = joint + lower_case(name.substr(joint.size()));
    if (names.insert(known).second) name = known;
  }
  return header;
}

void rename_rates(std::vector<std::string>& header, ColumnIndex& columns,
                  const std::vector<std::string>& joints) {
  std::vector<std::pair<std::string, DerivedColumn>> derived;
  for (const auto& [name, index] : columns) {
    if (std::find(joints.begin(), joints.end(), name) != joints.end()) continue;
    if (auto found = derived_column(name, columns)) derived.emplace_back(name, std::move(*found));
  }
  const std::size_t others = columns.size() - derived.size();
  for (const auto& [quantity, suffix] : {std::pair(DerivedQuantity::velocity, velocity_suffix),
                                         {DerivedQuantity::acceleration, acceleration_suffix}}) {
    std::unordered_set<std::string> joints_with;
    std::size_t count = 0;
    for (const auto& [name, column] : derived) {
      if (column.quantity != quantity) continue;
      joints_with.insert(column.of);
      ++count;
    }
    if (joints_with.size() != others || count != others) continue;
    for (const auto& [name, column] : derived) {
      if (column.quantity != quantity) continue;
      const std::size_t index = columns.at(name);
      columns.erase(name);
      header[index] = column.of + std::string(suffix);
      columns.emplace(header[index], index);
    }
  }
  for (const auto& [name, column] : derived) {
    if (column.quantity == DerivedQuantity::effort) columns.erase(name);
  }
}

std::vector<std::size_t> rate_columns(const std::vector<std::string>& joints,
                                      const ColumnIndex& columns, std::string_view suffix) {
  std::vector<std::size_t> indices;
  std::string missing;
  for (const std::string& joint : joints) {
    const auto found = columns.find(joint + std::string(suffix));
    if (found != columns.end()) {
      indices.push_back(found->second);
    } else if (missing.empty()) {
      missing = joint + std::string(suffix);
    }
  }
  if (!indices.empty() && !missing.empty()) {
    throw Error("column " + in_quotes(missing) + " is missing; all joints have " +
                std::string(suffix) + " columns, or none has");
  }
  return indices;
}

}  // namespace beeline::internal
