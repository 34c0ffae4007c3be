#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>

#include <beeline/error.h>
#include <beeline/io/text/internal/collision_matrix.h>

namespace beeline::internal {
namespace {

constexpr std::size_t max_pairs = 10'000'000;  ///< that defaults are looked up for

/// Returns the values of a row, {enabled: [...]} or a list.
std::vector<bool> row_of(const RosMessage& row, std::size_t size) {
  std::vector<bool> values;
  const auto enabled = row.is_map() ? row.find("enabled") : std::optional(row);
  if (enabled) {
    for (const RosMessage& value : enabled->items()) values.push_back(value.boolean());
  }
  if (values.size() == size) return values;
  row.refuse("has " + std::to_string(values.size()) + " values for " + std::to_string(size) +
             " entry_names");
}

/// The entries of a matrix, and the defaults by name.
class Matrix {
 public:
  explicit Matrix(const RosMessage& message) {
    const std::vector<RosMessage> names = message.items("entry_names");
    const std::vector<RosMessage> rows = message.items("entry_values");
    require_one_for_each(message, "entry_values", rows.size(), "entry_names", names.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (!index_of_.emplace(names[i].text(), i).second) names[i].refuse("is given twice");
      entries_.push_back(row_of(rows[i], names.size()));
    }
    const std::vector<RosMessage> named = message.items("default_entry_names");
    const std::vector<RosMessage> values = message.items("default_entry_values");
    require_one_for_each(message, "default_entry_values", values.size(), "default_entry_names",
                         named.size());
    for (std::size_t i = 0; i < named.size(); ++i) {
      defaults_[named[i].text()] = values[i].boolean();
    }
  }

  bool has_defaults() const { return !defaults_.empty(); }

  /// Returns the names of entries and defaults.
  std::set<std::string> names() const {
    std::set<std::string> names;
    for (const auto& [name, value] : defaults_) names.insert(name);
    for (const auto& [name, index] : index_of_) names.insert(name);
    return names;
  }

  bool allows(const std::string& a, const std::string& b) const {
    std::vector<bool> found;
    const auto row = index_of_.find(a), column = index_of_.find(b);
    if (row != index_of_.end() && column != index_of_.end()) {
      found.push_back(entries_[row->second][column->second]);
      found.push_back(entries_[column->second][row->second]);
    }
    for (const std::string& name : {a, b}) {
      if (const auto value = defaults_.find(name); value != defaults_.end()) {
        found.push_back(value->second);
      }
    }
    return !found.empty() && std::find(found.begin(), found.end(), false) == found.end();
  }

 private:
  static void require_one_for_each(const RosMessage& message, const std::string& values,
                                   std::size_t count, const std::string& names,
                                   std::size_t expected) {
    if (count == expected) return;
    message.refuse("has " + std::to_string(count) + " " + values + " for " +
                   std::to_string(expected) + " " + names);
  }

  std::map<std::string, std::size_t> index_of_;
  std::vector<std::vector<bool>> entries_;
  std::map<std::string, bool> defaults_;
};

}  // namespace

std::vector<NamedPair> exempted_pairs(const RosMessage& message, const Scene& scene) {
  const Matrix matrix(message);
  std::set<std::string> names = matrix.names();
  if (matrix.has_defaults()) {
    for (const Obstacle& obstacle : scene.obstacles) names.insert(obstacle.name);
  }
  if (names.size() * names.size() > max_pairs) {
    message.refuse("concerns " + std::to_string(names.size()) + " names, which are too many");
  }
  std::vector<NamedPair> pairs;
  for (auto a = names.begin(); a != names.end(); ++a) {
    for (auto b = std::next(a); b != names.end(); ++b) {
      if (matrix.allows(*a, *b)) pairs.push_back({*a, *b});
    }
  }
  return pairs;
}

}  // namespace beeline::internal
