#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <sstream>
#include <unordered_set>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <beeline/error.h>
#include <beeline/internal/utf8.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/text_encoding.h>
#include <beeline/io/text/internal/yaml.h>

namespace beeline::internal {
namespace {

constexpr int max_yaml_depth = 64;
/// yaml-cpp keeps all words of a line, as a list may be a key.
constexpr std::size_t max_line_bytes = std::size_t{1} << 20;

/// A value with its bounds: the number of values in it, itself included, and its levels.
struct Measured {
  Yaml yaml;
  std::size_t values = 1;
  int levels = 1;
};

/// Builds the tree from the parser's events. An exception ends the parser's recursion.
class YamlBuilder final : public YAML::EventHandler {
 public:
  YamlBuilder(const std::string& path, std::size_t max_values, int first_line)
      : path_(path), max_values_(max_values), first_line_(first_line) {}

  Yaml take() { return std::move(root_.yaml); }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (documents_++ > 0) second_line_ = line_of(mark);
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    if (documents_ == 2 && open_.empty()) return;  // the last line may be ---
    add({.yaml = {.value = "", .tag = "", .line = line_of(mark)}}, anchor);
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto named = anchors_.find(anchor);
    if (named == anchors_.end()) refuse(line_of(mark), "an alias is inside its own anchor");
    Measured copy = named->second;
    copy.yaml.line = line_of(mark);
    add(std::move(copy), YAML::NullAnchor);
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& text) override {
    add({.yaml = {.value = text, .tag = tag, .line = line_of(mark)},
         .values = 1 + text.size() / 64},
        anchor);
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value /*style*/) override {
    open({.value = Yaml::Items{}, .tag = tag, .line = line_of(mark)}, anchor);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value /*style*/) override {
    open({.value = Yaml::Members{}, .tag = tag, .line = line_of(mark)}, anchor);
  }
  void OnMapEnd() override {
    merge();
    close();
  }

 private:
  /// A list or a map whose end has not been read.
  struct Open {
    Measured measured;
    YAML::anchor_t anchor = YAML::NullAnchor;
    bool has_key = false;  // the last member of the map has no value yet
    std::unordered_set<std::string> keys;
  };

  int line_of(const YAML::Mark& mark) const { return mark.line + first_line_; }

  [[noreturn]] void refuse(int line, const std::string& why) const {
    throw FileError(path_, line, why);
  }

  [[noreturn]] void refuse_size(int line) const {
    refuse(line, "holds more than " + std::to_string(max_values_) + " values");
  }

  void open(Yaml&& empty, YAML::anchor_t anchor) {
    if (open_.size() >= max_yaml_depth) refuse(empty.line, "is nested deeper than 64 levels");
    open_.push_back({.measured = {.yaml = std::move(empty)}, .anchor = anchor, .keys = {}});
  }

  void close() {
    Open closed = std::move(open_.back());
    open_.pop_back();
    add(std::move(closed.measured), closed.anchor);
  }

  void add(Measured&& value, YAML::anchor_t anchor) {
    if (second_line_ > 0) refuse(second_line_, "has a second document; give one in each file");
    if (static_cast<int>(open_.size()) + value.levels > max_yaml_depth + 1) {
      refuse(value.yaml.line, "is nested deeper than 64 levels");
    }
    if (anchor != YAML::NullAnchor) {
      count(value);
      anchors_[anchor] = value;
    }
    if (open_.empty()) {
      root_ = std::move(value);
      return;
    }
    Open& parent = open_.back();
    if (auto* items = std::get_if<Yaml::Items>(&parent.measured.yaml.value)) {
      grow(parent.measured, value);
      items->push_back(std::move(value.yaml));
    } else if (parent.has_key) {
      grow(parent.measured, value);
      std::get<Yaml::Members>(parent.measured.yaml.value).back().value = std::move(value.yaml);
      parent.has_key = false;
    } else {
      add_key(parent, value.yaml);
    }
  }

