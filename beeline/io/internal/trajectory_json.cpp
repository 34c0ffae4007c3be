#include <cmath>
#include <cstdint>
#include <limits>

#include <beeline/error.h>
#include <beeline/io/internal/recordable.h>
#include <beeline/io/internal/trajectory_json.h>
#include <beeline/io/text/internal/json_parse.h>
#include <beeline/io/text/internal/json_write.h>
#include <beeline/io/text/internal/numbers.h>
#include <beeline/io/text/json.h>
#include <beeline/io/text/numbers.h>

namespace beeline::internal {
namespace {

constexpr std::int64_t nanoseconds_per_second = 1'000'000'000;

/// Reads a duration of ROS: whole seconds, rounded down, and nanoseconds. The result is the double
/// nearest to it: a time of k / 1e9 s is read as it was written.
double duration_from_json(const JsonDocument& document, const Json& json) {
  const auto [seconds, nanoseconds] = seconds_and_nanoseconds(document, json);
  return (seconds * 1e9 + nanoseconds) / 1e9;
}

std::int64_t in_nanoseconds(double time) {
  constexpr double limit = std::numeric_limits<std::int32_t>::max();
  if (!(std::abs(time) <= limit)) {
    throw Error("time " + number(time) + " s exceeds the 32 bits of ROS's seconds");
  }
  return std::llround(time * 1e9);
}

std::string duration_to_json(std::int64_t nanoseconds) {
  std::int64_t seconds = nanoseconds / nanoseconds_per_second;
  if (nanoseconds < seconds * nanoseconds_per_second) --seconds;  // rounds down below 0
  nanoseconds -= seconds * nanoseconds_per_second;
  return "{\"sec\": " + std::to_string(seconds) + ", \"nanosec\": " + std::to_string(nanoseconds) +
         "}";
}

double time_from_json(const JsonDocument& document, const Json& point) {
  if (const Json* exact_time = document.find(point, "time")) return document.number(*exact_time);
  return duration_from_json(document, document.need(point, "time_from_start"));
}

Configuration values_from_json(const JsonDocument& document, const Json& json, std::size_t count) {
  const std::vector<double> values = document.numbers(json, count);
  return Eigen::Map<const Configuration>(values.data(), static_cast<Eigen::Index>(count));
}

/// Appends the point's values of `key`, which all points must have or none.
void add_rates(const JsonDocument& document, const Json& point, const char* key, std::size_t before,
               std::size_t count, std::vector<Configuration>& rates) {
  const Json* json = document.find(point, key);
  const bool known = json != nullptr && !document.items(*json).empty();
  if (rates.size() != (known ? before : 0)) {
    document.refuse(point, std::string(known ? "has " : "has no ") + key +
                               ", unlike the points before it; all points have them, or none has");
  }
  if (known) rates.push_back(values_from_json(document, *json, count));
}

/// The number of joint names, or `otherwise` when they come after the points.
std::size_t count_of_names(const Json& root, std::size_t otherwise) {
  for (const auto& [key, value] : std::get<Json::Members>(root.value)) {
    const auto* names = std::get_if<Json::Items>(&value.value);
    if (key == "joint_names" && names != nullptr) return names->size();
  }
  return otherwise;
}

/// Appends a member with a list of numbers, which is empty when the column is.
void append_member(std::string& text, const char* key, const std::vector<Configuration>& column,
                   std::size_t k) {
  text += std::string("\"") + key + "\": [";
  if (!column.empty()) {
    for (Eigen::Index i = 0; i < column[k].size(); ++i) {
      text += (i == 0 ? "" : ", ") + with_point(column[k][i]);
    }
  }
  text += "], ";
}

/// The member with this key; null if there is none.
Json* member_of(Json& json, std::string_view key) {
  auto* members = std::get_if<Json::Members>(&json.value);
  if (members == nullptr) return nullptr;
  for (auto& [name, member] : *members) {
    if (name == key) return &member;
  }
  return nullptr;
}

/// The part of a goal or a plan of MoveIt that is a message, also where a list has it alone; null
/// if there is none.
Json* message_in(Json& root, const std::string& path) {
  Json* part = member_of(root, "trajectory");
  Json* const of_joints = member_of(root, "joint_trajectory");
  // With both, or with points, the keys are refused.
  if ((part == nullptr) == (of_joints == nullptr) || member_of(root, "points") != nullptr) {
    return nullptr;
  }
  if (part == nullptr) part = of_joints;
  if (auto* items = std::get_if<Json::Items>(&part->value)) {
    if (items->size() != 1) {
      throw FileError(path, part->line,
                      "has " + std::to_string(items->size()) + " trajectories; a file has one");
    }
    part = &items->front();
  }
  Json* const inner = message_in(*part, path);
  return inner == nullptr ? part : inner;
}

}  // namespace

std::pair<double, double> seconds_and_nanoseconds(const JsonDocument& document, const Json& json) {
  const bool ros_1 = document.find(json, "secs") != nullptr;
  const char* const keys[] = {ros_1 ? "secs" : "sec", ros_1 ? "nsecs" : "nanosec"};
  document.check_keys(json, {keys[0], keys[1]});
  const Json& nanosec = document.need(json, keys[1]);
  const double nanoseconds = document.number(nanosec);
  if (!(nanoseconds >= 0 && nanoseconds < 1e9))
    document.refuse(nanosec, "must be at least 0 and below 1e9");
  return {document.number(document.need(json, keys[0])), nanoseconds};
}

Trajectory PointReader::finish(Json root) {
  if (Json* const found = message_in(root, path_)) {
    Json message = std::move(*found);
    root = std::move(message);
  }
  Json::Items points;  // what was not taken while the text was read
  if (Json* const list = member_of(root, "points")) {
    if (auto* items = std::get_if<Json::Items>(&list->value)) points.swap(*items);
  }
  for (Json& point : points) take(root, std::move(point));
  const JsonDocument document(std::move(root), path_);
  document.check_keys(document.root(), {"header", "joint_names", "points"});
  const Json& names = document.need(document.root(), "joint_names");
  for (const Json& name : document.items(names)) {
    trajectory_.joint_names.push_back(document.text(name));
  }
  document.items(document.need(document.root(), "points"));
  if (trajectory_.size() > 0 && trajectory_.joint_names.size() != joints_) {
    document.refuse(names, "has " + std::to_string(trajectory_.joint_names.size()) +
                               " names; the points have " + std::to_string(joints_) + " positions");
  }
  try {
    check_recordable(trajectory_);
  } catch (const Error& error) {
    throw FileError(path_, 0, error.what());
  }
  return std::move(trajectory_);
}

void PointReader::take(const Json& root, Json item) {
  const std::size_t before = trajectory_.size();
  const JsonDocument document(std::move(item), path_, "points[" + std::to_string(before) + "]");
  const Json& point = document.root();
  document.check_keys(
      point, {"positions", "velocities", "accelerations", "effort", "time_from_start", "time"});
  const double time = time_from_json(document, point);
  if (before > 0 && !(time > trajectory_.times.back())) {
    document.refuse(point, "is at time " + exact(time) + ", not after " +
                               exact(trajectory_.times.back()) + "; times must increase");
  }
  const Json& positions = document.need(point, "positions");
  if (before == 0) joints_ = count_of_names(root, document.items(positions).size());
  trajectory_.times.push_back(time);
  trajectory_.positions.push_back(values_from_json(document, positions, joints_));
  add_rates(document, point, "velocities", before, joints_, trajectory_.velocities);
  add_rates(document, point, "accelerations", before, joints_, trajectory_.accelerations);
}

JsonItemSink sink_of(PointReader& reader) {
  return {"points",
          [&reader](const Json& root, Json point) { reader.take(root, std::move(point)); }};
}

Trajectory trajectory_from_json(std::string_view text, const std::string& path) {
  PointReader reader(path);
  Json root = parse_json(text, path, sink_of(reader));
  return reader.finish(std::move(root));
}

Trajectory trajectory_from_json(InputFile& file) {
  PointReader reader(file.path());
  Json root = parse_json(file, sink_of(reader));
  return reader.finish(std::move(root));
}

std::string trajectory_to_json(const Trajectory& trajectory) {
  check_recordable(trajectory);
  std::string text = R"({"header": {"stamp": {"sec": 0, "nanosec": 0}, "frame_id": ""},)"
                     "\n \"joint_names\": [";
  for (std::size_t i = 0; i < trajectory.joint_names.size(); ++i) {
    text += (i == 0 ? "" : ", ") + json_string(trajectory.joint_names[i]);
  }
  text += "],\n \"points\": [";
  std::int64_t last = std::numeric_limits<std::int64_t>::min();
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    const std::int64_t time = in_nanoseconds(trajectory.times[k]);
    if (time <= last) {
      throw Error("samples " + std::to_string(k) + " and " + std::to_string(k + 1) +
                  " are at the same nanosecond, " + number(trajectory.times[k]) +
                  " s; ROS's times are whole nanoseconds");
    }
    last = time;
    text += k == 0 ? "\n  {" : ",\n  {";
    append_member(text, "positions", trajectory.positions, k);
    append_member(text, "velocities", trajectory.velocities, k);
    append_member(text, "accelerations", trajectory.accelerations, k);
    text += "\"effort\": [], \"time_from_start\": " + duration_to_json(time) + "}";
  }
  text += "\n ]}\n";
  return text;
}

}  // namespace beeline::internal
