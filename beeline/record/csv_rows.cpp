#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <thread>

#include <beeline/read/csv.h>
#include <beeline/read/name.h>
#include <beeline/read/numbers.h>
#include <beeline/record/csv_rows.h>

namespace beeline {
namespace {

constexpr std::size_t max_text = 25;  // of a number with its comma: -2.2250738585072014e-308,

std::size_t longest_line(const RowForms& forms) {
  std::size_t width = 0;
  for (const auto& form : forms) width = std::max(width, form.size());
  return (std::size_t{1} << 20) + 64 * width;
}

bool is_number(const std::string& item) {
  double value = 0;
  const char* const last = item.data() + item.size();
  return std::from_chars(item.data() + (item.starts_with('+') ? 1 : 0), last, value).ptr == last;
}

const char* past_blanks(const char* at, const char* last) {
  while (at < last && (*at == ' ' || *at == '\t')) ++at;
  return at;
}

/// The rows of `block` from `first` to before `last`, as text. `text` has room for them.
void format(const Eigen::Ref<const Eigen::MatrixXd>& block, Eigen::Index first, Eigen::Index last,
            std::string& text) {
  char* at = text.data();
  char* const end = at + text.size();
  for (Eigen::Index row = first; row < last; ++row) {
    for (Eigen::Index k = 0; k < block.rows(); ++k) {
      const double value = block(k, row);
      if (std::isnan(value)) {
        at = std::copy_n("nan", 3, at);  // not -nan
      } else {
        at = std::to_chars(at, end, value).ptr;
      }
      *at++ = k + 1 < block.rows() ? ',' : '\n';
    }
  }
  text.resize(static_cast<std::size_t>(at - text.data()));
}

}  // namespace

LineReader::LineReader(const std::string& path, std::size_t longest)
    : file_(path, Dash::standard), buffer_(longest) {}

bool LineReader::next_of_any_kind(std::string_view& line) {
  std::size_t looked_at = 0;
  for (;;) {
    const std::size_t there = end_ - begin_;
    const char* const begin = buffer_.data() + begin_;
    const void* const found = std::memchr(begin + looked_at, '\n', there - looked_at);
    if (found != nullptr || (ended_ && there > 0)) {
      const std::size_t length =
          found == nullptr ? there
                           : static_cast<std::size_t>(static_cast<const char*>(found) - begin);
      line = {begin, length};
      begin_ += std::min(length + 1, there);
      ++number_;
      return true;
    }
    if (ended_) return false;
    if (there == buffer_.size()) {
      throw FileError(file_.path(), 0,
                      "line " + std::to_string(number_ + 1) + " is longer than " +
                          std::to_string(buffer_.size()) + " bytes; is this a CSV file?");
    }
    looked_at = there;
    std::memmove(buffer_.data(), begin, there);
    begin_ = 0;
    end_ = there + file_.read(buffer_.data() + there, buffer_.size() - there);
    ended_ = end_ < buffer_.size();
  }
}

bool LineReader::next(std::string_view& line) {
  while (next_of_any_kind(line)) {
    if (number_ == 1 && line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
    line = trimmed(line);
    if (!line.empty() && line.front() != '#') return true;
  }
  return false;
}

CsvReader::CsvReader(const std::string& path, const RowForms& forms)
    : lines_(path, longest_line(forms)) {
  std::string_view line;
  if (!lines_.next(line)) throw FileError(lines_.file().path(), 0, "is empty; it needs rows");
  try {
    const std::vector<std::string> items = csv_items(line);
    if (read_header(items, forms)) return;
    // Rows alone: how many numbers there are in the first tells the form, where there is a choice.
    const auto same_length = [&](const auto& form) { return form.size() == items.size(); };
    const auto form = std::ranges::find_if(forms, same_length);
    if (form == forms.end() && forms.size() > 1) {
      throw Error("row 1: it has " + std::to_string(items.size()) + " items; rows are " +
                  described(forms));
    }
    form_ = form == forms.end() ? 0 : static_cast<std::size_t>(form - forms.begin());
  } catch (const Error& error) {
    throw FileError(lines_.file().path(), static_cast<int>(lines_.number()), error.what());
  }
  columns_ = forms[form_];
  for (std::size_t k = 0; k < columns_.size(); ++k) place_.push_back(static_cast<Eigen::Index>(k));
  first_ = line;
  first_line_ = lines_.number();
}

bool CsvReader::read_header(const std::vector<std::string>& items, const RowForms& forms) {
  for (form_ = 0; form_ < forms.size(); ++form_) {
    const std::vector<std::string>& form = forms[form_];
    if (!std::ranges::is_permutation(items, form)) continue;
    for (const std::string& item : items) {
      place_.push_back(std::ranges::find(form, item) - form.begin());
    }
    columns_ = items;
    return true;
  }
  const auto has_sense_as_row = [](const std::string& item) {
    return item.empty() || is_number(item);
  };
  if (std::ranges::any_of(items, has_sense_as_row)) return false;
  std::vector<std::string> quoted;
  for (const std::string& item : items) quoted.push_back(printable(item));
  throw Error("the header has the columns " + listed(quoted) + "; rows are " + described(forms) +
              ", in any order, or in this one without a header");
}

bool CsvReader::parse_plain(std::string_view line, double* numbers) const {
  const char* at = line.data();
  const char* const last = at + line.size();
  for (std::size_t k = 0; k < place_.size(); ++k) {
    at = past_blanks(at, last);
    double value = 0;
    const auto [end, fault] = std::from_chars(at, last, value);
    if (fault != std::errc() || !std::isfinite(value)) return false;
    at = past_blanks(end, last);
    const bool comma = at < last && *at == ',';
    if (comma != (k + 1 < place_.size()) || (!comma && at != last)) return false;
    ++at;
    numbers[place_[k]] = value;
  }
  return true;
}

/// What is not plain may still be right, such as "1","2" or +1; else this says what is wrong.
void CsvReader::parse_with_care(std::string_view line, double* numbers) const {
  const std::vector<std::string> items = csv_items(line);
  if (items.size() != place_.size()) {
    throw Error("it has " + std::to_string(items.size()) + " items; a row has " +
                std::to_string(place_.size()) + ": " + listed(columns_));
  }
  for (std::size_t k = 0; k < items.size(); ++k) {
    numbers[place_[k]] = parse_number(items[k], "column " + printable(columns_[k]));
  }
}

void CsvReader::read(RowBlock& block, BadRows& bad) {
  block.places.clear();
  std::string_view line;
  while (block.count() < block.numbers.cols()) {
    RowPlace place;
    if (!first_.empty() && row_ == 0) {
      line = first_;
      place.line = first_line_;
    } else if (lines_.next(line)) {
      place.line = lines_.number();
    } else {
      return;
    }
    place.row = ++row_;
    double* const numbers = block.numbers.col(block.count()).data();
    if (!parse_plain(line, numbers)) {
      try {
        parse_with_care(line, numbers);
      } catch (const Error& error) {
        bad.meet(bad_row(file().path(), place, error.what()));
        continue;
      }
    }
    block.places.push_back(place);
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
  constexpr Eigen::Index worth_a_thread = 1024;  // rows
  const auto parts = std::min<Eigen::Index>(static_cast<Eigen::Index>(texts_.size()),
                                            1 + block.cols() / worth_a_thread);
  const auto start = [&](Eigen::Index i) { return block.cols() * i / parts; };
  for (Eigen::Index i = 0; i < parts; ++i) {  // here, as a thread could not say that memory ran out
    const auto numbers = static_cast<std::size_t>((start(i + 1) - start(i)) * block.rows());
    texts_[i].resize(numbers * max_text);
  }
  const auto part = [&](Eigen::Index i) { format(block, start(i), start(i + 1), texts_[i]); };
  {
    std::vector<std::jthread> others;
    for (Eigen::Index i = 1; i < parts; ++i) others.emplace_back(part, i);
    part(0);
  }
  for (Eigen::Index i = 0; i < parts; ++i) file_.append(texts_[i]);
}

}  // namespace beeline
