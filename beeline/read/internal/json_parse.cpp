#include <cstddef>
#include <iterator>
#include <nlohmann/json.hpp>

#include <beeline/error.h>
#include <beeline/read/internal/json_parse.h>
#include <beeline/read/internal/name.h>

namespace beeline::internal {
namespace {

constexpr std::size_t max_depth = 64;
constexpr std::size_t max_values = 8'000'000;  // about 0.5 GB of memory
constexpr std::size_t max_keys =
    32;  // our formats have ten; the search for a repeated key is O(n^2)

/// The line of the last character read. A line break counts only when the character after it is
/// read, because the parser reads one character beyond a number.
struct Position {
  int line = 1;
  bool broken = false;  // the last character read was a line break

  void read(char c) {
    line += broken ? 1 : 0;
    broken = c == '\n';
  }
};

class CountingIterator {
 public:
  // NOLINTBEGIN(readability-identifier-naming): std::iterator_traits wants these names
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  // NOLINTEND(readability-identifier-naming)

  CountingIterator(const char* at, Position& position) : at_(at), position_(&position) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    position_->read(*at_++);
    return *this;
  }
  CountingIterator operator++(int) {
    const CountingIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  Position* position_;
};

/// Builds the tree from the parser's events. The parser itself does not recurse.
class Builder {
 public:
  Builder(Json& root, const Position& position, const std::string& path)
      : root_(root), position_(position), path_(path) {}

  // Each returns whether the parser shall continue.
  bool null() { return add(nullptr); }
  bool boolean(bool value) { return add(value); }
  bool number_integer(std::int64_t value) { return add(static_cast<double>(value)); }
  bool number_unsigned(std::uint64_t value) { return add(static_cast<double>(value)); }
  bool number_float(double value, const std::string& /*digits*/) { return add(value); }
  bool string(std::string& value) { return add(std::move(value)); }
  bool binary(std::vector<std::uint8_t>& /*value*/) { return false; }  // not part of JSON text
  bool start_object(std::size_t /*size*/) { return open(Json::Members{}); }
  bool start_array(std::size_t /*size*/) { return open(Json::Items{}); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool key(std::string& key) {
    auto& members = std::get<Json::Members>(open_.back()->value);
    for (const auto& [name, value] : members) {
      if (name == key) refuse("the key " + in_quotes(key) + " is given twice");
    }
    if (members.size() == max_keys) refuse("an object has more than 32 keys");
    members.push_back({std::move(key), {}});
    return true;
  }

  bool parse_error(std::size_t /*byte*/, const std::string& /*token*/,
                   const nlohmann::json::exception& error) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while ..."
    std::string_view why = error.what();
    why.remove_prefix(std::min(why.size(), why.find("] ") + 2));
    const std::size_t colon = why.find(": ");
    if (why.starts_with("parse error at ")) why.remove_prefix(std::min(why.size(), colon + 2));
    constexpr std::string_view known = "syntax error while ";
    if (why.starts_with(known)) why.remove_prefix(known.size());
    refuse("is not JSON: " + printable(why));
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw FileError(path_, position_.line, why);
  }

  template <typename Value>
  bool add(Value&& value) {
    if (++count_ > max_values) refuse("holds more than 8 million values");
    last_ = &root_;
    if (!open_.empty()) {
      auto& parent = open_.back()->value;
      if (auto* items = std::get_if<Json::Items>(&parent)) {
        last_ = &items->emplace_back();
      } else {
        last_ = &std::get<Json::Members>(parent).back().value;
      }
    }
    last_->value = std::forward<Value>(value);
    last_->line = position_.line;
    return true;
  }

  template <typename Value>
  bool open(Value&& empty) {
    if (open_.size() == max_depth) refuse("is nested deeper than 64 levels");
    add(std::forward<Value>(empty));
    open_.push_back(last_);
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  Json& root_;
  const Position& position_;
  const std::string& path_;
  std::vector<Json*> open_;  // from the root down; only the last one grows, so that none moves
  Json* last_ = nullptr;     // the value added last
  std::size_t count_ = 0;
};

}  // namespace

Json parse_json(std::string_view text, const std::string& path) {
  Json root;
  Position position;
  Builder builder(root, position, path);
  nlohmann::json::sax_parse(CountingIterator(text.data(), position),
                            CountingIterator(text.data() + text.size(), position), &builder);
  return root;
}

}  // namespace beeline::internal
