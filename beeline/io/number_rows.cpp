#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include <beeline/io/internal/csv_writer.h>
#include <beeline/io/number_rows.h>
#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/csv_items.h>
#include <beeline/io/text/internal/csv_rows.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/npy.h>

namespace beeline {
namespace internal {

/// Rows of a CSV file that has the columns of one form, in any order. "-" is the standard input.
class CsvNumbers {
 public:
  CsvNumbers(const std::string& path, const RowForms& forms, const RowUnits& units)
      : file_(path, Dash::standard),
        lines_(file_, max_line(forms)),
        rows_(lines_, file_.path(), {forms, [&](const auto& names) {
                                       return std::any_of(
                                           forms.begin(), forms.end(), [&](const auto& form) {
                                             return match(names, form, !units.empty()).has_value();
                                           });
                                     }}) {
    for (; form_ < forms.size(); ++form_) {
      const auto found = match(rows_.columns(), forms[form_], !units.empty());
      if (!found) continue;
      const auto& [columns, positions] = *found;
      if (!units.empty()) set_factors(columns, positions, units[form_]);
      if (!std::is_sorted(positions.begin(), positions.end())) position_of_ = positions;
      row_.resize(positions.size());
      return;
    }
    std::vector<std::string> quoted;
    for (const std::string& column : rows_.columns()) quoted.push_back(printable(column));
    throw FileError(file_.path(), rows_.line(),
                    "the header has the columns " + listed(quoted) + "; rows are " +
                        described(forms) + ", in any order, or in this one without a header");
  }

  std::size_t form() const { return form_; }
  bool has_header() const { return rows_.has_header(); }
  const std::vector<std::string>& commented_units() const { return commented_units_; }
  const InputFile& file() const { return file_; }

  void read(RowBlock& block, BadRows& bad) {
    block.positions.clear();
    while (block.count() < block.numbers.cols() && rows_.advance()) {
      const RowPosition position{++count_, lines_.number()};
      double* const numbers = block.numbers.col(block.count()).data();
      try {
        rows_.parse(position_of_.empty() ? numbers : row_.data());
      } catch (const Error& error) {
        bad.report(bad_row(file_.path(), position, error.what()));
        continue;
      }
      for (std::size_t k = 0; k < position_of_.size(); ++k) numbers[position_of_[k]] = row_[k];
      for (std::size_t k = 0; k < factors_.size(); ++k) numbers[k] *= factors_[k];
      block.positions.push_back(position);
    }
  }

 private:
  /// The columns of a table, and the position of each in a form.
  using Match = std::pair<ColumnsInUnits, std::vector<std::size_t>>;

  /// The columns are the form's, or they are once the units in their names are split off.
  static std::optional<Match> match(const std::vector<std::string>& names,
                                    const std::vector<std::string>& form, bool in_units) {
    ColumnsInUnits columns{.names = names, .given = names};
    columns.units.resize(names.size());
    auto positions = positions_of(names, form);
    if (!positions && in_units) {
      columns = columns_in_units(names, form);
      positions = positions_of(columns.names, form);
    }
    if (!positions) return std::nullopt;
    return Match(std::move(columns), std::move(*positions));
  }

  void set_factors(const ColumnsInUnits& columns, const std::vector<std::size_t>& positions,
                   const std::vector<std::string>& units) {
    std::vector<std::string> wanted;
    for (const std::size_t position : positions) wanted.push_back(units[position]);
    try {
      const std::vector<double> factors = factors_to(wanted, columns, rows_.stated(), file_.path());
      commented_units_ = internal::commented_units(columns, rows_.stated(), factors);
      const auto is_one = [](double factor) { return factor == 1; };
      if (std::all_of(factors.begin(), factors.end(), is_one)) return;
      factors_.resize(factors.size());
      for (std::size_t i = 0; i < factors.size(); ++i) factors_[positions[i]] = factors[i];
    } catch (const FileError&) {
      throw;
    } catch (const Error& error) {
      throw FileError(file_.path(), rows_.line(), error.what());
    }
  }

