#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/internal/time_column.h>

namespace beeline {
namespace {

struct UnitNames {
  TimeUnit unit;
  double seconds;
  std::array<std::string_view, 7> names;  // the first is that of --time-unit; some are empty
};

constexpr UnitNames units[] = {
    {TimeUnit::seconds, 1, {"s", "sec", "secs", "second", "seconds", "", ""}},
    {TimeUnit::milliseconds,
     1e-3,
     {"ms", "msec", "msecs", "millis", "millisecond", "milliseconds", ""}},
    {TimeUnit::microseconds,
     1e-6,
     {"us", "usec", "usecs", "micros", "microsecond", "microseconds", "\xc2\xb5s"}},
    {TimeUnit::nanoseconds,
     1e-9,
     {"ns", "nsec", "nsecs", "nanos", "nanosec", "nanosecond", "nanoseconds"}}};

const UnitNames& names_of(TimeUnit unit) { return units[static_cast<std::size_t>(unit)]; }

std::optional<TimeUnit> unit_called(std::string_view name) {
  if (name.empty()) return std::nullopt;
  for (const UnitNames& unit : units) {
    if (std::find(unit.names.begin(), unit.names.end(), name) != unit.names.end()) return unit.unit;
  }
  return std::nullopt;
}

/// A name as its message and the last part, in lower case: `/joint_states/header/` and `stamp`.
std::pair<std::string, std::string> parts_of(const std::string& name) {
  const std::string text = internal::lower_case(name);
  const std::size_t end = text.find_last_of("/.");
  std::string last = end == std::string::npos ? text : text.substr(end + 1);
  last.erase(0, std::min(last.find_first_not_of("%_ "), last.size()));
  return {end == std::string::npos ? "" : text.substr(0, end), last};
}

bool is_time(std::string_view name) {
  constexpr std::string_view known[] = {"t", "time", "timestamp", "time_stamp", "stamp"};
  return std::find(std::begin(known), std::end(known), name) != std::end(known);
}

/// A column of times as its name says.
struct NamedTime {
  bool times = false;
  std::optional<TimeUnit> unit = std::nullopt;
};

NamedTime named_time(const std::string& name) {
  if (name == "T") return {};
  const std::string last = parts_of(name).second;
  if (is_time(last)) return {.times = true};
  const std::size_t begin = last.find_last_of("_ [(");
  if (begin == std::string::npos) return {};
  std::string_view stem(last.data(), begin), unit(last.data() + begin + 1, last.size() - begin - 1);
  if (unit.ends_with(']') || unit.ends_with(')')) unit.remove_suffix(1);
  while (!stem.empty() && (stem.back() == ' ' || stem.back() == '_')) stem.remove_suffix(1);
  const std::optional<TimeUnit> known = unit_called(unit);
  return is_time(stem) && known ? NamedTime{true, known} : NamedTime{};
}

/// The message and the unit of a part of a time: `/joint_states/header/stamp` and `sec`, also where
/// the name is `stamp_sec`.
std::pair<std::string, std::string> message_and_unit(const std::string& name) {
  auto [message, last] = parts_of(name);
  const std::size_t unit = last.find_last_of('_');
  if (unit == std::string::npos) return {message, last};
  const std::string stem = last.substr(0, unit);
  const std::size_t word = stem.find_last_of('_');
  if (!is_time(word == std::string::npos ? stem : stem.substr(word + 1))) return {message, last};
  return {message + '/' + stem, last.substr(unit + 1)};
}

/// The columns of seconds and nanoseconds of one message of ROS, such as sec and nanosec.
std::optional<internal::TimeColumns> stamp_columns(const std::vector<std::string>& names) {
  using internal::TimeColumns;
  std::unordered_map<std::string, std::size_t> nanoseconds;  // the column of each message
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto [message, unit] = message_and_unit(names[i]);
    if (unit_called(unit) == TimeUnit::nanoseconds) nanoseconds.emplace(message, i);
  }
  std::optional<TimeColumns> alone;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto [message, unit] = message_and_unit(names[i]);
    if (unit_called(unit) != TimeUnit::seconds || unit == "s") continue;
    const auto found = nanoseconds.find(message);
    if (found != nanoseconds.end()) {
      return TimeColumns{.index = i, .nanoseconds = found->second, .unit = TimeUnit::seconds};
    }
    if (!alone) alone = TimeColumns{.index = i, .unit = TimeUnit::seconds};
  }
  return alone;
}

bool contains(const std::vector<std::size_t>& columns, std::size_t column) {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

/// Whether the column is one of the two of a time in seconds and nanoseconds.
bool is_part(const internal::TimeColumns& stamp, std::size_t column) {
  return stamp.nanoseconds && (column == stamp.index || column == *stamp.nanoseconds);
}

}  // namespace

std::string name(TimeUnit unit) { return std::string(names_of(unit).names.front()); }

std::vector<std::string> time_unit_names() {
  std::vector<std::string> names;
  for (const UnitNames& unit : units) names.emplace_back(unit.names.front());
  return names;
}

TimeUnit time_unit_named(const std::string& name) {
  for (const UnitNames& unit : units) {
    if (unit.names.front() == name) return unit.unit;
  }
  throw unknown_name("unit of time", name, time_unit_names());
}

namespace internal {

std::optional<TimeColumns> time_columns(const std::vector<std::string>& names) {
  const auto plain = std::find(names.begin(), names.end(), "t");
  if (plain != names.end()) {
    return TimeColumns{.index = static_cast<std::size_t>(plain - names.begin())};
  }
  std::optional<TimeColumns> found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto [times, unit] = named_time(names[i]);
    if (!times) continue;
    if (found) {
      found->others.push_back(i);
    } else {
      found = TimeColumns{.index = i, .unit = unit};
    }
  }
  std::optional<TimeColumns> stamp = stamp_columns(names);
  if (!found && !stamp) {
    const auto upper = std::find(names.begin(), names.end(), "T");
    if (upper == names.end()) return std::nullopt;
    return TimeColumns{.index = static_cast<std::size_t>(upper - names.begin())};
  }
  if (!found || !stamp) return found ? found : stamp;
  if (is_part(*stamp, found->index)) {
    for (const std::size_t i : found->others) {
      if (!is_part(*stamp, i)) stamp->others.push_back(i);
    }
    return stamp;
  }
  for (const std::optional<std::size_t> i : {std::optional(stamp->index), stamp->nanoseconds}) {
    if (i && !contains(found->others, *i) && *i != found->index) found->others.push_back(*i);
  }
  return found;
}

bool names_times(const std::vector<std::string>& names) { return time_columns(names).has_value(); }

bool is_since_1970(double seconds) {
  constexpr double year_1973 = 1e8;
  return std::abs(seconds) >= year_1973;
}

TimeUnit unit_of_times(double first) {
  // Times since 1970 of the years 1973 to 5138, the ranges of the units do not overlap.
  const double size = std::abs(first);
  if (size >= 1e17) return TimeUnit::nanoseconds;
  if (size >= 1e14) return TimeUnit::microseconds;
  return size >= 1e11 ? TimeUnit::milliseconds : TimeUnit::seconds;
}

double seconds_per(TimeUnit unit) { return names_of(unit).seconds; }

}  // namespace internal
}  // namespace beeline
