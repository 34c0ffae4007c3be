#include <algorithm>
#include <utility>

#include <beeline/error.h>
#include <beeline/io/internal/trajectory_json.h>
#include <beeline/io/internal/trajectory_yaml.h>
#include <beeline/io/text/internal/json_parse.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/internal/yaml.h>

namespace beeline::internal {
namespace {

constexpr YamlBounds trajectory_bounds{.bytes = std::size_t{4} << 20, .values = 300'000};

/// The number that a plain scalar means, or its text; null is an empty text.
Json scalar(const std::string& text, const std::string& tag) {
  const bool plain = tag.empty() || tag == "?";
  const std::size_t sign = text.starts_with('+') ? 1 : 0;
  double value = 0;
  const char* const last = text.data() + text.size();
  const auto [end, fault] = parse_double(text.data() + sign, last, value);
  if (plain && !text.empty() && fault == std::errc() && end == last) return {value};
  return {text};
}

/// Returns the text without a line `---` at its end, which separates messages. Throws FileError if
/// another message follows one.
std::string_view without_separator(std::string_view text, const std::string& path) {
  const std::size_t end = text.find_last_not_of(" \t\r\n");
  text = text.substr(0, end == std::string_view::npos ? 0 : end + 1);
  if (text.ends_with("\n---")) text.remove_suffix(3);
  const std::size_t next = text.find("\n---\n", text.find_first_not_of("- \t\r\n"));
  if (next != std::string_view::npos && text.find("\npoints:") < next) {
    throw FileError(path,
                    static_cast<int>(std::count(
                        text.begin(), text.begin() + static_cast<std::ptrdiff_t>(next), '\n')) +
                        3,
                    "has a second message; a file has one JointTrajectory, or many JointState");
  }
  return text;
}

Trajectory trajectory_from_values(std::string_view text, const std::string& path) {
  Yaml root = parse_yaml(without_separator(text, path), path, trajectory_bounds);
  if (!std::holds_alternative<Yaml::Members>(root.value)) {
    throw FileError(path, root.line, "is no map with the keys joint_names and points");
  }
  return PointReader(path).finish(json_of(std::move(root)));
}

/// Whether the value behind comments is in braces.
bool is_in_braces(std::string_view text) {
  for (;;) {
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) return false;
    text.remove_prefix(begin);
    if (text.front() != '#' && !text.starts_with("---")) return text.front() == '{';
    text.remove_prefix(std::min(text.find('\n'), text.size()));
  }
}

}  // namespace

std::vector<Comment> yaml_comments(std::string_view text) {
  constexpr std::size_t front = std::size_t{1} << 16, most = 100;
  text = text.substr(0, front);
  std::vector<Comment> comments;
  for (int line = 1; !text.empty() && comments.size() < most; ++line) {
    const std::size_t end = text.find('\n');
    const std::string_view row = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const std::size_t mark = row.find('#');
    if (mark == std::string_view::npos) continue;
    const std::string_view before = row.substr(0, mark);
    const bool quoted = before.find_first_of("\"'") != std::string_view::npos;
    const bool apart = before.empty() || before.ends_with(' ') || before.ends_with('\t');
    const std::size_t begin = row.find_first_not_of("# \t", mark);
    if (!apart || quoted || begin == std::string_view::npos) continue;
    comments.push_back({std::string(trimmed(row.substr(begin))), line});
  }
  return comments;
}

bool begins_with_trajectory(std::string_view text) {
  bool names = false, points = false;
  while (!text.empty() && !(names && points)) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    names = names || line.starts_with("joint_names:");
    points = points || line.starts_with("points:");
  }
  return names && points;
}

Json json_of(Yaml&& yaml) {
  Json json;
  if (auto* text = std::get_if<std::string>(&yaml.value)) {
    json = scalar(*text, yaml.tag);
  } else if (auto* items = std::get_if<Yaml::Items>(&yaml.value)) {
    Json::Items list;
    for (Yaml& item : *items) list.push_back(json_of(std::move(item)));
    json.value = std::move(list);
  } else {
    Json::Members members;
    for (YamlMember& member : std::get<Yaml::Members>(yaml.value)) {
      members.push_back({std::move(member.key), json_of(std::move(member.value))});
    }
    json.value = std::move(members);
  }
  json.line = yaml.line;
  return json;
}

Trajectory trajectory_from_yaml(std::string_view text, const std::string& path) {
  if (!is_in_braces(text)) return trajectory_from_values(text, path);
  try {
    PointReader reader(path);
    Json root = parse_json(text, path, sink_of(reader), JsonFront::yaml_comments);
    return reader.finish(std::move(root));
  } catch (const FileError&) {
    constexpr std::size_t written_by_hand = std::size_t{1} << 20;
    if (text.size() > written_by_hand) throw;
    return trajectory_from_values(text, path);  // names without quotation marks, for example
  }
}

Trajectory trajectory_from_yaml(InputFile& file) {
  constexpr std::size_t front = std::size_t{1} << 16;  // comments
  const bool large = !file.size() || *file.size() > trajectory_bounds.bytes;
  if (large && is_in_braces(file.peek(front))) {
    PointReader reader(file.path());
    Json root = parse_json(file, sink_of(reader), JsonFront::yaml_comments);
    return reader.finish(std::move(root));
  }
  std::string text(trajectory_bounds.bytes + 1, '\0');
  text.resize(file.read(text.data(), text.size()));
  return trajectory_from_yaml(text, file.path());
}

}  // namespace beeline::internal