  /// Max length of a line of the forms, including spaces between its numbers.
  static std::size_t max_line(const RowForms& forms) {
    std::size_t width = 0;
    for (const auto& form : forms) width = std::max(width, form.size());
    return (std::size_t{1} << 20) + 64 * width;
  }

  InputFile file_;
  CsvLines lines_;
  CsvRows rows_;
  std::size_t form_ = 0;
  std::vector<std::size_t> position_of_;  ///< of each column in the form; empty: in its order
  std::vector<double> row_;               ///< in the order of the file
  std::vector<double> factors_;           ///< of each number of the form; empty: 1
  std::vector<std::string> commented_units_;
  std::int64_t count_ = 0;  ///< rows reached
};

/// Rows of an .npy file: chooses the form by the width and checks that numbers are finite.
class NpyRows {
 public:
  NpyRows(const std::string& path, const RowForms& forms) : reader_(path) {
    const auto width = static_cast<std::size_t>(reader_.header().width);
    const auto has_width = [width](const auto& form) { return form.size() == width; };
    const auto form = std::find_if(forms.begin(), forms.end(), has_width);
    if (form == forms.end()) refuse_width(forms);
    form_ = static_cast<std::size_t>(form - forms.begin());
    columns_ = *form;
  }

  std::size_t form() const { return form_; }
  bool has_header() const { return false; }
  std::vector<std::string> commented_units() const { return {}; }
  const InputFile& file() const { return reader_.file(); }

  void read(RowBlock& block, BadRows& bad) {
    block.positions.clear();
    while (block.positions.empty()) {  // a block with only bad rows is not the end
      const Eigen::Index count = reader_.read(block.numbers);
      if (count == 0) return;
      for (Eigen::Index i = 0; i < count; ++i) take_row(i, block, bad);
    }
  }

 private:
  [[noreturn]] void refuse_width(const RowForms& forms) const {
    const NpyHeader& header = reader_.header();
    std::string text = "has rows of " + std::to_string(header.width) + " number" +
                       (header.width == 1 ? "" : "s") + "; rows are " + described(forms);
    const auto is_one_row = [&](const auto& form) {
      return static_cast<std::int64_t>(form.size()) == header.rows;
    };
    if (std::any_of(forms.begin(), forms.end(), is_one_row)) {
      text += header.width == 1 ? ": one row is array.reshape(1, -1)"
                                : "; if each column is a row, write array.T";
    }
    throw FileError(file().path(), 0, text);
  }

  /// Moves row i of the block to the end of its valid rows, unless it is bad.
  void take_row(Eigen::Index i, RowBlock& block, BadRows& bad) {
    const RowPosition position{++row_, 0};
    const auto row = block.numbers.col(i);
    for (Eigen::Index k = 0; k < row.size(); ++k) {
      if (std::isfinite(row[k])) continue;
      const std::string column = printable(columns_[static_cast<std::size_t>(k)]);
      bad.report(bad_row(file().path(), position,
                         "column " + column + " is " + number(row[k]) + "; it must be finite"));
      return;
    }
    if (block.count() != i) block.numbers.col(block.count()) = row;
    block.positions.push_back(position);
  }

  NpyReader reader_;
  std::size_t form_ = 0;
  std::vector<std::string> columns_;
  std::int64_t row_ = 0;  // rows read
};

struct RowSource {
  using Reader = std::variant<CsvNumbers, NpyRows>;
  Reader reader;

