#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <beeline/io/text/json.h>
#include <beeline/io/trajectory_file.h>

namespace beeline::internal {

/// Collects the samples of messages sensor_msgs/JointState. Errors are FileErrors that name the
/// line and the value.
class JointStateReader {
 public:
  /// `path` is for messages and must outlive this object.
  explicit JointStateReader(const std::string& path) : path_(path) {}

  /// Takes the next message, with the keys header, name, position and, perhaps, velocity and
  /// effort. The joints may be in another order in each message.
  void take(Json message);

  /// Returns the recording of at least one message. Velocities are read if all messages have them
  /// as numbers for all joints; a note says if only some have.
  Recording finish();

 private:
  void start(double seconds, double nanoseconds);
  std::vector<std::size_t> order_of(const JsonDocument& document, const Json& json);
  void take_velocities(const JsonDocument& document, const std::vector<std::size_t>& order);

  const std::string& path_;
  Recording recording_;
  Trajectory trajectory_;
  double first_seconds_ = 0, first_nanoseconds_ = 0;  ///< from which times count
  bool any_velocity_ = false;
};

}  // namespace beeline::internal
