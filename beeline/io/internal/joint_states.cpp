#include <algorithm>
#include <functional>
#include <utility>

#include <beeline/error.h>
#include <beeline/io/internal/joint_states.h>
#include <beeline/io/internal/recordable.h>
#include <beeline/io/internal/time_column.h>
#include <beeline/io/internal/trajectory_json.h>
#include <beeline/io/internal/trajectory_yaml.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/internal/text_encoding.h>
#include <beeline/io/text/internal/yaml.h>
#include <beeline/io/text/numbers.h>

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

/// Collects the samples of messages.
class JointStateReader {
 public:
  explicit JointStateReader(const std::string& path) : path_(path) {}

  void take(Json message) {
    const JsonDocument document(std::move(message), path_);
    const Json& root = document.root();
    document.check_keys(root, {"header", "name", "position", "velocity", "effort"});
    const auto [seconds, nanoseconds] =
        seconds_and_nanoseconds(document, document.need(document.need(root, "header"), "stamp"));
    const std::vector<std::size_t> order = order_of(document, document.need(root, "name"));
    if (trajectory_.size() == 0) start(seconds, nanoseconds);
    const double time =
        ((seconds - first_seconds_) * 1e9 + (nanoseconds - first_nanoseconds_)) / 1e9;
    if (trajectory_.size() > 0 && !(time > trajectory_.times.back())) {
      document.refuse(root, "is at time " + exact(time) + ", not after " +
                                exact(trajectory_.times.back()) + "; times must increase");
    }
    trajectory_.times.push_back(time);
    trajectory_.positions.push_back(values(document, document.need(root, "position"), order));
    take_velocities(document, order);
  }

  Recording finish() {
    if (trajectory_.size() == 0) throw FileError(path_, 0, "has no messages");
    try {
      check_recordable(trajectory_);
    } catch (const Error& error) {
      throw FileError(path_, 0, error.what());
    }
    recording_.trajectory = std::move(trajectory_);
    return std::move(recording_);
  }

 private:
  void start(double seconds, double nanoseconds) {
    if (!is_since_1970(seconds)) return;
    first_seconds_ = seconds;
    first_nanoseconds_ = nanoseconds;
    recording_.notes.push_back({.kind = RecordingNoteKind::times_since_1970,
                                .path = path_,
                                .columns = {"stamp.sec", "stamp.nanosec"},
                                .time_unit = TimeUnit::seconds});
  }

  /// The position of each joint of the first message in this one.
  std::vector<std::size_t> order_of(const JsonDocument& document, const Json& json) {
    std::vector<std::string> names;
    for (const Json& name : document.items(json)) names.push_back(document.text(name));
    std::vector<std::string>& joints = trajectory_.joint_names;
    if (trajectory_.size() == 0) joints = names;
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < joints.size() && joints.size() == names.size(); ++i) {
      const auto same = i < names.size() && names[i] == joints[i]
                            ? names.begin() + static_cast<std::ptrdiff_t>(i)
                            : std::find(names.begin(), names.end(), joints[i]);
      if (same == names.end()) break;
      order.push_back(static_cast<std::size_t>(same - names.begin()));
    }
    if (order.size() == joints.size() && order.size() == names.size()) return order;
    document.refuse(json, "must have the joints of the first message, " + listed(joints) +
                              ", not " + listed(names));
  }

  static Configuration values(const JsonDocument& document, const Json& json,
                              const std::vector<std::size_t>& order) {
    const std::vector<double> numbers = document.numbers(json, order.size());
    Configuration q(static_cast<Eigen::Index>(order.size()));
    for (std::size_t i = 0; i < order.size(); ++i) {
      q[static_cast<Eigen::Index>(i)] = numbers[order[i]];
    }
    return q;
  }

  /// Drivers without velocities write an empty list or .nan.
  void take_velocities(const JsonDocument& document, const std::vector<std::size_t>& order) {
    const Json* const json = document.find(document.root(), "velocity");
    const auto is_nan = [](const Json& item) {
      const auto* text = std::get_if<std::string>(&item.value);
      return text != nullptr && (*text == ".nan" || *text == ".NaN" || *text == ".NAN");
    };
    const bool known =
        json != nullptr && !document.items(*json).empty() &&
        std::none_of(document.items(*json).begin(), document.items(*json).end(), is_nan);
    std::vector<Configuration>& velocities = trajectory_.velocities;
    if (known && velocities.size() + 1 == trajectory_.size()) {
      velocities.push_back(values(document, *json, order));
    } else {
      velocities.clear();
    }
  }

  const std::string& path_;
  Recording recording_;
  Trajectory trajectory_;
  double first_seconds_ = 0, first_nanoseconds_ = 0;  ///< from which times count
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
