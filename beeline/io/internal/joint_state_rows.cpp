#include <algorithm>
#include <cmath>
#include <optional>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/internal/joint_state_reader.h>
#include <beeline/io/internal/joint_state_rows.h>
#include <beeline/io/text/internal/csv_items.h>
#include <beeline/io/text/internal/csv_lines.h>
#include <beeline/io/text/internal/numbers.h>

namespace beeline::internal {
namespace {

using Items = std::vector<std::string>;
using Indices = std::vector<std::size_t>;

/// The items of a row that hold a message.
struct MessageLayout {
  std::size_t count = 0;               ///< of items in a row
  std::optional<std::size_t> stamp{};  ///< in nanoseconds; otherwise items 0 and 1 are sec, nanosec
  Indices names = {}, positions = {}, velocities = {};
  std::string unread_rates = {};  ///< numbers that are not read; empty: none
};

/// The indices of the columns front + 0, front + 1, ...
Indices numbered(const Items& header, const std::string& front) {
  Indices indices;
  for (;;) {
    const auto found =
        std::find(header.begin(), header.end(), front + std::to_string(indices.size()));
    if (found == header.end()) return indices;
    indices.push_back(static_cast<std::size_t>(found - header.begin()));
  }
}

/// The layout of rows below the header of `rostopic echo -p`.
std::optional<MessageLayout> layout_below(const Items& header) {
  MessageLayout layout{.count = header.size()};
  const std::string field = "field.";
  layout.names = numbered(header, field + "name");
  layout.positions = numbered(header, field + "position");
  layout.velocities = numbered(header, field + "velocity");
  for (const std::string& time : {field + "header.stamp", std::string("time")}) {
    const auto found = std::find(header.begin(), header.end(), time);
    if (found == header.end()) continue;
    layout.stamp = static_cast<std::size_t>(found - header.begin());
    break;
  }
  if (!layout.stamp || layout.names.empty()) return std::nullopt;
  if (layout.positions.size() != layout.names.size()) return std::nullopt;
  if (!layout.velocities.empty() && layout.velocities.size() != layout.names.size()) {
    layout.unread_rates = field + "velocity";
    layout.velocities.clear();
  }
  return layout;
}

bool is_whole(std::string_view item) {
  return !item.empty() && item.find_first_not_of("0123456789") == std::string_view::npos;
}

std::optional<double> number_in(const std::string& item) {
  double value = 0;
  const char* const last = item.data() + item.size();
  const auto [end, fault] = parse_double(item.data(), last, value);
  if (item.empty() || fault != std::errc() || end != last) return std::nullopt;
  return value;
}

/// Whether a row begins as `ros2 topic echo --csv` prints a message with a header and a name.
bool begins_with_stamp(const Items& row) {
  return row.size() > 3 && is_whole(row[0]) && is_whole(row[1]) && !number_in(row[2]) &&
         !row[3].empty() && !number_in(row[3]);
}

/// The layout of rows of `ros2 topic echo --csv`: sec, nanosec, frame_id, then the names, the
/// positions and, perhaps, as many velocities and efforts.
std::optional<MessageLayout> layout_of_row(const Items& row) {
  constexpr std::size_t front = 3;
  std::size_t end = front;
  while (end < row.size() && !row[end].empty() && !number_in(row[end])) ++end;
  const std::size_t joints = end - front, rest = row.size() - end;
  if (joints == 0 || rest == 0 || rest % joints != 0 || rest > 3 * joints) return std::nullopt;
  const auto all_numbers =
      std::all_of(row.begin() + static_cast<std::ptrdiff_t>(end), row.end(),
                  [](const auto& item) { return number_in(item).has_value(); });
  if (!all_numbers) return std::nullopt;
  MessageLayout layout{.count = row.size()};
  for (std::size_t i = 0; i < joints; ++i) {
    layout.names.push_back(front + i);
    layout.positions.push_back(end + i);
    if (rest == 3 * joints) layout.velocities.push_back(end + joints + i);
  }
  if (rest == 2 * joints) layout.unread_rates = "velocity or effort";
  return layout;
}

/// The first line, without the mark of a comment, and whether it is one.
struct FirstItems {
  Items items;
  bool comment = false;
};

FirstItems first_items(std::string_view text) {
  std::string_view line = trimmed(text.substr(0, text.find('\n')));
  if (line.starts_with("\xef\xbb\xbf")) line.remove_prefix(3);
  const bool comment = line.starts_with('%') || line.starts_with('#');
  if (comment) line.remove_prefix(1);
  try {
    return {csv_items(line, ','), comment};
  } catch (const Error&) {
    return {};
  }
}

bool is_header_with_names(const Items& items) {
  return std::any_of(items.begin(), items.end(), [](const std::string& item) {
    return item == "field.name0" || item == "field.joint_names0";
  });
}

/// Makes messages of rows.
class RowMessages {
 public:
  RowMessages(CsvLines& lines, const std::string& path)
      : lines_(lines), path_(path), reader_(path) {
    lines_.begin_rows();
  }

