#include <cmath>

#include <beeline/error.h>
#include <beeline/io/internal/row_times.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/numbers.h>

namespace beeline::internal {
namespace {

/// The number of the units in a second.
double per_second(const Unit& unit) { return std::round(1 / unit.si); }

}  // namespace

RowTimes::RowTimes(const std::optional<TimeColumns>& columns, const TableOptions& options,
                   CsvRows& rows)
    : columns_(columns), rows_(rows), given_(options.time_unit) {
  check_given(options);
  if (!columns_) return;
  const Unit* const stated = rows_.stated().time;
  const Unit* const named = columns_->unit;
  if (given_ && !columns_->finer) unit_ = &unit_of(*given_);
  for (const Unit* const other : {named, unit_}) {
    if (stated == nullptr || other == nullptr || other == stated) continue;
    throw Error(column(columns_->index) + " is in " + name_of(*other) +
                ", but a comment gives times in " + name_of(*stated));
  }
  if (unit_ == nullptr) unit_ = named != nullptr ? named : stated;
  std::vector<std::size_t> counted{columns_->index};
  if (columns_->finer) counted.push_back(*columns_->finer);
  rows_.count_from_first(counted);
}

void RowTimes::check_given(const TableOptions& options) const {
  if (!given_ || options.time_unit_is_optional) return;
  if (!columns_) throw Error(std::string("has no times; ") + time_unit_refusal);
  if (!columns_->finer || *given_ == TimeUnit::seconds) return;
  const Unit& unit = columns_->unit != nullptr ? *columns_->unit : unit_of(TimeUnit::seconds);
  throw Error("columns " + printable(rows_.columns()[columns_->index]) + " and " +
              printable(rows_.columns()[*columns_->finer]) + " are " +
              std::string(unit.names.back()) + " and " +
              std::string(columns_->finer_unit->names.back()) + "; " + time_unit_refusal);
}

bool RowTimes::in_given_unit() const {
  return given_ && columns_ && (!columns_->finer || *given_ == TimeUnit::seconds);
}

void RowTimes::start(const std::vector<double>& row, const std::string& path,
                     std::vector<RecordingNote>& notes) {
  std::vector<std::string> names{rows_.columns()[columns_->index]};
  const double first = row[columns_->index];
  if (rows_.has_dates()) {
    if (given_ && in_given_unit()) {
      throw Error(column(columns_->index) +
                  " has dates, which need no time unit (time_unit, --time-unit)");
    }
    if (columns_->finer) {
      throw Error(column(columns_->index) + " has dates, which " + column(*columns_->finer) +
                  " cannot refine; remove that column");
    }
    notes.push_back({.kind = RecordingNoteKind::times_since_1970, .path = path, .columns = names});
    return;
  }
  if (unit_ == nullptr) {
    unit_ = names.front() == "t" ? &unit_of(TimeUnit::seconds) : &unit_of_times(first);
  }
  if (columns_->finer && columns_->finer_unit->si >= unit_->si) columns_->finer.reset();
  const Unit* noted = unit_;
  double seconds = first * unit_->si;
  if (columns_->finer) {
    const double fine = row[*columns_->finer];
    time_of_two(first, fine);
    names.push_back(rows_.columns()[*columns_->finer]);
    if (finer_ == Finer::same_time) {
      names.erase(names.begin());
      noted = columns_->finer_unit;
      seconds = fine * noted->si;
    }
  }
  // The digits of a double do not suffice for a time since 1970 in small units.
  counts_ = (unit_->si < 1 || columns_->finer) && is_since_1970(seconds);
  if (!counts_) return;
  notes.push_back({.kind = RecordingNoteKind::times_since_1970,
                   .path = path,
                   .columns = names,
                   .time_unit = time_unit_of(*noted)});
}

double RowTimes::next(const std::vector<double>& row, const std::string& path,
                      std::vector<RecordingNote>& notes) {
  if (!columns_) return static_cast<double>(sample_++);
  if (sample_++ == 0) start(row, path, notes);
  if (rows_.has_dates()) return rows_.from_first(0);
  if (columns_->finer) return time_of_two(row[columns_->index], row[*columns_->finer]);
  const double value = counts_ ? rows_.from_first(0) : row[columns_->index];
  return unit_->si == 1 ? value : value / per_second(*unit_);
}

/// Two columns are whole units and their remainder, or the same time twice. Where both are
/// possible, as for 0 and 0.5 s, the time is the same.
double RowTimes::time_of_two(double coarse, double fine) {
  const double per_coarse = std::round(unit_->si / columns_->finer_unit->si);
  const double fine_in_coarse = fine / per_coarse;
  constexpr double digits = 1e-3;  // that a time may be written with
  const bool same = std::floor(fine_in_coarse) == coarse ||
                    std::abs(fine_in_coarse - coarse) <= digits + 1e-15 * std::abs(coarse);
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
