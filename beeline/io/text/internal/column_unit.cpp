#include <algorithm>
#include <iterator>
#include <numbers>
#include <unordered_map>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/text/internal/column_unit.h>
#include <beeline/io/text/internal/foreign_unit.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/numbers.h>

namespace beeline::internal {
namespace {

struct UnitOfRate {
  std::string_view text;  // behind the unit of the coordinate
  int power;              // of 1 / s
};

/// A longer text stands before its own ending.
constexpr UnitOfRate rates[] = {{"/s^2", 2},
                                {"/s2", 2},
                                {"/s\xc2\xb2", 2},
                                {"/s/s", 2},
                                {"_s^2", 2},
                                {"_per_s2", 2},
                                {"_s2", 2},
                                {"/sec^2", 2},
                                {"/sec2", 2},
                                {"/sec\xc2\xb2", 2},
                                {"/second^2", 2},
                                {" per second squared", 2},
                                {" per second^2", 2},
                                {" per second per second", 2},
                                {" per s^2", 2},
                                {" per s2", 2},
                                {" s^-2", 2},
                                {"*s^-2", 2},
                                {" s\xe2\x81\xbb\xc2\xb2", 2},
                                {"\xc2\xb7s\xe2\x81\xbb\xc2\xb2", 2},
                                {"_per_second", 1},
                                {"_per_sec", 1},
                                {"/second", 1},
                                {"/sec", 1},
                                {"_sec", 1},
                                {"_per_s", 1},
                                {" per second", 1},
                                {" per sec", 1},
                                {" per s", 1},
                                {" s^-1", 1},
                                {"*s^-1", 1},
                                {" s\xe2\x81\xbb\xc2\xb9", 1},
                                {"\xc2\xb7s\xe2\x81\xbb\xc2\xb9", 1},
                                {"/s", 1},
                                {"_s", 1},
                                {"", 0}};

/// The endings of rates that may stand behind the unit: `joint1_deg_vel`.
constexpr std::string_view quantities[] = {
    "_vel",          "_acc",          "_velocity", "/velocity", ".velocity", "_acceleration",
    "/acceleration", ".acceleration", "_pos",      "_position", "/position", ".position"};

bool is_opening(char c) { return c == '(' || c == '['; }
bool is_gap(char c) { return c == ' ' || c == '_' || c == '/' || c == '.'; }

/// Whether the text before a unit ends so that a unit may follow; removes this end.
bool ends_before_unit(std::string_view& stem, bool bracket, bool sign) {
  if (stem.empty()) return false;
  if (bracket) {
    if (!is_opening(stem.back())) return false;
    stem.remove_suffix(1);
  } else if (!sign && !is_gap(stem.back())) {
    return false;
  }
  while (!stem.empty() && is_gap(stem.back())) stem.remove_suffix(1);
  return !stem.empty();
}

NameInUnit split_at_unit(const std::string& name, bool times) {
  const std::string lower = lower_case(name);
  const bool bracket = lower.ends_with(')') || lower.ends_with(']');
  const std::string_view text = std::string_view(lower).substr(0, lower.size() - (bracket ? 1 : 0));
  for (const auto& [behind, power] : rates) {
    if (!text.ends_with(behind)) continue;
    const std::string_view unit_text = text.substr(0, text.size() - behind.size());
    for (const Unit& unit : all_units()) {
      if ((unit.quantity == Quantity::time) != times) continue;
      for (const std::string_view word : unit.names) {
        if (!unit_text.ends_with(word)) continue;
        std::string_view stem = unit_text.substr(0, unit_text.size() - word.size());
        const bool sign = static_cast<unsigned char>(word.front()) >= 0x80;
        if (!ends_before_unit(stem, bracket, sign)) continue;
        return {name.substr(0, stem.size()), &unit, power};
      }
    }
  }
  return {name};
}

bool is_end_of_word(char c) { return is_gap(c) || c == '[' || c == ']' || c == '(' || c == ')'; }

/// The unit that one of the words of the name is, as in `deg_joint1`; only an angle, as `m` and
/// `mm` may abbreviate other words.
const Unit* angle_among_words(const std::string& name) {
  const std::string lower = lower_case(name);
  for (std::size_t begin = 0; begin < lower.size();) {
    std::size_t end = begin;
    while (end < lower.size() && !is_end_of_word(lower[end])) ++end;
    const Unit* const unit = unit_called(std::string_view(lower).substr(begin, end - begin));
    if (unit != nullptr && unit->quantity == Quantity::angle) return unit;
    begin = end + 1;
  }
  return nullptr;
}

bool says_rate(const std::string& stem) {
  const std::string lower = lower_case(stem);
  return lower.find("vel") != std::string::npos || lower.find("speed") != std::string::npos ||
         lower.find("acc") != std::string::npos;
}

NameInUnit name_in_unit(const std::string& name) {
  NameInUnit found = split_at_unit(name, false);
  if (found.unit) {
    if (found.power > 0 && !says_rate(found.stem)) found.stem += found.power == 1 ? "_vel" : "_acc";
    return found;
  }
  const std::string lower = lower_case(name);
  for (const std::string_view quantity : quantities) {
    if (!lower.ends_with(quantity)) continue;
    const std::size_t size = name.size() - quantity.size();
    found = split_at_unit(name.substr(0, size), false);
    if (found.unit) found.stem += name.substr(size);
    break;
  }
  return found.unit ? found : NameInUnit{name, angle_among_words(name)};
}

/// Whether the name is one of these, or ends in one behind another text, as `left_joint1`.
bool ends_in_one_of(const std::string& name, const std::vector<std::string>& known) {
  const std::string lower = lower_case(name);
  return std::any_of(known.begin(), known.end(), [&lower](const std::string& other) {
    if (!lower.ends_with(lower_case(other))) return false;
    return lower.size() == other.size() || is_gap(lower[lower.size() - other.size() - 1]);
  });
}

/// Splits the name, twice where a row of units has added one. `guarded` are names that end in a
/// unit themselves.
NameInUnit split_twice(const std::string& name, const std::vector<std::string>& guarded) {
  if (ends_in_one_of(name, guarded)) return {name};
  NameInUnit outer = name_in_unit(name);
  if (outer.unit == nullptr || ends_in_one_of(outer.stem, guarded)) return outer;
  NameInUnit inner = name_in_unit(outer.stem);
  if (inner.unit == nullptr) return outer;
  if (inner.unit != outer.unit) {
    throw Error("column " + printable(name) + " is in " + name_of(*inner.unit) + " and in " +
                name_of(*outer.unit));
  }
  inner.power = outer.power;
  return inner;
}

/// The item of a row of units in lower case, without brackets and the dot of an abbreviation.
std::string unit_text(std::string_view item) {
  item = trimmed(item);
  if (item.size() >= 2 && is_opening(item.front())) item = item.substr(1, item.size() - 2);
  item = trimmed(item);
  if (item.size() >= 2 && item.ends_with('.')) item.remove_suffix(1);
  return lower_case(item);
}

/// Whether the text is a unit, or one of a rate.
bool is_unit(const std::string& text) {
  for (const bool times : {false, true}) {
    const NameInUnit found = split_at_unit("x [" + text + "]", times);
    if (found.unit != nullptr && found.stem == "x" && (!times || found.power == 0)) return true;
  }
  return false;
}

bool is_numeric(const std::string& item) {
  double value = 0;
  return parse_double(item.data(), item.data() + item.size(), value).ec == std::errc();
}

}  // namespace

bool states_unit(std::string_view item) {
  const std::string text = unit_text(item);
  const ForeignUnit* const foreign = foreign_unit(text);
  return is_unit(text) || (foreign != nullptr && foreign->is_only_a_unit);
}

bool is_time_name(std::string_view name) {
  constexpr std::string_view known[] = {
      "t",        "time",      "timestamp",       "time_stamp",   "stamp",   "date",
      "datetime", "date_time", "time_from_start", "elapsed_time", "elapsed", "uptime"};
  return std::find(std::begin(known), std::end(known), name) != std::end(known);
}

RateText rate_at_front(std::string_view text) {
  RateText found;
  for (const auto& [behind, power] : rates) {
    if (behind.size() <= found.size || !text.starts_with(behind)) continue;
    const char next = behind.size() < text.size() ? text[behind.size()] : ' ';
    const bool goes_on = (next >= 'a' && next <= 'z') || (next >= '0' && next <= '9') ||
                         next == '^' || static_cast<unsigned char>(next) >= 0x80;
    if (!goes_on) found = {power, behind.size()};
  }
  return found;
}

const std::vector<Unit>& all_units() {
  using enum Quantity;
  static const std::vector<Unit> units{
      {angle, 1, {"rad", "rads", "radian", "radians"}},
      {angle, std::numbers::pi / 180, {"deg", "degs", "degree", "\xc2\xb0", "\xc2\xba", "degrees"}},
      {length, 1, {"m", "metre", "meter", "meters", "metres"}},
      {length, 1e-3, {"mm", "millimetre", "millimeter", "millimeters", "millimetres"}},
      {time, 1, {"s", "sec", "secs", "second", "seconds"}},
      {time, 1e-3, {"ms", "msec", "msecs", "millis", "millisecond", "milliseconds"}},
      {time,
       1e-6,
       {"us", "usec", "usecs", "micros", "\xc2\xb5s", "\xce\xbcs", "microsecond", "microseconds"}},
      {time,
       1e-9,
       {"ns", "nsec", "nsecs", "nanos", "nanosec", "nanosecs", "nanosecond", "nanoseconds"}}};
  return units;
}

std::string name_of(const Unit& unit) { return std::string(unit.names.front()); }

const Unit* unit_called(std::string_view text) {
  for (const Unit& unit : all_units()) {
    if (std::find(unit.names.begin(), unit.names.end(), text) != unit.names.end()) return &unit;
  }
  return nullptr;
}

const Unit& unit_among(Quantity quantity, const std::string& text, const std::string& what) {
  std::vector<std::string> names;
  for (const Unit& unit : all_units()) {
    if (unit.quantity != quantity) continue;
    names.push_back(name_of(unit));
    if (names.back() == text) return unit;
  }
  throw unknown_name(what, text, names);
}

NameInUnit split_at_time_unit(const std::string& name) {
  NameInUnit found = split_at_unit(name, true);
  return found.power == 0 ? found : NameInUnit{name};
}

ColumnsInUnits columns_in_units(const std::vector<std::string>& names,
                                const std::vector<std::string>& known) {
  ColumnsInUnits columns{.names = names, .given = names};
  // Only few known names end in a unit.
  std::vector<std::string> guarded;
  std::copy_if(known.begin(), known.end(), std::back_inserter(guarded),
               [](const std::string& other) { return name_in_unit(other).unit != nullptr; });
  std::unordered_map<std::string, int> counts;
  std::vector<std::string> stems;
  for (const std::string& given : names) {
    NameInUnit split = split_twice(given, guarded);
    columns.units.push_back(split.unit);
    columns.powers.push_back(split.power);
    ++counts[split.stem];
    stems.push_back(std::move(split.stem));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (counts[stems[i]] == 1) columns.names[i] = std::move(stems[i]);
  }
  return columns;
}

UnitRow with_units(std::vector<std::string> names, const std::vector<std::string>& items) {
  if (names.size() != items.size()) return {};
  UnitRow row;
  bool any = false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string text = unit_text(items[i]);
    const ForeignUnit* const foreign = foreign_unit(text);
    const bool known = is_unit(text);
    any = any || known || (foreign != nullptr && foreign->is_only_a_unit);
    if (known) {
      names[i] += " [" + text + "]";
    } else if (!is_unit_of_other_quantity(text)) {
      if (is_numeric(text)) return {};
      if (row.fault.empty()) {
        row.fault = "column " + printable(names[i]) + ": " + in_quotes(items[i]) +
                    " in the row of units is not read; " + units_that_are_read;
      }
    }
  }
  if (!any) return {};
  if (row.fault.empty()) row.names = std::move(names);
  return row;
}

}  // namespace beeline::internal