  Recording read() {
    std::string_view line;
    bool below_header = false;
    while (lines_.next(line)) {
      const Items row = csv_items(line, ',');
      if (layout_.count == 0) {
        const bool header = is_header_with_names(row);
        start(header ? row : header_in_comment(), row);
        if (header) {
          below_header = true;
          continue;
        }
      }
      take(row);
    }
    if (below_header && rows_ == 0) {
      throw FileError(path_, 0, "has a header but no rows below it");
    }
    Recording recording = reader_.finish();
    if (!layout_.unread_rates.empty()) {
      recording.notes.push_back({.kind = RecordingNoteKind::unread_rates,
                                 .path = path_,
                                 .columns = {layout_.unread_rates}});
    }
    return recording;
  }

 private:
  /// The header in the comment before the first row; empty if there is none.
  Items header_in_comment() {
    for (const Comment& comment : lines_.take_comments()) {
      Items items = csv_items(comment.text, ',');
      if (is_header_with_names(items)) return items;
    }
    return {};
  }

  void start(const Items& header, const Items& row) {
    const auto layout = header.empty() ? layout_of_row(row) : layout_below(header);
    if (!layout) {
      const std::string command = header.empty() ? "ros2 topic echo" : "rostopic echo";
      throw FileError(path_, line(),
                      "seems to be what `" + command + (header.empty() ? " --csv" : " -p") +
                          "` prints of another message than sensor_msgs/JointState; `" + command +
                          " /joint_states > FILE.yaml` writes a file that is read");
    }
    layout_ = *layout;
  }

  void take(const Items& row) {
    ++rows_;
    if (row.size() != layout_.count) {
      throw FileError(path_, line(),
                      "this row has " + std::to_string(row.size()) + " items; the first has " +
                          std::to_string(layout_.count));
    }
    Json names = Json::list();
    for (const std::size_t i : layout_.names) names.append(at_line(Json(row[i])));
    Json message{{"header", Json{{"stamp", stamp(row)}}},
                 {"name", at_line(std::move(names))},
                 {"position", numbers(row, layout_.positions)},
                 {"velocity", numbers(row, layout_.velocities)}};
    reader_.take(at_line(std::move(message)));
  }

  int line() const { return static_cast<int>(std::min<std::int64_t>(lines_.number(), 1 << 30)); }

  Json at_line(Json json) const {
    json.line = line();
    return json;
  }

  Json number_or_text(const std::string& item) const {
    const std::optional<double> value = number_in(item);
    if (value && std::isnan(*value)) return at_line(Json(".nan"));
    return at_line(value ? Json(*value) : Json(item));
  }

  Json numbers(const Items& row, const Indices& indices) const {
    Json list = Json::list();
    for (const std::size_t i : indices) list.append(number_or_text(row[i]));
    return at_line(std::move(list));
  }

  Json stamp(const Items& row) const {
    std::string sec = row[0], nanosec = row[1];
    if (layout_.stamp) {
      constexpr std::size_t digits = 9;
      const std::string& item = row[*layout_.stamp];
      if (!is_whole(item)) {
        throw FileError(path_, line(), "the stamp must be whole nanoseconds, not " + item);
      }
      const std::size_t split = item.size() > digits ? item.size() - digits : 0;
      sec = split > 0 ? item.substr(0, split) : "0";
      nanosec = item.substr(split);
    }
    return at_line(Json{{"sec", number_or_text(sec)}, {"nanosec", number_or_text(nanosec)}});
  }

  CsvLines& lines_;
  const std::string& path_;
  JointStateReader reader_;
  MessageLayout layout_;
  std::size_t rows_ = 0;
};

}  // namespace

bool begins_with_joint_state_rows(std::string_view text) {
  const FirstItems first = first_items(text);
  return is_header_with_names(first.items) || (!first.comment && begins_with_stamp(first.items));
}

Recording recording_from_joint_state_rows(std::string_view text, const std::string& path) {
  CsvLines lines(text, path);
  return RowMessages(lines, path).read();
}

Recording recording_from_joint_state_rows(InputFile& file) {
  constexpr std::size_t max_line = std::size_t{1} << 20;
  CsvLines lines(file, max_line);
  return RowMessages(lines, file.path()).read();
}

}  // namespace beeline::internal