  void add_key(Open& map, const Yaml& key) {
    const auto* text = std::get_if<std::string>(&key.value);
    if (text == nullptr) refuse(key.line, "a key must be a name, not a list or a map");
    if (!is_utf8(*text)) refuse(key.line, "the key " + in_quotes(*text) + " " + not_utf8(*text));
    if (!map.keys.insert(*text).second) {
      refuse(key.line, "the key " + in_quotes(*text) + " is given twice");
    }
    auto& members = std::get<Yaml::Members>(map.measured.yaml.value);
    members.push_back({*text, key.line, {}});
    map.has_key = true;
  }

  /// Counts the values of all copies, so that aliases of aliases end early.
  void count(const Measured& value) {
    values_ += value.values;
    if (values_ > max_values_) refuse_size(value.yaml.line);
  }

  void grow(Measured& parent, const Measured& value) {
    count({.yaml = {.value = "", .tag = "", .line = value.yaml.line}});
    parent.values += value.values;
    parent.levels = std::max(parent.levels, value.levels + 1);
    if (parent.values > max_values_) refuse_size(value.yaml.line);
  }

  /// Replaces the merge key of the map that ends by the members that it lacks.
  void merge() {
    Open& map = open_.back();
    auto& members = std::get<Yaml::Members>(map.measured.yaml.value);
    const auto key = std::find_if(members.begin(), members.end(),
                                  [](const YamlMember& member) { return member.key == "<<"; });
    if (key == members.end()) return;
    const Yaml source = std::move(key->value);
    members.erase(key);
    const auto add_from = [&](const Yaml& from) {
      const auto* added = std::get_if<Yaml::Members>(&from.value);
      if (added == nullptr) refuse(source.line, "the key << must have maps");
      for (const YamlMember& member : *added) {
        if (map.keys.insert(member.key).second) members.push_back(member);
      }
    };
    if (const auto* list = std::get_if<Yaml::Items>(&source.value)) {
      for (const Yaml& from : *list) add_from(from);
    } else {
      add_from(source);
    }
  }

  const std::string& path_;
  std::size_t max_values_;
  int first_line_;
  Measured root_;
  std::vector<Open> open_;  // from the root down
  std::map<YAML::anchor_t, Measured> anchors_;
  std::size_t values_ = 0;
  int documents_ = 0;
  int second_line_ = 0;  // of the second document, if there is one
};

void refuse_long_lines(std::string_view text, const std::string& path, int line) {
  for (std::size_t begin = 0; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end - begin > max_line_bytes) {
      throw FileError(path, line, "is longer than 1 MiB; write the lists on several lines");
    }
    begin = end + 1;
  }
}

}  // namespace

Yaml parse_yaml(std::string_view text, const std::string& path, const YamlBounds& bounds,
                int first_line) {
  if (text.size() > bounds.bytes) {
    throw FileError(path, 0, "is larger than " + std::to_string(bounds.bytes >> 20) + " MiB");
  }
  text = text_in(text, path);
  refuse_long_lines(text, path, first_line);
  std::istringstream stream{std::string(text)};
  YamlBuilder builder(path, bounds.values, first_line);
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {
    }
  } catch (const YAML::Exception& error) {
    throw FileError(path, error.mark.line + first_line, "is not YAML: " + printable(error.msg));
  }
  return builder.take();
}

Yaml as_yaml(const Json& json) {
  Yaml yaml{.value = "", .tag = "", .line = json.line};
  if (const auto* text = std::get_if<std::string>(&json.value)) {
    yaml.value = *text;
    yaml.tag = "!";
  } else if (const auto* items = std::get_if<Json::Items>(&json.value)) {
    Yaml::Items list;
    list.reserve(items->size());
    for (const Json& item : *items) list.push_back(as_yaml(item));
    yaml.value = std::move(list);
  } else if (const auto* members = std::get_if<Json::Members>(&json.value)) {
    Yaml::Members map;
    for (const auto& [key, value] : *members) map.push_back({key, value.line, as_yaml(value)});
    yaml.value = std::move(map);
  } else if (const auto* number = std::get_if<double>(&json.value);
             number != nullptr && std::abs(*number) < 1e15 && *number == std::trunc(*number)) {
    yaml.value = std::to_string(static_cast<std::int64_t>(*number));
  } else if (!std::holds_alternative<std::nullptr_t>(json.value)) {
    yaml.value = json.text();
  }
  return yaml;
}

}  // namespace beeline::internal
