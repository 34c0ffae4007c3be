#include <algorithm>
#include <cmath>
#include <thread>

#include <beeline/read/internal/csv.h>
#include <beeline/read/internal/name.h>
#include <beeline/read/internal/numbers.h>
#include <beeline/record/internal/csv_rows.h>

namespace beeline::internal {
namespace {

/// Max length of a line of the forms, including spaces between its numbers.
std::size_t max_line(const RowForms& forms) {
  std::size_t width = 0;
  for (const auto& form : forms) width = std::max(width, form.size());
  return (std::size_t{1} << 20) + 64 * width;
}

bool is_number(const std::string& item) {
  double value = 0;
  const char* const last = item.data() + item.size();
  return parse_double(item.data() + (item.starts_with('+') ? 1 : 0), last, value).ptr == last;
}

bool is_same_set(std::vector<std::string> a, std::vector<std::string> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

const char* past_blanks(const char* at, const char* last) {
  while (at < last && (*at == ' ' || *at == '\t')) ++at;
  return at;
}

/// Formats the rows of `block` from `first` to before `last` into `text`, which must be long
/// enough.
void format(const Eigen::Ref<const Eigen::MatrixXd>& block, Eigen::Index first, Eigen::Index last,
            std::string& text) {
  char* at = text.data();
  for (Eigen::Index row = first; row < last; ++row) {
    for (Eigen::Index k = 0; k < block.rows(); ++k) {
      at = write_double(at, block(k, row));
      *at++ = k + 1 < block.rows() ? ',' : '\n';
    }
  }
  text.resize(static_cast<std::size_t>(at - text.data()));
}

/// Runs part(0) to part(count - 1), each in a thread of its own, the first in this one.
template <typename Part>
void run_parts(Eigen::Index count, const Part& part) {
  struct Joined {  // std::jthread, which libc++ 14 lacks
    std::vector<std::thread> threads;
    ~Joined() {
      for (std::thread& thread : threads) thread.join();
    }
  } others;
  for (Eigen::Index i = 1; i < count; ++i) others.threads.emplace_back(part, i);
  part(0);
}

}  // namespace

CsvReader::CsvReader(const std::string& path, const RowForms& forms)
    : file_(path, Dash::standard), lines_(file_, max_line(forms)) {
  std::string_view line;
  if (!lines_.next(line)) throw FileError(file_.path(), 0, "is empty; it needs rows");
  try {
    separator_ = csv_separator(line);
    const std::vector<std::string> items = csv_items(line, separator_);
    if (read_header(items, forms)) return;
    has_header_ = false;
    choose_form(items.size(), forms);
  } catch (const Error& error) {
    throw FileError(file_.path(), static_cast<int>(lines_.number()), error.what());
  }
  columns_ = forms[form_];
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    index_of_.push_back(static_cast<Eigen::Index>(k));
  }
  first_ = line;
  first_line_ = lines_.number();
}

/// Chooses the form by the number of items in the first row, where there are several forms.
void CsvReader::choose_form(std::size_t width, const RowForms& forms) {
  const auto form = std::find_if(forms.begin(), forms.end(),
                                 [width](const auto& names) { return names.size() == width; });
  if (form != forms.end()) {
    form_ = static_cast<std::size_t>(form - forms.begin());
  } else if (forms.size() > 1) {
    throw Error("row 1: it has " + std::to_string(width) + " items; rows are " + described(forms));
  } else {
    form_ = 0;
  }
}

/// Returns false when `items` are a row of numbers. Throws Error for names of no form.
bool CsvReader::read_header(const std::vector<std::string>& items, const RowForms& forms) {
  for (form_ = 0; form_ < forms.size(); ++form_) {
    const std::vector<std::string>& form = forms[form_];
    if (!is_same_set(items, form)) continue;
    for (const std::string& item : items) {
      index_of_.push_back(std::find(form.begin(), form.end(), item) - form.begin());
    }
    columns_ = items;
    return true;
  }
  const auto may_be_number = [](const std::string& item) {
    return item.empty() || is_number(item);
  };
  if (std::any_of(items.begin(), items.end(), may_be_number)) return false;
  std::vector<std::string> quoted;
  for (const std::string& item : items) quoted.push_back(printable(item));
  throw Error("the header has the columns " + listed(quoted) + "; rows are " + described(forms) +
              ", in any order, or in this one without a header");
}

/// Parses a row without quotation marks and `+`; returns false for any other row.
bool CsvReader::parse_plain(std::string_view line, double* numbers) const {
  const char* at = line.data();
  const char* const last = at + line.size();
  for (std::size_t k = 0; k < index_of_.size(); ++k) {
    at = past_blanks(at, last);
    double value = 0;
    const auto [end, fault] = parse_double(at, last, value);
    if (fault != std::errc() || !std::isfinite(value)) return false;
    at = past_blanks(end, last);
    const bool more = at < last && *at == separator_;
    if (more != (k + 1 < index_of_.size()) || (!more && at != last)) return false;
    ++at;
    numbers[index_of_[k]] = value;
  }
  return true;
}

/// Parses any row, such as "1","2" or +1. Throws Error that describes what is wrong with it.
void CsvReader::parse_quoted(std::string_view line, double* numbers) const {
  const std::vector<std::string> items = csv_items(line, separator_);
  if (items.size() != index_of_.size()) {
    throw Error("it has " + std::to_string(items.size()) + " items; a row has " +
                std::to_string(index_of_.size()) + ": " + listed(columns_));
  }
  for (std::size_t k = 0; k < items.size(); ++k) {
    numbers[index_of_[k]] = parse_number(items[k], "column " + printable(columns_[k]));
  }
}

void CsvReader::read(RowBlock& block, BadRows& bad) {
  block.positions.clear();
  std::string_view line;
  while (block.count() < block.numbers.cols()) {
    RowPosition position;
    if (!first_.empty() && row_ == 0) {
      line = first_;
      position.line = first_line_;
    } else if (lines_.next(line)) {
      position.line = lines_.number();
    } else {
      return;
    }
    position.row = ++row_;
    double* const numbers = block.numbers.col(block.count()).data();
    if (!parse_plain(line, numbers)) {
      try {
        parse_quoted(line, numbers);
      } catch (const Error& error) {
        bad.report(bad_row(file().path(), position, error.what()));
        continue;
      }
    }
    block.positions.push_back(position);
  }
}

CsvWriter::CsvWriter(const std::string& path, const std::vector<std::string>& names, int threads)
    : file_(path, Dash::standard) {
  const unsigned all = std::max(1U, std::thread::hardware_concurrency());
  texts_.resize(threads > 0 ? static_cast<std::size_t>(threads) : all);
  std::string header;
  for (const std::string& name : names) header += (header.empty() ? "" : ",") + csv_name(name);
  file_.append(header + "\n");
}

void CsvWriter::write(const Eigen::Ref<const Eigen::MatrixXd>& block) {
  constexpr Eigen::Index rows_per_thread =
      1024;  // formatting these takes longer than a thread's start
  const auto parts = std::min<Eigen::Index>(static_cast<Eigen::Index>(texts_.size()),
                                            1 + block.cols() / rows_per_thread);
  const auto start = [&](Eigen::Index i) { return block.cols() * i / parts; };
  // Allocates here: an exception must not leave a thread.
  for (Eigen::Index i = 0; i < parts; ++i) {
    const auto numbers = static_cast<std::size_t>((start(i + 1) - start(i)) * block.rows());
    texts_[static_cast<std::size_t>(i)].resize(numbers * (max_number_length + 1));
  }
  run_parts(parts, [&](Eigen::Index i) {
    format(block, start(i), start(i + 1), texts_[static_cast<std::size_t>(i)]);
  });
  for (Eigen::Index i = 0; i < parts; ++i) file_.append(texts_[static_cast<std::size_t>(i)]);
}

}  // namespace beeline::internal
