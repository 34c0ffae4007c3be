#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <beeline/read/file_stream.h>
#include <beeline/record/row_block.h>

namespace beeline {

/// The lines of a file that may be larger than the memory.
class LineReader {
 public:
  /// Throws FileError for a line of more than `longest` bytes, when it comes to it.
  LineReader(const std::string& path, std::size_t longest);

  /// The next line that is neither empty nor a comment, without blanks around it; valid until the
  /// next call. False at the end.
  bool next(std::string_view& line);
  std::int64_t number() const { return number_; }  ///< of the line that next() gave
  const InputFile& file() const { return file_; }

 private:
  bool next_of_any_kind(std::string_view& line);

  InputFile file_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;
  bool ended_ = false;
  std::int64_t number_ = 0;
};

/// Rows of numbers from a CSV file as parse_csv takes them, but of any length, and the header may
/// be left out: then the columns stand in the form's order. "-" is the standard input. All throw
/// FileError.
class CsvReader {
 public:
  CsvReader(const std::string& path, const RowForms& forms);

  std::size_t form() const { return form_; }  ///< which of the forms the file has
  /// The next rows, up to as many as `block.numbers` has columns, in the form's order.
  void read(RowBlock& block, BadRows& bad);
  const InputFile& file() const { return lines_.file(); }

 private:
  bool read_header(const std::vector<std::string>& items, const RowForms& forms);
  bool parse_plain(std::string_view line, double* numbers) const;
  void parse_with_care(std::string_view line, double* numbers) const;

  LineReader lines_;
  std::size_t form_ = 0;
  std::vector<std::string> columns_;  ///< as they stand in the file
  std::vector<Eigen::Index> place_;   ///< of each column in the form
  std::string first_;                 ///< a first line that is no header
  std::int64_t first_line_ = 0;
  std::int64_t row_ = 0;
};

/// Writes a header, then rows of numbers that read back exactly; NaN is `nan`. "-" is the standard
/// output.
class CsvWriter {
 public:
  CsvWriter(const std::string& path, const std::vector<std::string>& names, int threads);

  /// Each column of `block` is a row of the file. Formatted by several threads.
  void write(const Eigen::Ref<const Eigen::MatrixXd>& block);
  void put_in_place() { file_.put_in_place(); }

 private:
  OutputFile file_;
  std::vector<std::string> texts_;  ///< one for each thread
};

}  // namespace beeline
