#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <beeline/io/text/internal/yaml.h>
#include <beeline/pose/se3.h>

namespace beeline::internal {

/// A value of a ROS message that is written as YAML or JSON. Each function throws FileError with
/// the line and the name of the value, such as `world.collision_objects[2].id`, for a value that is
/// something else.
class RosMessage {
 public:
  /// The whole message. The arguments must outlive this object.
  RosMessage(const Yaml& yaml, const std::string& path) : yaml_(&yaml), path_(&path) {}

  [[noreturn]] void refuse(const std::string& why) const;

  bool is_map() const { return std::holds_alternative<Yaml::Members>(yaml_->value); }

  /// Refuses a map with another key: what it says would be lost.
  void check_keys(const std::vector<std::string>& known) const;
  /// Returns the member of a key; none without it, and where it is null.
  std::optional<RosMessage> find(std::string_view key) const;
  /// The same, refused where there is none.
  RosMessage need(std::string_view key) const;
  /// Returns the values of a list.
  std::vector<RosMessage> items() const;
  /// Returns the values of a member's list; none without the member.
  std::vector<RosMessage> items(std::string_view key) const;

  const std::string& text() const;
  double number() const;
  bool boolean() const;
  /// Returns the numbers of a list or, in the order of `keys`, of a map.
  std::vector<double> numbers(const std::vector<std::string>& keys) const;
  std::vector<double> numbers() const;
  Vector3 vector() const;  ///< [x, y, z] or {x, y, z}
  /// Returns the pose of a point and a quaternion, x, y, z, w, of these keys; a missing one is the
  /// identity. See ros_pose().
  Pose pose(std::string_view position, std::string_view orientation) const;

 private:
  RosMessage(const Yaml& yaml, const RosMessage& parent, std::string name)
      : yaml_(&yaml), path_(parent.path_), name_(std::move(name)) {}

  const Yaml* yaml_;
  const std::string* path_;
  std::string name_ = {};  ///< empty: the whole message
};

}  // namespace beeline::internal
