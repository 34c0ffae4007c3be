#include <map>
#include <optional>
#include <string>

#include <beeline/error.h>
#include <beeline/io/text/internal/collision_matrix.h>
#include <beeline/io/text/internal/name.h>

namespace beeline::internal {
namespace {

constexpr std::size_t max_matrix_names = 10'000, max_matrix_pairs = 100'000;

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

/// A name that a matrix concerns: the index of its row, and its default.
struct MatrixName {
  std::string name;
  std::optional<std::size_t> row;
  std::optional<bool> by_default;
};

/// The names of a matrix and its entries.
class Matrix {
 public:
  Matrix(const RosMessage& message, const Scene& scene) {
    message.check_keys(
        {"entry_names", "entry_values", "default_entry_names", "default_entry_values"});
    std::map<std::string, MatrixName> names;
    const auto named = [&](const std::string& name) -> MatrixName& {
      return names.try_emplace(name, MatrixName{name, {}, {}}).first->second;
    };
    const std::vector<RosMessage> rows = message.items("entry_values");
    const std::vector<std::string> entries = names_of(message, "entry_names", rows.size());
    for (std::size_t i = 0; i < entries.size(); ++i) {
      MatrixName& name = named(entries[i]);
      if (name.row) rows[i].refuse("is of " + in_quotes(name.name) + ", which has another row");
      name.row = i;
      entries_.push_back(row_of(rows[i], entries.size()));
    }
    const std::vector<RosMessage> values = message.items("default_entry_values");
    const std::vector<std::string> defaults =
        names_of(message, "default_entry_names", values.size());
    for (std::size_t i = 0; i < defaults.size(); ++i) {
      named(defaults[i]).by_default = values[i].boolean();
    }
    if (!defaults.empty()) {
      for (const Obstacle& obstacle : scene.obstacles) named(obstacle.name);
    }
    for (auto& [key, name] : names) names_.push_back(std::move(name));
  }

  const std::vector<MatrixName>& names() const { return names_; }

  bool allows(const MatrixName& a, const MatrixName& b) const {
    bool any = false, all = true;
    const auto ask = [&](bool allowed) {
      any = true;
      all = all && allowed;
    };
    if (a.row && b.row) {
      ask(entries_[*a.row][*b.row]);
      ask(entries_[*b.row][*a.row]);
    }
    if (a.by_default) ask(*a.by_default);
    if (b.by_default) ask(*b.by_default);
    return any && all;
  }

 private:
  /// Returns the names of a list that has one for each of `count` values.
  static std::vector<std::string> names_of(const RosMessage& message, const std::string& key,
                                           std::size_t count) {
    std::vector<std::string> names;
    for (const RosMessage& item : message.items(key)) {
      names.push_back(item.text());
      try {
        check_name(names.back(), "the name");
      } catch (const Error& error) {
        item.refuse(error.what());
      }
    }
    if (names.size() == count) return names;
    message.refuse("has " + std::to_string(count) + " values for " + std::to_string(names.size()) +
                   " " + key);
  }

  std::vector<MatrixName> names_;
  std::vector<std::vector<bool>> entries_;
};

}  // namespace

std::vector<NamedPair> exempted_pairs(const RosMessage& message, const Scene& scene) {
  const Matrix matrix(message, scene);
  const std::vector<MatrixName>& names = matrix.names();
  std::vector<NamedPair> pairs;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names.size() > max_matrix_names) break;
    for (std::size_t j = i + 1; j < names.size(); ++j) {
      if (matrix.allows(names[i], names[j])) pairs.push_back({names[i].name, names[j].name});
      if (pairs.size() > max_matrix_pairs) break;
    }
  }
  if (names.size() <= max_matrix_names && pairs.size() <= max_matrix_pairs) return pairs;
  message.refuse("concerns " + std::to_string(names.size()) + " names; up to " +
                 std::to_string(max_matrix_names) + " names and " +
                 std::to_string(max_matrix_pairs) + " allowed pairs are read");
}

}  // namespace beeline::internal
