#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/read/internal/csv_lines.h>
#include <beeline/read/internal/file_stream.h>
#include <beeline/record/number_rows.h>

namespace beeline::internal {

/// Reads rows of numbers from a CSV file of any length, with the syntax of parse_csv(). The header
/// may be missing: the columns are then in the form's order. "-" is the standard input. All
/// functions throw FileError.
class CsvReader {
 public:
  CsvReader(const std::string& path, const RowForms& forms);

  std::size_t form() const { return form_; }  ///< index of the file's form
  bool has_header() const { return has_header_; }
  /// Reads the next rows, at most as many as `block.numbers` has columns, in the form's order.
  void read(RowBlock& block, BadRows& bad);
  const InputFile& file() const { return file_; }

 private:
  bool read_header(const std::vector<std::string>& items, const RowForms& forms);
  void choose_form(std::size_t width, const RowForms& forms);
  bool parse_plain(std::string_view line, double* numbers) const;
  void parse_quoted(std::string_view line, double* numbers) const;

  InputFile file_;
  CsvLines lines_;
  char separator_ = ',';
  std::size_t form_ = 0;
  bool has_header_ = true;
  std::vector<std::string> columns_;    ///< in the file's order
  std::vector<Eigen::Index> index_of_;  ///< of each column in the form
  std::string first_;                   ///< the first line, if it is a row
  std::int64_t first_line_ = 0;
  std::int64_t row_ = 0;
};

/// Writes a header, then rows of numbers that read back exactly; NaN is `nan`. "-" is the standard
/// output.
class CsvWriter {
 public:
  CsvWriter(const std::string& path, const std::vector<std::string>& names, int threads);

  /// Each column of `block` is a row of the file. Several threads format the numbers.
  void write(const Eigen::Ref<const Eigen::MatrixXd>& block);
  void commit() { file_.commit(); }

 private:
  OutputFile file_;
  std::vector<std::string> texts_;  ///< one per thread
};

}  // namespace beeline::internal
