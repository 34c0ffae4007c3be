#pragma once

#include <string>
#include <vector>

#include <beeline/io/internal/time_column.h>
#include <beeline/io/internal/trajectory_csv.h>
#include <beeline/io/text/internal/csv_rows.h>

namespace beeline::internal {

/// The times of the rows of a table.
class RowTimes {
 public:
  /// Without columns, rows are at 0, 1, 2, ... s. `rows` and `path` must outlive this object.
  /// Throws Error for a time unit of the options that the table cannot have, or that the column's
  /// name or a comment contradicts, and FileError for a comment with a unit that is not read.
  RowTimes(const std::optional<TimeColumns>& columns, const TableOptions& options, CsvRows& rows,
           const std::string& path);

  /// Returns the time of the row that was read last, seconds. The first row decides how times are
  /// read, which the notes report. Throws Error for two columns that do not give one time, and for
  /// times whose unit is not known.
  double next(const std::vector<double>& row, std::vector<RecordingNote>& notes);

  /// Throws Error for times that look like days, as Excel counts them, if nothing but their size
  /// gives the unit. `times` holds the time of each row.
  void check_days(const std::vector<double>& times) const;

  /// Whether the times are in the options' unit.
  bool in_given_unit() const;

 private:
  /// The meaning of a column in a finer unit.
  enum class Finer { undecided, remainder, same_time };

  void check_given(const TableOptions& options);
  void start(const std::vector<double>& row, std::vector<RecordingNote>& notes);
  void set_unit(double first);
  void note_comments(std::vector<RecordingNote>& notes) const;
  bool is_same_time(double coarse, double fine_in_coarse) const;
  double time_of_two(double coarse, double fine);
  void refuse_parts(double coarse, double fine) const;
  std::string column(std::size_t index) const;

  std::optional<TimeColumns> columns_;
  CsvRows& rows_;
  const std::string& path_;
  std::optional<TimeUnit> given_;  ///< by the options, if it is used
  bool has_arm_ = false;
  const Unit* unit_ = nullptr;  ///< of the first column; null until it is known
  Finer finer_ = Finer::undecided;
  bool unit_is_known_ = true;  ///< by more than the size of the first time
  bool counts_ = false;        ///< times count from the first
  std::size_t sample_ = 0;
};

}  // namespace beeline::internal
