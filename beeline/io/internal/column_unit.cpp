#include <algorithm>
#include <iterator>
#include <numbers>
#include <string_view>
#include <unordered_map>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/internal/column_unit.h>

namespace beeline {
namespace {

struct JointUnitNames {
  JointUnit unit;
  double si;
  std::vector<std::string_view> names;  // the first is that of --angle-unit and of joint maps
};

const std::vector<JointUnitNames>& joint_units() {
  static const std::vector<JointUnitNames> units{
      {JointUnit::radians, 1, {"rad", "radian", "radians"}},
      {JointUnit::degrees,
       std::numbers::pi / 180,
       {"deg", "degree", "degrees", "\xc2\xb0", "\xc2\xba"}},
      {JointUnit::metres, 1, {"m", "metre", "metres", "meter", "meters"}},
      {JointUnit::millimetres,
       1e-3,
       {"mm", "millimetre", "millimetres", "millimeter", "millimeters"}}};
  return units;
}

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

/// A name as its stem and the unit behind it; no unit if it has none.
struct NameInUnit {
  std::string stem;
  std::optional<JointUnit> unit = std::nullopt;
  int power = 0;  ///< of 1 / s
};

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

NameInUnit split_at_unit(const std::string& name) {
  const std::string lower = internal::lower_case(name);
  const bool bracket = lower.ends_with(')') || lower.ends_with(']');
  const std::string_view text = std::string_view(lower).substr(0, lower.size() - (bracket ? 1 : 0));
  for (const auto& [behind, power] : rates) {
    if (!text.ends_with(behind)) continue;
    const std::string_view unit_text = text.substr(0, text.size() - behind.size());
    for (const JointUnitNames& unit : joint_units()) {
      for (const std::string_view word : unit.names) {
        if (!unit_text.ends_with(word)) continue;
        std::string_view stem = unit_text.substr(0, unit_text.size() - word.size());
        const bool sign = static_cast<unsigned char>(word.front()) >= 0x80;
        if (!ends_before_unit(stem, bracket, sign)) continue;
        return {name.substr(0, stem.size()), unit.unit, power};
      }
    }
  }
  return {name};
}

bool is_end_of_word(char c) { return is_gap(c) || c == '[' || c == ']' || c == '(' || c == ')'; }

/// The unit that one of the words of the name is, as in `deg_joint1`; only an angle, as `m` and
/// `mm` may abbreviate other words.
std::optional<JointUnit> angle_among_words(const std::string& name) {
  const std::string lower = internal::lower_case(name);
  for (std::size_t begin = 0; begin < lower.size();) {
    std::size_t end = begin;
    while (end < lower.size() && !is_end_of_word(lower[end])) ++end;
    const std::string_view word = std::string_view(lower).substr(begin, end - begin);
    for (const JointUnitNames& unit : joint_units()) {
      const auto found = std::find(unit.names.begin(), unit.names.end(), word);
      if (internal::is_angle(unit.unit) && found != unit.names.end()) return unit.unit;
    }
    begin = end + 1;
  }
  return std::nullopt;
}

bool says_rate(const std::string& stem) {
  const std::string lower = internal::lower_case(stem);
  return lower.find("vel") != std::string::npos || lower.find("speed") != std::string::npos ||
         lower.find("acc") != std::string::npos;
}

NameInUnit name_in_unit(const std::string& name) {
  NameInUnit found = split_at_unit(name);
  if (found.unit) {
    if (found.power > 0 && !says_rate(found.stem)) found.stem += found.power == 1 ? "_vel" : "_acc";
    return found;
  }
  const std::string lower = internal::lower_case(name);
  for (const std::string_view quantity : quantities) {
    if (!lower.ends_with(quantity)) continue;
    const std::size_t size = name.size() - quantity.size();
    found = split_at_unit(name.substr(0, size));
    if (found.unit) found.stem += name.substr(size);
    break;
  }
  return found.unit ? found : NameInUnit{name, angle_among_words(name)};
}

/// Whether the name is a joint's, or ends in one behind another text, as `left_joint1`.
bool is_of_joint(const std::string& name, const std::vector<std::string>& joints) {
  const std::string lower = internal::lower_case(name);
  return std::any_of(joints.begin(), joints.end(), [&lower](const std::string& joint) {
    if (!lower.ends_with(internal::lower_case(joint))) return false;
    return lower.size() == joint.size() || is_gap(lower[lower.size() - joint.size() - 1]);
  });
}

}  // namespace

std::string name(JointUnit unit) {
  return std::string(joint_units()[static_cast<std::size_t>(unit)].names.front());
}

namespace internal {

double si_per(JointUnit unit) { return joint_units()[static_cast<std::size_t>(unit)].si; }

JointUnit unit_among(const std::vector<JointUnit>& choices, const std::string& text,
                     const std::string& what) {
  std::vector<std::string> names;
  for (const JointUnit unit : choices) {
    names.push_back(name(unit));
    if (names.back() == text) return unit;
  }
  throw unknown_name(what, text, names);
}

bool is_angle(JointUnit unit) { return unit == JointUnit::radians || unit == JointUnit::degrees; }

RecordedColumns columns_in_units(const std::vector<std::string>& names,
                                 const std::vector<std::string>& joints) {
  RecordedColumns columns{.names = names, .given = names, .sources = names};
  columns.units.resize(names.size());
  // Only few names of joints end in a unit.
  std::vector<std::string> guarded;
  std::copy_if(joints.begin(), joints.end(), std::back_inserter(guarded),
               [](const std::string& joint) { return name_in_unit(joint).unit.has_value(); });
  std::unordered_map<std::string, int> counts;
  std::vector<std::string> stems;
  for (std::size_t i = 0; i < names.size(); ++i) {
    NameInUnit split =
        is_of_joint(names[i], guarded) ? NameInUnit{names[i]} : name_in_unit(names[i]);
    columns.units[i] = split.unit;
    ++counts[split.stem];
    stems.push_back(std::move(split.stem));
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (counts[stems[i]] == 1) columns.names[i] = std::move(stems[i]);
  }
  return columns;
}

}  // namespace internal
}  // namespace beeline
