#include <algorithm>
#include <iterator>
#include <numbers>
#include <optional>
#include <string_view>
#include <unordered_map>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/text/internal/column_unit.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/numbers.h>

namespace beeline::internal {
namespace {

struct UnitOfRate {
  std::string_view text;  // behind the unit of the coordinate
  int power;              // of 1 / s
};

/// A longer text stands before its own ending.
constexpr UnitOfRate rates[] = {{"/s^2", 2},     {"/s2", 2},  {"/s\xc2\xb2", 2}, {"_s^2", 2},
                                {"_per_s2", 2},  {"_s2", 2},  {"/sec^2", 2},     {"/sec2", 2},
                                {"_per_sec", 1}, {"/sec", 1}, {"_sec", 1},       {"_per_s", 1},
                                {" per s", 1},   {"/s", 1},   {"_s", 1},         {"", 0}};

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
    const std::string_view word = std::string_view(lower).substr(begin, end - begin);
    for (const Unit& unit : all_units()) {
      const auto found = std::find(unit.names.begin(), unit.names.end(), word);
      if (unit.quantity == Quantity::angle && found != unit.names.end()) return &unit;
    }
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

/// The unit that an item of a row of units gives, as text behind a name: ` [deg/s]`; empty for one
/// of another quantity, none for a text that is no unit.
std::optional<std::string> unit_behind(std::string_view item) {
  constexpr std::string_view others[] = {"", "-", "1", "%", "n", "nm", "n.m", "n*m", "a", "v", "w"};
  item = trimmed(item);
  if (item.size() >= 2 && is_opening(item.front())) item = item.substr(1, item.size() - 2);
  const std::string lower = lower_case(std::string(trimmed(item)));
  if (std::find(std::begin(others), std::end(others), lower) != std::end(others)) return "";
  const std::string behind = " [" + lower + "]";
  for (const bool times : {false, true}) {
    const NameInUnit found = split_at_unit("x" + behind, times);
    if (found.unit != nullptr && found.stem == "x" && (!times || found.power == 0)) return behind;
  }
  return std::nullopt;
}

bool is_one_of(std::string_view word, std::string_view words) {
  return (" " + std::string(words) + " ").find(" " + std::string(word) + " ") != std::string::npos;
}

/// Collects the units of comments.
class CommentReader {
 public:
  void read(const std::string& comment) {
    constexpr const char* subjects =
        "unit units angle angles angular position positions joint joints length lengths distance "
        "distances time times timestamp timestamps value values column columns coordinates "
        "orientation orientations rotation rotations translation translations roll pitch yaw q "
        "angle_unit angle_units length_unit time_unit";
    constexpr const char* fillers =
        "a all and are as data expressed for given in is measured of recorded stored the written";
    // With one of these, a unit does not count behind other words.
    constexpr const char* others =
        "acceleration accelerations celsius converted from limit limits max maximum no not "
        "resolution speed speeds step to velocities velocity";
    const std::vector<std::string> words = words_of(comment);
    const auto is_known = [](const std::string& word) {
      return is_one_of(word, fillers) || unit_called(word).unit != nullptr;
    };
    const bool plain = std::none_of(words.begin(), words.end(), [](const std::string& word) {
      return is_one_of(word, others);
    });
    bool active = std::all_of(words.begin(), words.end(), is_known), any_subject = false;
    for (std::size_t i = 0; i < words.size(); ++i) {
      const NameInUnit found = unit_called(words[i]);
      const bool counts = i + 1 < words.size() && words[i + 1] == "of";  // degrees of freedom
      const bool behind_in = any_subject && plain && i > 0 && words[i - 1] == "in";
      if (is_one_of(words[i], subjects)) {
        active = any_subject = true;
      } else if (found.unit != nullptr && !counts && (active || (behind_in && found.power == 0))) {
        add(found);
      } else if (!is_one_of(words[i], fillers)) {
        active = false;
      }
    }
  }

  StatedUnits finish() {
    StatedUnits& stated = stated_;
    if (stated.angle == nullptr) stated.angle = rate_of_angle_;
    if (rate_of_angle_ != nullptr) set(stated.angle, *rate_of_angle_, "angles and their rates");
    if (stated.length == nullptr) stated.length = rate_of_length_;
    if (rate_of_length_ != nullptr) set(stated.length, *rate_of_length_, "lengths and their rates");
    return stated;
  }

