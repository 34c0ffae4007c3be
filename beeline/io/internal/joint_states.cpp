#include <algorithm>
#include <functional>
#include <utility>

#include <beeline/error.h>
#include <beeline/io/internal/joint_state_reader.h>
#include <beeline/io/internal/joint_states.h>
#include <beeline/io/internal/trajectory_yaml.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/internal/text_encoding.h>
#include <beeline/io/text/internal/yaml.h>

namespace beeline::internal {
namespace {

constexpr std::size_t max_document = std::size_t{1} << 20;

bool is_separator(std::string_view line) { return trimmed(line) == "---"; }

/// Splits a text at lines `---`.
class YamlDocuments {
 public:
  /// Reads so many bytes, or fewer at the end; returns their number.
  using Read = std::function<std::size_t(char*, std::size_t)>;

  YamlDocuments(Read read, const std::string& path) : read_(std::move(read)), path_(path) {}

  /// Gets the next document, valid until the next call, and its first line; false at the end.
  bool next(std::string_view& document, int& line) {
    buffer_.erase(0, taken_);
    line_ += lines_;
    line = line_;
    lines_ = 0;
    for (std::size_t begin = 0;;) {
      const std::size_t end = buffer_.find('\n', begin);
      if (end == std::string::npos && !ended_) {
        read_more();
        continue;
      }
      const std::string_view text = std::string_view(buffer_).substr(begin, end - begin);
      const bool last = end == std::string::npos;
      taken_ = last ? buffer_.size() : end + 1;
      ++lines_;
      if (!last && !is_separator(text)) {
        begin = taken_;
        continue;
      }
      document = std::string_view(buffer_).substr(0, is_separator(text) ? begin : taken_);
      return !last || !buffer_.empty();
    }
  }

 private:
  void read_more() {
    if (buffer_.size() > max_document) {
      throw FileError(path_, line_, "a message is longer than 1 MiB");
    }
    constexpr std::size_t block = std::size_t{1} << 16;
    const std::size_t size = buffer_.size();
    buffer_.resize(size + block);
    const std::size_t count = read_(buffer_.data() + size, block);
    buffer_.resize(size + count);
    ended_ = count < block;
  }

  Read read_;
  const std::string& path_;
  std::string buffer_;
  std::size_t taken_ = 0;  ///< bytes of the last document, with its separator
  int line_ = 1, lines_ = 0;
  bool ended_ = false;
};

Recording recording_from(YamlDocuments documents, const std::string& path) {
  JointStateReader reader(path);
  std::string_view text;
  for (int line = 1; documents.next(text, line);) {
    if (first_character(text) == '\0') continue;
    Yaml root = parse_yaml(text, path, {}, line);
    const auto* scalar = std::get_if<std::string>(&root.value);
    if (scalar != nullptr && scalar->empty()) continue;  // comments
    reader.take(json_of(std::move(root)));
  }
  return reader.finish();
}

}  // namespace

bool begins_with_joint_state(std::string_view text) {
  bool name = false, position = false;
  while (!text.empty() && !(name && position)) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    if (is_separator(line) && (name || position)) return false;
    name = name || line.starts_with("name:");
    position = position || line.starts_with("position:");
  }
  return name && position;
}

Recording recording_from_joint_states(std::string_view text, const std::string& path) {
  text = text_in(text, path);
  const auto read = [&text](char* bytes, std::size_t wanted) {
    const std::size_t count = text.copy(bytes, wanted);
    text.remove_prefix(count);
    return count;
  };
  return recording_from(YamlDocuments(read, path), path);
}

Recording recording_from_joint_states(InputFile& file) {
  begin_text(file);
  const auto read = [&file](char* bytes, std::size_t wanted) { return file.read(bytes, wanted); };
  return recording_from(YamlDocuments(read, file.path()), file.path());
}

}  // namespace beeline::internal
