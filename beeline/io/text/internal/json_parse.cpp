#include <cstddef>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>

#include <beeline/error.h>
#include <beeline/internal/utf8.h>
#include <beeline/io/text/internal/json_parse.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/text_encoding.h>

namespace beeline::internal {
namespace {

constexpr std::size_t max_depth = 64;
constexpr std::size_t max_values = 8'000'000;  // about 0.5 GB of memory
constexpr std::size_t max_keys =
    32;  // our formats have ten; the search for a repeated key is O(n^2)

/// The characters of a text, or of a file block by block, and the line of the last one read. A line
/// break counts only when the character after it is read, because the parser reads one character
/// beyond a number.
class Characters {
 public:
  Characters(std::string_view text, const std::string& path) : unread_(text_in(text, path)) {}
  explicit Characters(InputFile& file) : file_(&file), block_(std::size_t{1} << 16, '\0') {
    begin_text(file);
    read_block();
  }
  Characters(const Characters&) = delete;
  Characters& operator=(const Characters&) = delete;

  bool ended() const { return unread_.empty(); }
  char front() const { return unread_.front(); }
  int line() const { return line_; }

  /// Skips blanks, lines that begin with # and dashes, up to the first other character.
  void skip_comments() {
    bool comment = false;
    for (; !ended(); pop_front()) {
      comment = front() == '#' || (comment && front() != '\n');
      if (!comment && std::string_view(" \t\r\n-").find(front()) == std::string_view::npos) return;
    }
  }

  void pop_front() {
    if (broken_ && line_ < std::numeric_limits<int>::max()) ++line_;
    broken_ = unread_.front() == '\n';
    unread_.remove_prefix(1);
    if (unread_.empty() && file_ != nullptr) read_block();
  }

 private:
  void read_block() { unread_ = {block_.data(), file_->read(block_.data(), block_.size())}; }

  InputFile* file_ = nullptr;  // null: all text is present
  std::string block_;
  std::string_view unread_;
  int line_ = 1;
  bool broken_ = false;  // the last character read was a line break
};

/// Iterates over characters; without characters it is the end of any.
class CharacterIterator {
 public:
  // NOLINTBEGIN(readability-identifier-naming): std::iterator_traits wants these names
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = char;
  // NOLINTEND(readability-identifier-naming)

  explicit CharacterIterator(Characters* characters = nullptr) : characters_(characters) {}
  char operator*() const { return characters_->front(); }
  CharacterIterator& operator++() {
    characters_->pop_front();
    return *this;
  }
  CharacterIterator operator++(int) {
    const CharacterIterator before = *this;
    ++*this;
    return before;
  }
  bool operator==(const CharacterIterator& other) const { return ended() == other.ended(); }
  bool operator!=(const CharacterIterator& other) const { return !(*this == other); }

 private:
  bool ended() const { return characters_ == nullptr || characters_->ended(); }

  Characters* characters_;
};

/// Builds the tree from the parser's events. The parser itself does not recurse.
class Builder {
 public:
  Builder(Json& root, const Characters& characters, const std::string& path,
          const JsonItemSink& sink)
      : root_(root), characters_(characters), path_(path), sink_(sink) {}

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

  bool parse_error(std::size_t /*byte*/, const std::string& token,
                   const nlohmann::json::exception& error) {
    if (token.starts_with('"') && !is_utf8(token)) refuse(not_utf8(token));
    if (is_not_finite(token)) {
      refuse(
          "is not JSON: its numbers have no NaN and no infinity; leave out a limit that is not "
          "known");
    }
    refuse("is not JSON: " + printable(syntax_fault(error)));
  }

 private:
  /// The fault of a syntax error, of which the parser has only a text: "[json.exception...] parse
  /// error at line 1, column 2: syntax error while ...".
  static std::string_view syntax_fault(const nlohmann::json::exception& error) {
    std::string_view why = error.what();
    why.remove_prefix(std::min(why.size(), why.find("] ") + 2));
    const std::size_t colon = why.find(": ");
    if (why.starts_with("parse error at ")) why.remove_prefix(std::min(why.size(), colon + 2));
    constexpr std::string_view known = "syntax error while ";
    if (why.starts_with(known)) why.remove_prefix(known.size());
    return why;
  }

  /// Whether the characters at which the parser stopped, control characters in it as <U+000A>,
  /// begin NaN, nan, Infinity, -Infinity or inf.
  static bool is_not_finite(const std::string& text) {
    if (text.starts_with('"')) return false;
    const std::string token = text.substr(text.find_last_of(" ,:[{>") + 1);
    return token == "N" || token == "na" || token == "I" || token == "-I" || token == "i" ||
           token == "-i";
  }

  [[noreturn]] void refuse(const std::string& why) const {
    throw FileError(path_, characters_.line(), why);
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
    last_->line = characters_.line();
    if (!holds_items(*last_)) hand_over();
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
    hand_over();
    return true;
  }

  static bool holds_items(const Json& json) {
    return std::holds_alternative<Json::Items>(json.value) ||
           std::holds_alternative<Json::Members>(json.value);
  }

  /// Gives the value that is complete now to the sink, if it is an item of the sink's list.
  void hand_over() {
    if (!sink_.take || open_.size() != 2) return;
    const auto* members = std::get_if<Json::Members>(&root_.value);
    auto* items = std::get_if<Json::Items>(&open_.back()->value);
    if (members == nullptr || items == nullptr || members->back().key != sink_.key) return;
    Json item = std::move(items->back());
    items->clear();
    count_ = 0;
    sink_.take(root_, std::move(item));
  }

  Json& root_;
  const Characters& characters_;
  const std::string& path_;
  const JsonItemSink& sink_;
  std::vector<Json*> open_;  // from the root down; only the last one grows, so that none moves
  Json* last_ = nullptr;     // the value added last
  std::size_t count_ = 0;
};

Json parse_characters(Characters characters, const std::string& path, const JsonItemSink& sink,
                      JsonFront front) {
  Json root;
  if (front == JsonFront::yaml_comments) characters.skip_comments();
  Builder builder(root, characters, path, sink);
  nlohmann::json::sax_parse(CharacterIterator(&characters), CharacterIterator(), &builder);
  return root;
}

}  // namespace

Json parse_json(std::string_view text, const std::string& path, const JsonItemSink& sink,
                JsonFront front) {
  return parse_characters(Characters(text, path), path, sink, front);
}

Json parse_json(InputFile& file, const JsonItemSink& sink, JsonFront front) {
  return parse_characters(Characters(file), file.path(), sink, front);
}

}  // namespace beeline::internal