  const InputFile& file() const {
    return std::visit([](const auto& any) -> const InputFile& { return any.file(); }, reader);
  }
};

struct RowSink {
  using Writer = std::variant<CsvWriter, NpyWriter>;
  Writer writer;
};

}  // namespace internal

namespace {

using internal::in_quotes;
using internal::RowSink;
using internal::RowSource;

constexpr auto csv = std::in_place_index<0>;
constexpr auto npy = std::in_place_index<1>;

/// The format of a table that is read. A file without an ending, such as a pipe, is .csv.
RowFormat source_format(const std::string& path) {
  if (extension(path).empty()) return RowFormat::csv;
  try {
    return row_format(path);
  } catch (const Error&) {
    throw FileError(path, 0, "is not a known kind of table; known are .csv, .npy");
  }
}

std::unique_ptr<RowSource> open_source(const std::string& path, const RowForms& forms,
                                       const RowUnits& units) {
  if (source_format(path) == RowFormat::csv) {
    return std::unique_ptr<RowSource>(new RowSource{RowSource::Reader(csv, path, forms, units)});
  }
  return std::unique_ptr<RowSource>(new RowSource{RowSource::Reader(npy, path, forms)});
}

std::unique_ptr<RowSink> open_sink(const std::string& path, const std::vector<std::string>& names,
                                   bool single, int threads) {
  if (row_format(path) == RowFormat::npy) {
    const auto width = static_cast<Eigen::Index>(names.size());
    return std::unique_ptr<RowSink>(new RowSink{RowSink::Writer(npy, path, width, single)});
  }
  if (single) throw Error("32-bit numbers are for .npy files, not for " + in_quotes(path));
  return std::unique_ptr<RowSink>(new RowSink{RowSink::Writer(csv, path, names, threads)});
}

}  // namespace

FileError bad_row(const std::string& path, const RowPosition& position,
                  const std::string& message) {
  const bool counted = position.line <= std::numeric_limits<int>::max();
  return {path, counted ? static_cast<int>(position.line) : 0,
          "row " + std::to_string(position.row) + ": " + message};
}

void BadRows::report(const FileError& error) {
  if (!skip) throw error;
  if (count++ == 0) first = error.what();
}

std::string described(const RowForms& forms) {
  std::string text;
  for (const auto& form : forms) text += (text.empty() ? "" : " or ") + listed(form);
  return text;
}

RowFormat row_format(const std::string& path) {
  const std::string ending = extension(path);
  if (path == "-" || ending == "csv") return RowFormat::csv;
  if (ending == "npy") return RowFormat::npy;
  throw Error("tables of numbers are .csv or .npy files, not " + in_quotes(path));
}

RowReader::RowReader(const std::string& path, const RowForms& forms, const RowUnits& units)
    : source_(open_source(path, forms, units)) {}

RowReader::~RowReader() = default;

bool RowReader::has_header() const {
  return std::visit([](const auto& reader) { return reader.has_header(); }, source_->reader);
}

std::vector<std::string> RowReader::commented_units() const {
  return std::visit(
      [](const auto& reader) { return std::vector<std::string>(reader.commented_units()); },
      source_->reader);
}

std::size_t RowReader::form() const {
  return std::visit([](const auto& reader) { return reader.form(); }, source_->reader);
}

void RowReader::read(RowBlock& block, BadRows& bad) {
  std::visit([&](auto& reader) { reader.read(block, bad); }, source_->reader);
}

std::string RowReader::path() const { return source_->file().path(); }

std::optional<double> RowReader::fraction_read() const {
  const InputFile& file = source_->file();
  if (!file.size() || *file.size() == 0) return std::nullopt;
  return static_cast<double>(file.position()) / static_cast<double>(*file.size());
}

RowWriter::RowWriter(const std::string& path, const std::vector<std::string>& names, bool single,
                     int threads)
    : sink_(open_sink(path, names, single, threads)) {}

RowWriter::~RowWriter() = default;

void RowWriter::write(const Eigen::Ref<const Eigen::MatrixXd>& block) {
  std::visit([&block](auto& writer) { writer.write(block); }, sink_->writer);
}

void RowWriter::commit() {
  std::visit([](auto& writer) { writer.commit(); }, sink_->writer);
}

}  // namespace beeline
