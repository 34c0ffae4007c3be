#include <algorithm>
#include <cmath>

#include <beeline/read/file.h>
#include <beeline/read/name.h>
#include <beeline/record/number_rows.h>

namespace beeline {
namespace {

using Reader = std::variant<CsvReader, NpyReader>;
using Writer = std::variant<CsvWriter, NpyWriter>;

Reader open_reader(const std::string& path, const RowForms& forms) {
  if (row_format(path) == RowFormat::csv) return Reader(std::in_place_index<0>, path, forms);
  return Reader(std::in_place_index<1>, path);
}

Writer open_writer(const std::string& path, const std::vector<std::string>& names, bool single,
                   int threads) {
  if (row_format(path) == RowFormat::npy) {
    return Writer(std::in_place_index<1>, path, static_cast<Eigen::Index>(names.size()), single);
  }
  if (single) throw Error("32-bit numbers are for .npy files, not for " + in_quotes(path));
  return Writer(std::in_place_index<0>, path, names, threads);
}

std::size_t form_of(const NpyReader& reader, const RowForms& forms) {
  const auto width = static_cast<std::size_t>(reader.header().width);
  const auto same = [width](const auto& form) { return form.size() == width; };
  const auto form = std::ranges::find_if(forms, same);
  if (form != forms.end()) return static_cast<std::size_t>(form - forms.begin());
  std::string text = "has rows of " + std::to_string(width) + " number" + (width == 1 ? "" : "s") +
                     "; rows are " + described(forms);
  if (width == 1 && std::ranges::any_of(forms, [&](const auto& candidate) {
        return static_cast<std::int64_t>(candidate.size()) == reader.header().rows;
      })) {
    text += ": one row is array.reshape(1, -1)";
  }
  throw FileError(reader.file().path(), 0, text);
}

}  // namespace

RowFormat row_format(const std::string& path) {
  const std::string ending = extension(path);
  if (path == "-" || ending == "csv") return RowFormat::csv;
  if (ending == "npy") return RowFormat::npy;
  throw Error("rows of numbers are kept in .csv or .npy files, not in " + in_quotes(path));
}

RowReader::RowReader(const std::string& path, const RowForms& forms)
    : reader_(open_reader(path, forms)), forms_(forms) {
  if (const auto* npy = std::get_if<NpyReader>(&reader_)) npy_form_ = form_of(*npy, forms);
}

std::size_t RowReader::form() const {
  const auto* csv = std::get_if<CsvReader>(&reader_);
  return csv != nullptr ? csv->form() : npy_form_;
}

const InputFile& RowReader::file() const {
  return std::visit([](const auto& reader) -> const InputFile& { return reader.file(); }, reader_);
}

void RowReader::read(RowBlock& block, BadRows& bad) {
  if (auto* csv = std::get_if<CsvReader>(&reader_)) return csv->read(block, bad);
  read_npy(std::get<NpyReader>(reader_), block, bad);
}

void RowReader::read_npy(NpyReader& reader, RowBlock& block, BadRows& bad) {
  block.places.clear();
  // A block of bad rows alone is not yet the end.
  while (block.places.empty()) {
    const Eigen::Index count = reader.read(block.numbers);
    if (count == 0) return;
    for (Eigen::Index i = 0; i < count; ++i) {
      const RowPlace place{++row_, 0};
      const auto row = block.numbers.col(i);
      if (!row.allFinite()) {
        const auto finite = [](double value) { return std::isfinite(value); };
        const auto k = std::find_if_not(row.begin(), row.end(), finite) - row.begin();
        const std::string column = printable(forms_[npy_form_][k]);
        bad.meet(bad_row(reader.file().path(), place,
                         "column " + column + " is " + number(row[k]) + "; it must be finite"));
        continue;
      }
      if (block.count() != i) block.numbers.col(block.count()) = row;
      block.places.push_back(place);
    }
  }
}

RowWriter::RowWriter(const std::string& path, const std::vector<std::string>& names, bool single,
                     int threads)
    : writer_(open_writer(path, names, single, threads)) {}

void RowWriter::write(const Eigen::Ref<const Eigen::MatrixXd>& block) {
  std::visit([&block](auto& writer) { writer.write(block); }, writer_);
}

void RowWriter::put_in_place() {
  std::visit([](auto& writer) { writer.put_in_place(); }, writer_);
}

}  // namespace beeline
