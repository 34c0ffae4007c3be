#include <algorithm>
#include <cmath>
#include <iterator>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include <beeline/error.h>
#include <beeline/internal/enum_names.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/internal/time_column.h>
#include <beeline/io/text/internal/name.h>

namespace beeline {
namespace {

using internal::TimeColumns;
using internal::Unit;

constexpr internal::EnumNames<TimeUnit> time_units("unit of time", "s ms us ns");

/// Whether a name with a unit behind it is a time by its last word: `header_stamp`, also `tv`.
bool ends_in_time(const std::string& name) {
  return internal::is_time_name(name) || name == "tv" ||
         internal::is_time_name(std::string_view(name).substr(name.find_last_of('_') + 1));
}

/// A column of times, or of a part of them, as its name says.
struct TimeName {
  std::string clock;    ///< columns of one time agree: `/joint_states/header/stamp`
  std::string message;  ///< in front of the last part: `/joint_states/header`
  const Unit* unit = nullptr;
  bool says_time = false;  ///< otherwise the column is one of times only beside others
};

TimeName with_clock(const std::string& message, const std::string& last, const Unit* unit,
                    bool says_time) {
  return {message.empty() || last.empty() ? message + last : message + '/' + last, message, unit,
          says_time};
}

/// The unit of times that a word is; null for another one.
const Unit* unit_of_time(const std::string& word) {
  const Unit* const unit = internal::unit_called(word);
  return unit != nullptr && unit->quantity == internal::Quantity::time ? unit : nullptr;
}

void check_same_unit(const std::string& name, const Unit* inner, const Unit* outer) {
  if (inner == nullptr || outer == nullptr || inner == outer) return;
  throw Error("column " + internal::printable(name) + " is in " + name_of(*inner) + " and in " +
              name_of(*outer));
}

std::optional<TimeName> time_name(const std::string& name) {
  if (name == "T") return std::nullopt;
  const internal::NameInUnit outer = internal::split_at_time_unit(name);
  const internal::NameInUnit inner = internal::split_at_time_unit(outer.stem);
  check_same_unit(name, inner.unit, outer.unit);
  // A name and its unit, also where that is the last part of several, as in stamp/sec.
  const internal::NameInUnit& split = inner.unit != nullptr ? inner : outer;
  const std::string text = internal::lower_case(split.stem);
  const std::size_t end = text.find_last_of("/.");
  const std::string message = end == std::string::npos ? "" : text.substr(0, end);
  std::string last = end == std::string::npos ? text : text.substr(end + 1);
  last.erase(0, std::min(last.find_first_not_of("%_ "), last.size()));
  if (internal::is_time_name(last)) return with_clock(message, last, split.unit, true);
  const Unit* const alone = unit_of_time(last);
  const bool bracket = name.ends_with(']') || name.ends_with(')');
  if (alone != nullptr && (split.unit == nullptr || bracket)) {
    check_same_unit(name, alone, split.unit);
    return TimeName{message, message, alone, false};
  }
  if (split.unit != nullptr) {
    if (ends_in_time(last)) return with_clock(message, last, split.unit, false);
    const bool is_part = name.find_last_of("/.") == split.stem.size();
    if (is_part) return TimeName{text, text, split.unit, false};
  }
  return std::nullopt;
}

bool is_finer(const Unit* unit, const Unit* than) {
  return unit != nullptr && unit->si < (than == nullptr ? 1 : than->si);
}

/// The columns of times of a table.
class TimeTable {
 public:
  explicit TimeTable(const std::vector<std::string>& names) : names_(names) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      times_.push_back(time_name(names[i]));
      if (times_[i]) of_clock_[times_[i]->clock].push_back(i);
    }
  }

  /// Column i, and the one that has the same time in a finer unit.
  TimeColumns with_finer(std::size_t i) const {
    const TimeName& own = *times_[i];
    TimeColumns found{.index = i, .unit = own.unit};
    for (const std::size_t k : columns_of(own.clock)) add_finer(k, own, found);
    if (own.clock == own.message || has_seconds(own.message)) return found;
    for (const std::size_t k : columns_of(own.message)) {
      // Beside `t` all columns are joints, which may have the short names.
      const bool joint = names_[i] == "t" && names_[k].size() <= 2;
      if (!times_[k]->says_time && !joint) add_finer(k, own, found);
    }
    return found;
  }

