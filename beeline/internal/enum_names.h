#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/error.h>

namespace beeline::internal {

/// The names of the enumerators up to `last`, which count from 0, in their order.
template <auto last>
class EnumNames {
 public:
  using Enum = decltype(last);

  /// `what` is the kind of name in errors; `names` are separated by single spaces.
  consteval EnumNames(std::string_view what, std::string_view names) : what_(what) {
    for (std::string_view& name : names_) {
      if (names.empty()) throw "too few names";
      const std::size_t end = std::min(names.find(' '), names.size());
      name = names.substr(0, end);
      names.remove_prefix(std::min(end + 1, names.size()));
    }
    if (!names.empty()) throw "too many names";
  }

  /// Throws std::out_of_range for a value that is not an enumerator.
  std::string of(Enum value) const {
    return std::string(names_.at(static_cast<std::size_t>(value)));
  }

  std::vector<std::string> all() const { return {names_.begin(), names_.end()}; }

  /// Returns the enumerator of a name. Throws Error, which lists all names, for another name.
  Enum named(std::string_view name) const {
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) throw unknown_name(what_, name, all());
    return static_cast<Enum>(found - names_.begin());
  }

 private:
  std::string_view what_;
  std::array<std::string_view, static_cast<std::size_t>(last) + 1> names_;
};

}  // namespace beeline::internal
