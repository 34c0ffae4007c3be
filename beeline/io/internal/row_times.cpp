#include <algorithm>
#include <cmath>
#include <iterator>

#include <beeline/error.h>
#include <beeline/io/internal/row_times.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/numbers.h>

namespace beeline::internal {
namespace {

/// The number of the units in a second.
double per_second(const Unit& unit) { return std::round(1 / unit.si); }

/// The value of a one in the last digit of a number: 0.01 of `1.25`.
double last_digit(std::string_view number) {
  const std::size_t exponent = std::min(number.find_first_of("eE"), number.size());
  const std::string_view digits = number.substr(0, exponent);
  const std::size_t mark = digits.find_first_of(".,");
  const auto decimals = mark == std::string_view::npos ? 0 : digits.size() - mark - 1;
  double power = 0;
  number.remove_prefix(std::min(exponent + 1, number.size()));
  if (number.starts_with('+')) number.remove_prefix(1);
  parse_double(number.data(), number.data() + number.size(), power);
  return std::pow(10, power - static_cast<double>(decimals));
}

}  // namespace

RowTimes::RowTimes(const std::optional<TimeColumns>& columns, const TableOptions& options,
                   CsvRows& rows, const std::string& path)
    : columns_(columns),
      rows_(rows),
      path_(path),
      given_(options.time_unit),
      has_arm_(!options.joint_names.empty()) {
  check_given(options);
  if (!columns_) return;
  check_read(rows_.stated(), Quantity::time, 0, path_);
  const Unit* const stated = rows_.stated().time;
  if (given_ && !columns_->finer) unit_ = &unit_of(*given_);
  for (const Unit* const other : {columns_->unit, unit_}) {
    if (stated == nullptr || other == nullptr || other == stated) continue;
    throw Error(column(columns_->index) + " is in " + name_of(*other) +
                ", but a comment gives times in " + name_of(*stated));
  }
  if (unit_ == nullptr) unit_ = columns_->unit != nullptr ? columns_->unit : stated;
  std::vector<std::size_t> counted{columns_->index};
  if (columns_->finer) counted.push_back(*columns_->finer);
  rows_.count_from_first(counted);
}

/// Drops a given unit that is optional if the table has another one.
void RowTimes::check_given(const TableOptions& options) {
  if (!given_) return;
  const Unit* named = columns_ ? columns_->unit : nullptr;
  if (columns_ && columns_->finer && named == nullptr) named = &unit_of(TimeUnit::seconds);
  if (columns_ && (named == nullptr || named == &unit_of(*given_))) return;
  if (options.time_unit_is_optional) {
    given_.reset();
    return;
  }
  if (!columns_) throw Error(std::string("has no times; ") + time_unit_refusal);
  if (columns_->finer) {
    throw Error("columns " + printable(rows_.columns()[columns_->index]) + " and " +
                printable(rows_.columns()[*columns_->finer]) + " are " +
                std::string(named->names.back()) + " and " +
                std::string(columns_->finer_unit->names.back()) + "; " + time_unit_refusal);
  }
  throw Error(column(columns_->index) + " is in " + name_of(*named) +
              ", as its name says, but the time unit (time_unit, --time-unit) is " + name(*given_));
}

bool RowTimes::in_given_unit() const { return given_ && columns_; }

/// Sets the unit by the first time, if nothing else gives it.
void RowTimes::set_unit(double first) {
  if (unit_ != nullptr) return;
  const bool is_ours = !has_arm_ && rows_.columns()[columns_->index] == "t";
  unit_is_known_ = is_ours;
  unit_ = is_ours ? &unit_of(TimeUnit::seconds) : unit_of_times(first);
  if (unit_ != nullptr) return;
  throw Error(column(columns_->index) + ": " + exact(first) +
              " is a time of the years 1990 to 2100 in none of s, ms, us and ns since 1970; its "
              "unit must stand in the column's name, as time_ns, or in a time unit (time_unit, "
              "--time-unit)");
}

void RowTimes::check_days(const std::vector<double>& times) const {
  if (unit_is_known_ || rows_.has_dates() || columns_->finer || times.size() < 2) return;
  // From 1900, 1970, 1858 or the years 0 and -4712 on, as Excel, MATLAB and astronomers count.
  constexpr double ranges[][2] = {{15'000, 80'000}, {700'000, 780'000}, {2'430'000, 2'500'000}};
  const double first = times.front(), last = times.back();
  const bool in_range = std::any_of(std::begin(ranges), std::end(ranges), [&](const auto& range) {
    return first >= range[0] && last <= range[1];
  });
  const double step = (last - first) / static_cast<double>(times.size() - 1);
  constexpr double max_step = 5e-5;  // a sample every 4 s in days, 20 kHz in seconds
  if (!in_range || step > max_step) return;
  throw Error(column(columns_->index) + ": " + exact(first) + " to " + exact(last) +
              " look like days, as Excel and MATLAB count them; write seconds, 86400 * (day - "
              "first day), or say by the time unit s (time_unit, --time-unit) that these are "
              "seconds");
}

/// Adds a note on a unit other than seconds that a comment gives, or on comments that are not clear
/// unless something else gives the unit.
void RowTimes::note_comments(std::vector<RecordingNote>& notes) const {
  const StatedUnits& stated = rows_.stated();
  const bool names_column = std::any_of(
      stated.columns.begin(), stated.columns.end(),
      [&](const UnitOfColumn& of_column) { return of_column.column == columns_->index; });
  const bool commented = names_column || (unit_ == stated.time && columns_->unit == nullptr);
  if (commented && !given_ && unit_->si != 1) {
    notes.push_back({.kind = RecordingNoteKind::named_time_unit,
                     .path = path_,
                     .time_unit = time_unit_of(*unit_)});
  }
  if (given_ || stated.time != nullptr || columns_->unit != nullptr || columns_->finer) return;
  for (const UnclearComment& unclear : stated.unclear) {
    if (!unclear.times) continue;
    notes.push_back({.kind = RecordingNoteKind::unclear_comment,
                     .path = path_,
                     .time_unit = time_unit_of(*unit_),
                     .comment = unclear.comment.text});
  }
}

void RowTimes::start(const std::vector<double>& row, std::vector<RecordingNote>& notes) {
  std::vector<std::string> names{rows_.columns()[columns_->index]};
  std::vector<std::string> others;
  for (const std::size_t i : columns_->others) others.push_back(rows_.columns()[i]);
  if (!others.empty()) {
    notes.push_back(
        {.kind = RecordingNoteKind::other_times, .path = path_, .columns = std::move(others)});
  }
  const double first = row[columns_->index];
  if (rows_.has_dates()) {
    if (in_given_unit()) {
      throw Error(column(columns_->index) +
                  " has dates, which need no time unit (time_unit, --time-unit)");
    }
    if (columns_->finer) {
      throw Error(column(columns_->index) + " has dates, which " + column(*columns_->finer) +
                  " cannot refine; remove that column");
    }
    notes.push_back({.kind = RecordingNoteKind::times_since_1970, .path = path_, .columns = names});
    return;
  }
  set_unit(first);
  if (columns_->finer && columns_->finer_unit->si >= unit_->si) columns_->finer.reset();
  note_comments(notes);
  const Unit* noted = unit_;
  double seconds = first * unit_->si;
  std::optional<TimeUnit> finer;
  if (columns_->finer) {
    const double fine = row[*columns_->finer];
    time_of_two(first, fine);
    names.push_back(rows_.columns()[*columns_->finer]);
    finer = time_unit_of(*columns_->finer_unit);
    if (finer_ == Finer::same_time) {
      names.erase(names.begin());
      finer.reset();
      noted = columns_->finer_unit;
      seconds = fine * noted->si;
    }
  }
  // The digits of a double do not suffice for a time since 1970 in small units.
  counts_ = (unit_->si < 1 || columns_->finer) && is_since_1970(seconds);
  if (!counts_) return;
  notes.push_back({.kind = RecordingNoteKind::times_since_1970,
                   .path = path_,
                   .columns = names,
                   .time_unit = time_unit_of(*noted),
                   .finer_unit = finer});
}

double RowTimes::next(const std::vector<double>& row, std::vector<RecordingNote>& notes) {
  if (!columns_) return static_cast<double>(sample_++);
  if (sample_++ == 0) start(row, notes);
  if (rows_.has_dates()) return rows_.from_first(0);
  if (columns_->finer) return time_of_two(row[columns_->index], row[*columns_->finer]);
  const double value = counts_ ? rows_.from_first(0) : row[columns_->index];
  return unit_->si == 1 ? value : value / per_second(*unit_);
}

/// Whether the first column has the time of the second one, rounded or cut off to the digits with
/// which it is written; a whole number is cut off.
bool RowTimes::is_same_time(double coarse, double fine_in_coarse) const {
  const double digit = last_digit(rows_.counted_item(0));
  const double rounding = 1e-15 * std::abs(coarse);
  if (digit >= 1) {
    return std::floor(fine_in_coarse) == coarse || std::abs(fine_in_coarse - coarse) <= rounding;
  }
  constexpr double half = 0.5 * (1 + 1e-9), all = 1 - 1e-9;
  const double beyond = std::abs(fine_in_coarse) - std::abs(coarse);
  return std::abs(fine_in_coarse - coarse) <= half * digit + rounding ||
         (fine_in_coarse * coarse >= 0 && beyond >= 0 && beyond <= all * digit);
}

/// Two columns are whole units and their remainder, or the same time twice. Where both are
/// possible, as for 0 and 0.5 s, the time is the same.
double RowTimes::time_of_two(double coarse, double fine) {
  const double per_coarse = std::round(unit_->si / columns_->finer_unit->si);
  const double fine_in_coarse = fine / per_coarse;
  const bool same = is_same_time(coarse, fine_in_coarse);
  const bool remainder = coarse == std::floor(coarse) && std::abs(fine_in_coarse) < 1;
  if (finer_ == Finer::undecided && remainder && coarse != 0) finer_ = Finer::remainder;
  if (finer_ == Finer::undecided && !remainder && same) finer_ = Finer::same_time;
  if (finer_ == Finer::same_time ? !same : !remainder) refuse_parts(coarse, fine);
  const double unit = per_second(*columns_->finer_unit);
  if (finer_ == Finer::same_time) return (counts_ ? rows_.from_first(1) : fine) / unit;
  if (!counts_) return (coarse * per_coarse + fine) / unit;
  return (rows_.from_first(0) * per_coarse + rows_.from_first(1)) / unit;
}

void RowTimes::refuse_parts(double coarse, double fine) const {
  const std::string first = column(columns_->index), second = column(*columns_->finer);
  const std::string words(unit_->names.back()), finer(columns_->finer_unit->names.back());
  if (finer_ == Finer::same_time) {
    throw Error(first + ": " + exact(coarse) + " must be the same time as " + exact(fine) + " in " +
                second + ", as in the rows before");
  }
  if (coarse != std::floor(coarse)) {
    throw Error(first + ": " + exact(coarse) + " must be whole " + words + ", as " + second +
                " has the " + finer);
  }
  throw Error(second + ": " + exact(fine) + " must be below " +
              exact(std::round(unit_->si / columns_->finer_unit->si)) + ", " + finer + " of a " +
              words.substr(0, words.size() - 1));
}

std::string RowTimes::column(std::size_t index) const {
  return "column " + printable(rows_.columns()[index]);
}

}  // namespace beeline::internal