  /// The first column that says time, or else the first pair of seconds and a finer unit, or else
  /// the first of seconds alone.
  std::optional<TimeColumns> main_columns() const {
    for (const std::optional<TimeName>& time : times_) {
      if (time && time->says_time) return with_finer(coarsest(time->clock));
    }
    std::optional<TimeColumns> alone;
    std::unordered_set<std::string> seen;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (!times_[i] || times_[i]->unit->si != 1 || !seen.insert(times_[i]->clock).second) continue;
      const TimeColumns found = with_finer(i);
      if (found.finer) return found;
      if (!alone && may_be_alone(i)) alone = found;
    }
    return alone;
  }

  /// The columns of times besides the main ones.
  std::vector<std::size_t> others(const TimeColumns& main) const {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < names_.size(); ++i) {
      if (!times_[i] || i == main.index || i == main.finer) continue;
      const bool is_part = has_seconds(times_[i]->clock) && columns_of(times_[i]->clock).size() > 1;
      if (times_[i]->says_time || is_part || may_be_alone(i)) found.push_back(i);
    }
    return found;
  }

 private:
  using Indices = std::vector<std::size_t>;

  const Indices& columns_of(const std::string& clock) const {
    static const Indices none;
    const auto found = of_clock_.find(clock);
    return found == of_clock_.end() ? none : found->second;
  }

  /// Whether the first columns of a time have seconds.
  bool has_seconds(const std::string& clock) const {
    const Indices& columns = columns_of(clock);
    constexpr std::ptrdiff_t most = 16;  // spellings
    const auto end = columns.begin() + std::min(most, std::ssize(columns));
    return std::any_of(columns.begin(), end, [&](std::size_t k) {
      return times_[k]->unit == nullptr || times_[k]->unit->si == 1;
    });
  }

  std::size_t coarsest(const std::string& clock) const {
    const Indices& columns = columns_of(clock);
    return *std::min_element(columns.begin(), columns.end(), [&](std::size_t a, std::size_t b) {
      return is_finer(times_[b]->unit, times_[a]->unit);
    });
  }

  void add_finer(std::size_t k, const TimeName& own, TimeColumns& found) const {
    if (k == found.index || !is_finer(times_[k]->unit, own.unit)) return;
    if (found.finer) {
      throw Error("columns " + internal::printable(names_[*found.finer]) + " and " +
                  internal::printable(names_[k]) + " both refine the times in column " +
                  internal::printable(names_[found.index]) + "; keep one of them");
    }
    found.finer = k;
    found.finer_unit = times_[k]->unit;
  }

  /// Whether a column that does not say time is one if it is alone, as `sec`. `s` may be a joint.
  bool may_be_alone(std::size_t i) const {
    const std::string text = internal::lower_case(names_[i]);
    const bool letter = text.ends_with('s') &&
                        (text.size() == 1 || std::string_view("/._ [(").find(
                                                 text[text.size() - 2]) != std::string_view::npos);
    return times_[i]->unit != nullptr && times_[i]->unit->si == 1 && !letter;
  }

  const std::vector<std::string>& names_;
  std::vector<std::optional<TimeName>> times_;
  std::unordered_map<std::string, Indices> of_clock_;
};

}  // namespace

std::string name(TimeUnit unit) { return time_units.of(unit); }

std::vector<std::string> time_unit_names() { return time_units.all(); }

TimeUnit time_unit_named(const std::string& name) { return time_units.named(name); }

namespace internal {

const Unit& unit_of(TimeUnit unit) { return *unit_called(time_units.of(unit)); }

TimeUnit time_unit_of(const Unit& unit) { return time_units.named(name_of(unit)); }

std::optional<TimeColumns> time_columns(const std::vector<std::string>& names) {
  const TimeTable table(names);
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  };
  if (const std::size_t plain = column("t"); plain < names.size()) return table.with_finer(plain);
  std::optional<TimeColumns> found = table.main_columns();
  if (found) {
    found->others = table.others(*found);
  } else if (const std::size_t upper = column("T"); upper < names.size()) {
    found = TimeColumns{.index = upper};
  }
  return found;
}

bool names_times(const std::vector<std::string>& names) { return time_columns(names).has_value(); }

bool is_since_1970(double seconds) {
  constexpr double year_1973 = 1e8;
  return std::abs(seconds) >= year_1973;
}

const Unit* unit_of_times(double first) {
  constexpr double year_1990 = 631'152'000, year_2100 = 4'102'444'800;
  const double size = std::abs(first);
  if (size <= year_2100) return &unit_of(TimeUnit::seconds);
  for (const TimeUnit unit :
       {TimeUnit::milliseconds, TimeUnit::microseconds, TimeUnit::nanoseconds}) {
    const double seconds = size * unit_of(unit).si;
    if (seconds >= year_1990 && seconds <= year_2100) return &unit_of(unit);
  }
  return nullptr;
}

}  // namespace internal
}  // namespace beeline
