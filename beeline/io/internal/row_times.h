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
  /// Without columns, rows are at 0, 1, 2, ... s. `rows` must outlive this object. Throws Error for
  /// a time unit of the options that the table cannot have, or that a comment contradicts.
  RowTimes(const std::optional<TimeColumns>& columns, const TableOptions& options, CsvRows& rows);

  /// Returns the time of the row that was read last, seconds. The first row decides how times are
  /// read, which the notes report. Throws Error for two columns that do not give one time.
  double next(const std::vector<double>& row, const std::string& path,
              std::vector<RecordingNote>& notes);

  /// Whether the times are in the options' unit.
  bool in_given_unit() const;

 private:
  /// The meaning of a column in a finer unit.
  enum class Finer { undecided, remainder, same_time };

  void check_given(const TableOptions& options) const;
  void start(const std::vector<double>& row, const std::string& path,
             std::vector<RecordingNote>& notes);
  double time_of_two(double coarse, double fine);
  void refuse_parts(double coarse, double fine) const;
  std::string column(std::size_t index) const;

  std::optional<TimeColumns> columns_;
  CsvRows& rows_;
  std::optional<TimeUnit> given_;
  const Unit* unit_ = nullptr;  ///< of the first column; null until it is known
  Finer finer_ = Finer::undecided;
  bool counts_ = false;  ///< times count from the first
  std::size_t sample_ = 0;
};

}  // namespace beeline::internal
