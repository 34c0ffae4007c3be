#include <algorithm>
#include <cmath>
#include <utility>

#include <beeline/error.h>
#include <beeline/io/internal/joint_state_reader.h>
#include <beeline/io/internal/recordable.h>
#include <beeline/io/internal/time_column.h>
#include <beeline/io/internal/trajectory_json.h>
#include <beeline/io/text/numbers.h>

namespace beeline::internal {
namespace {

Configuration values_in_order(const JsonDocument& document, const Json& json,
                              const std::vector<std::size_t>& order) {
  const std::vector<double> numbers = document.numbers(json, order.size());
  Configuration q(static_cast<Eigen::Index>(order.size()));
  for (std::size_t i = 0; i < order.size(); ++i) {
    q[static_cast<Eigen::Index>(i)] = numbers[order[i]];
  }
  return q;
}

}  // namespace

void JointStateReader::take(Json message) {
  const JsonDocument document(std::move(message), path_);
  const Json& root = document.root();
  document.check_keys(root, {"header", "name", "position", "velocity", "effort"});
  const auto [seconds, nanoseconds] =
      seconds_and_nanoseconds(document, document.need(document.need(root, "header"), "stamp"));
  const std::vector<std::size_t> order = order_of(document, document.need(root, "name"));
  if (trajectory_.size() == 0) start(seconds, nanoseconds);
  const double time = ((seconds - first_seconds_) * 1e9 + (nanoseconds - first_nanoseconds_)) / 1e9;
  if (trajectory_.size() > 0 && !(time > trajectory_.times.back())) {
    document.refuse(root, "is at time " + exact(time) + ", not after " +
                              exact(trajectory_.times.back()) + "; times must increase");
  }
  trajectory_.times.push_back(time);
  trajectory_.positions.push_back(
      values_in_order(document, document.need(root, "position"), order));
  take_velocities(document, order);
}

Recording JointStateReader::finish() {
  if (trajectory_.size() == 0) throw FileError(path_, 0, "has no messages");
  try {
    check_recordable(trajectory_);
  } catch (const Error& error) {
    throw FileError(path_, 0, error.what());
  }
  if (any_velocity_ && trajectory_.velocities.empty()) {
    recording_.notes.push_back(
        {.kind = RecordingNoteKind::unread_rates, .path = path_, .columns = {"velocity"}});
  }
  recording_.trajectory = std::move(trajectory_);
  return std::move(recording_);
}

void JointStateReader::start(double seconds, double nanoseconds) {
  if (!is_since_1970(seconds)) return;
  first_seconds_ = seconds;
  first_nanoseconds_ = nanoseconds;
  recording_.notes.push_back({.kind = RecordingNoteKind::times_since_1970,
                              .path = path_,
                              .columns = {"stamp.sec", "stamp.nanosec"},
                              .time_unit = TimeUnit::seconds,
                              .finer_unit = TimeUnit::nanoseconds});
}

/// The position of each joint of the first message in this one.
std::vector<std::size_t> JointStateReader::order_of(const JsonDocument& document,
                                                    const Json& json) {
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
  document.refuse(json, "must have the joints of the first message, " + listed(joints) + ", not " +
                            listed(names) + "; keep the messages of one publisher alone");
}

/// Drivers without velocities write an empty list or .nan.
void JointStateReader::take_velocities(const JsonDocument& document,
                                       const std::vector<std::size_t>& order) {
  const Json* const json = document.find(document.root(), "velocity");
  const auto is_nan = [](const Json& item) {
    const auto* text = std::get_if<std::string>(&item.value);
    return text != nullptr && (*text == ".nan" || *text == ".NaN" || *text == ".NAN");
  };
  bool known = json != nullptr && !document.items(*json).empty();
  if (known) {
    const Json::Items& items = document.items(*json);
    any_velocity_ = any_velocity_ || !std::all_of(items.begin(), items.end(), is_nan);
    known = std::none_of(items.begin(), items.end(), is_nan);
  }
  std::vector<Configuration>& velocities = trajectory_.velocities;
  if (known && velocities.size() + 1 == trajectory_.size()) {
    velocities.push_back(values_in_order(document, *json, order));
  } else {
    velocities.clear();
  }
}

}  // namespace beeline::internal