 private:
  static NameInUnit unit_called(const std::string& word) {
    for (const bool times : {false, true}) {
      NameInUnit found = split_at_unit("x [" + word + "]", times);
      if (found.unit != nullptr && found.stem == "x" && (!times || found.power == 0)) return found;
    }
    return {};
  }

  /// Words in lower case, with the slash of `deg/s` in them.
  static std::vector<std::string> words_of(const std::string& comment) {
    std::vector<std::string> words(1);
    for (const char c : lower_case(comment)) {
      const bool letter = (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' ||
                          c == '/' || c == '^' || static_cast<unsigned char>(c) >= 0x80;
      if (letter) {
        words.back() += c;
      } else if (!words.back().empty()) {
        words.emplace_back();
      }
    }
    if (words.back().empty()) words.pop_back();
    return words;
  }

  static void set(const Unit*& stated, const Unit& unit, const char* what) {
    if (stated != nullptr && stated != &unit) {
      throw Error(std::string("the comments give ") + what + " in " + name_of(*stated) +
                  " and in " + name_of(unit) + "; write the unit behind each column's name");
    }
    stated = &unit;
  }

  void add(const NameInUnit& found) {
    const bool rate = found.power > 0;
    switch (found.unit->quantity) {
      case Quantity::angle:
        return set(rate ? rate_of_angle_ : stated_.angle, *found.unit, "angles");
      case Quantity::length:
        return set(rate ? rate_of_length_ : stated_.length, *found.unit, "lengths");
      case Quantity::time:
        return set(stated_.time, *found.unit, "times");
    }
  }

  StatedUnits stated_;
  const Unit *rate_of_angle_ = nullptr, *rate_of_length_ = nullptr;
};

}  // namespace

const std::vector<Unit>& all_units() {
  using enum Quantity;
  static const std::vector<Unit> units{
      {angle, 1, {"rad", "radian", "radians"}},
      {angle, std::numbers::pi / 180, {"deg", "degree", "\xc2\xb0", "\xc2\xba", "degrees"}},
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
  ColumnsInUnits columns{.names = names, .given = names, .sources = names};
  // Only few known names end in a unit.
  std::vector<std::string> guarded;
  std::copy_if(known.begin(), known.end(), std::back_inserter(guarded),
               [](const std::string& other) { return name_in_unit(other).unit != nullptr; });
  std::unordered_map<std::string, int> counts;
  std::vector<std::string> stems;
  for (const std::string& given : names) {
    NameInUnit split = split_twice(given, guarded);
    columns.units.push_back(split.unit);
    ++counts[split.stem];
    stems.push_back(std::move(split.stem));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (counts[stems[i]] == 1) columns.names[i] = std::move(stems[i]);
  }
  return columns;
}

std::vector<std::string> with_units(std::vector<std::string> names,
                                    const std::vector<std::string>& items) {
  if (names.size() != items.size()) return {};
  bool any = false;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::optional<std::string> behind = unit_behind(items[i]);
    if (!behind) return {};
    any = any || !behind->empty();
    names[i] += *behind;
  }
  return any ? names : std::vector<std::string>();
}

StatedUnits stated_units(const std::vector<std::string>& comments) {
  CommentReader reader;
  for (const std::string& comment : comments) reader.read(comment);
  return reader.finish();
}

std::vector<double> factors_to(const std::vector<std::string>& wanted,
                               const ColumnsInUnits& columns, const StatedUnits& stated) {
  std::vector<double> factors;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const Unit* unit = columns.units[i];
    const auto target = std::find_if(all_units().begin(), all_units().end(), [&](const Unit& any) {
      return any.names.front() == wanted[i];
    });
    const bool has_unit = target != all_units().end();
    if (unit != nullptr && (!has_unit || target->quantity != unit->quantity)) {
      const char* const units = !has_unit                             ? "has no unit"
                                : target->quantity == Quantity::angle ? "is an angle: rad or deg"
                                                                      : "is a length: m or mm";
      throw Error("column " + printable(columns.given[i]) + " is in " + name_of(*unit) +
                  ", but it " + units);
    }
    if (unit == nullptr && has_unit) {
      unit = target->quantity == Quantity::angle ? stated.angle : stated.length;
      if (unit != nullptr && target->si != 1 && unit != &*target) {
        throw Error("column " + printable(columns.given[i]) + " is in " + name_of(*unit) +
                    ", as a comment says, but is asked for in " + name_of(*target));
      }
    }
    factors.push_back(unit == nullptr ? 1 : unit->si / target->si);
  }
  return factors;
}

}  // namespace beeline::internal
