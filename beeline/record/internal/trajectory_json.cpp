#include <cmath>
#include <cstdint>
#include <limits>

#include <beeline/error.h>
#include <beeline/read/internal/json.h>
#include <beeline/read/internal/json_write.h>
#include <beeline/read/internal/numbers.h>
#include <beeline/record/internal/recordable.h>
#include <beeline/record/internal/trajectory_json.h>

namespace beeline::internal {
namespace {

constexpr double nano = 1e-9;

/// Reads a duration of ROS: whole seconds, rounded down, and nanoseconds.
double duration_from_json(const JsonDocument& document, const Json& json) {
  document.check_keys(json, {"sec", "nanosec"});
  const Json& nanosec = document.need(json, "nanosec");
  const double nanoseconds = document.number(nanosec);
  if (!(nanoseconds >= 0 && nanoseconds < 1e9))
    document.refuse(nanosec, "must be at least 0 and below 1e9");
  return document.number(document.need(json, "sec")) + nanoseconds * nano;
}

std::string duration_to_json(double time) {
  double seconds = std::floor(time);
  double nanoseconds = std::round((time - seconds) / nano);
  if (nanoseconds >= 1e9) {
    seconds += 1;
    nanoseconds = 0;
  }
  if (!(std::abs(seconds) <= std::numeric_limits<std::int32_t>::max())) {
    throw Error("time " + number(time) + " s exceeds the 32 bits of ROS's seconds");
  }
  return "{\"sec\": " + std::to_string(static_cast<std::int64_t>(seconds)) +
         ", \"nanosec\": " + std::to_string(static_cast<std::int64_t>(nanoseconds)) + "}";
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

std::string values_to_json(const char* key, const Configuration& values) {
  return '"' + std::string(key) +
         "\": " + json_numbers(values.data(), static_cast<std::size_t>(values.size())) + ", ";
}

}  // namespace

Trajectory trajectory_from_json(std::string_view text, const std::string& path) {
  const JsonDocument document(text, path);
  const Json& root = document.root();
  document.check_keys(root, {"header", "joint_names", "points"});
  Trajectory trajectory;
  for (const Json& name : document.items(document.need(root, "joint_names"))) {
    trajectory.joint_names.push_back(document.text(name));
  }
  const std::size_t joints = trajectory.joint_names.size();
  for (const Json& point : document.items(document.need(root, "points"))) {
    document.check_keys(
        point, {"positions", "velocities", "accelerations", "effort", "time_from_start", "time"});
    const double time = time_from_json(document, point);
    if (!trajectory.times.empty() && !(time > trajectory.times.back())) {
      document.refuse(point, "is at time " + exact(time) + ", not after " +
                                 exact(trajectory.times.back()) + "; times must increase");
    }
    const std::size_t before = trajectory.times.size();
    trajectory.times.push_back(time);
    trajectory.positions.push_back(
        values_from_json(document, document.need(point, "positions"), joints));
    add_rates(document, point, "velocities", before, joints, trajectory.velocities);
    add_rates(document, point, "accelerations", before, joints, trajectory.accelerations);
  }
  try {
    check_recordable(trajectory);
  } catch (const Error& error) {
    throw FileError(path, 0, error.what());
  }
  return trajectory;
}

std::string trajectory_to_json(const Trajectory& trajectory) {
  check_recordable(trajectory);
  std::string text = "{\"joint_names\": [";
  for (std::size_t i = 0; i < trajectory.joint_names.size(); ++i) {
    text += (i == 0 ? "" : ", ") + json_string(trajectory.joint_names[i]);
  }
  text += "],\n \"points\": [";
  for (std::size_t k = 0; k < trajectory.size(); ++k) {
    text += (k == 0 ? "\n  {" : ",\n  {") + values_to_json("positions", trajectory.positions[k]);
    if (!trajectory.velocities.empty()) {
      text += values_to_json("velocities", trajectory.velocities[k]);
    }
    if (!trajectory.accelerations.empty()) {
      text += values_to_json("accelerations", trajectory.accelerations[k]);
    }
    text += "\"time_from_start\": " + duration_to_json(trajectory.times[k]) +
            ", \"time\": " + exact(trajectory.times[k]) + "}";
  }
  return text + "\n ]}\n";
}

}  // namespace beeline::internal
