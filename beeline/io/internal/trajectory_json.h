#pragma once

#include <string>
#include <string_view>
#include <utility>

#include <beeline/io/text/file.h>
#include <beeline/io/text/internal/json_parse.h>
#include <beeline/io/text/json.h>
#include <beeline/trajectory/trajectory.h>

namespace beeline::internal {

/// Collects the points of a message while it is parsed. Errors are FileErrors that name the line
/// and the value.
class PointReader {
 public:
  /// `path` is for messages and must outlive this object.
  explicit PointReader(const std::string& path) : path_(path) {}

  /// Takes the next point. `root` is the message as far as it was read.
  void take(const Json& root, Json point);
  /// Returns the trajectory of the parsed message, without its points.
  Trajectory finish(Json root);

 private:
  const std::string& path_;
  std::size_t joints_ = 0;
  Trajectory trajectory_;
};

/// Returns the seconds and the nanoseconds of a time of ROS: sec and nanosec, or of ROS 1 secs and
/// nsecs.
std::pair<double, double> seconds_and_nanoseconds(const JsonDocument& document, const Json& json);

/// Returns a function that passes the points of a message to the reader, which must outlive it.
JsonItemSink sink_of(PointReader& reader);

/// Parses a trajectory in the form of ROS trajectory_msgs/JointTrajectory:
///     {"joint_names": [...],
///      "points": [{"positions": [...], "velocities": [...], "accelerations": [...],
///                  "time_from_start": {"sec": 1, "nanosec": 500000000}}, ...]}
/// ROS 1 has secs and nsecs. Files of version 0.1 have a member `time` of each point, in seconds,
/// which takes precedence. A message may be the part `joint_trajectory` or `trajectory` of another
/// one, as of MoveIt's RobotTrajectory; it is then held as a whole. Empty velocities and
/// accelerations mean none, as in ROS; `header` and `effort` are ignored. Of a message alone it
/// holds the numbers and one point in memory. Throws FileError that names the line and the value.
Trajectory trajectory_from_json(std::string_view text, const std::string& path);
Trajectory trajectory_from_json(InputFile& file);

/// Returns the message with all of its members and no other. Times are rounded to nanoseconds.
/// Throws Error for times that exceed the 32 bits of ROS's seconds, and for two samples within the
/// same nanosecond.
std::string trajectory_to_json(const Trajectory& trajectory);

}  // namespace beeline::internal
