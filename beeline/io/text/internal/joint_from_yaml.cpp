#include <algorithm>
#include <cmath>
#include <optional>

#include <beeline/error.h>
#include <beeline/internal/letter_case.h>
#include <beeline/io/text/internal/joint_from_yaml.h>
#include <beeline/io/text/internal/limit_numbers.h>
#include <beeline/io/text/internal/name.h>
#include <beeline/io/text/pose_list.h>

namespace beeline::internal {
namespace {

/// The keys of a kind of limit in MoveIt's file: `has` states whether the joint has it, `max` is
/// its value, and `min` its value in the other direction, which is negative or has no sign.
struct RateKeys {
  const char* has;
  const char* max;
  const char* min;
};
constexpr RateKeys velocity_keys{"has_velocity_limits", "max_velocity", "min_velocity"};
constexpr RateKeys acceleration_keys{"has_acceleration_limits", "max_acceleration",
                                     "min_acceleration"};
constexpr RateKeys jerk_keys{"has_jerk_limits", "max_jerk", "min_jerk"};
constexpr const char* has_deceleration = "has_deceleration_limits";
constexpr const char* max_deceleration = "max_deceleration";

/// The keys of a joint: first the keys that are read, then keys of ros2_control that do not concern
/// the kinematics.
const std::vector<std::string> joint_keys{
    "has_position_limits", "min_position",     "max_position",        velocity_keys.has,
    velocity_keys.max,     velocity_keys.min,  acceleration_keys.has, acceleration_keys.max,
    acceleration_keys.min, has_deceleration,   max_deceleration,      jerk_keys.has,
    jerk_keys.max,         jerk_keys.min,      "has_effort_limits",   "max_effort",
    "has_soft_limits",     "soft_lower_limit", "soft_upper_limit",    "k_position",
    "k_velocity",          "angle_wraparound"};

/// The keys of a joint below `limit`, in the files of Franka's robots. URDF has the same
/// attributes.
const std::vector<std::string> urdf_limit_keys{"lower", "upper", "velocity", "effort"};

/// One joint of the file, with checked access. Messages name the file, the line and the key.
class YamlJoint {
 public:
  YamlJoint(const std::string& path, const YamlMember& member, const Joint& joint,
            std::vector<std::string>& notes)
      : path_(path), member_(member), joint_(joint), notes_(notes) {
    const auto* members = std::get_if<Yaml::Members>(&member.value.value);
    if (members == nullptr) {
      refuse(member.line, "", "must be a map such as {max_velocity: 2}");
    }
    members_ = members;
    if (const auto* limit = urdf_limits(member)) {
      members_ = limit;
      urdf_ = true;
    }
    for (const YamlMember& known : *members_) check_key(known);
  }

  LimitOverrides read() {
    LimitOverrides limits;
    if (urdf_) {
      return {
          .lower = lower_at("lower"), .upper = upper_at("upper"), .velocity = rate_at("velocity")};
    }
    const Limits& known = joint_.limits;
    set_position(limits);
    limits.velocity = rate(velocity_keys, known.velocity);
    limits.acceleration = rate(acceleration_keys, known.acceleration);
    limits.jerk = rate(jerk_keys, known.jerk);
    if (truth_at(has_deceleration).value_or(true)) {
      limits.acceleration =
          least(limits.acceleration, magnitude_at(max_deceleration), known.acceleration);
    }
    return limits;
  }

 private:
  void set_position(LimitOverrides& limits) {
    constexpr const char* has = "has_position_limits";
    const std::optional<double> lower = lower_at("min_position");
    const std::optional<double> upper = upper_at("max_position");
    if (lower && upper && *lower > *upper) {
      refuse(find("min_position")->line, "min_position",
             number(*lower) + " exceeds max_position " + number(*upper));
    }
    if (!truth_at(has).value_or(true)) {
      const Limits& known = joint_.limits;
      const bool bounded = std::isfinite(known.lower) || std::isfinite(known.upper);
      limits.lower = -Limits::none;
      limits.upper = Limits::none;
      if (bounded || lower || upper)
        notes_.push_back(std::string(has) + " is false, so there are none");
      return;
    }
    limits.lower = lower;
    limits.upper = upper;
    if (truth_at(has) && !lower && !upper) missing(has, "min_position and max_position");
  }

  std::optional<double> rate(const RateKeys& keys, double known) {
    const std::optional<bool> has = truth_at(keys.has);
    if (has.value_or(true)) {
      const std::optional<double> value = rate_at(keys.max);
      if (has && !value) missing(keys.has, keys.max);
      return least(value, magnitude_at(keys.min), known);
    }
    const std::optional<double> ignored = number_at(keys.max);
    if (ignored || known < Limits::none) {
      notes_.push_back(std::string(keys.has) + " is false, so no limit is known" +
                       (ignored ? std::string(" and ") + keys.max + " is ignored" : ""));
    }
    return Limits::none;
  }

  /// Returns a limit that bounds both directions. If only the other direction is given, `known`
  /// bounds this one.
  static std::optional<double> least(std::optional<double> limit, std::optional<double> other,
                                     double known) {
    return other ? std::min(limit.value_or(known), *other) : limit;
  }

  void missing(const char* has, const char* key) {
    notes_.push_back(std::string(has) + " is true without " + key +
                     ", so the arm's own limit stays");
  }

  /// The number of a key; none where the key is missing.
  std::optional<double> number_at(const char* key) const {
    const YamlMember* member = find(key);
    if (member == nullptr) return std::nullopt;
    const auto* text = std::get_if<std::string>(&member->value.value);
    if (text == nullptr) refuse(member->line, key, "must be a number, not a list or a map");
    const std::string& tag = member->value.tag;
    if (tag == "!") refuse(member->line, key, "must be a number, not text in quotes");
    double value = 0;
    try {
      value = parse_limit(*text, described(key));
    } catch (const Error& error) {
      throw FileError(path_, member->line, error.what());
    }
    return in_si_units(value, *member);
  }

  std::optional<double> lower_at(const char* key) const {
    const std::optional<double> value = number_at(key);
    return value && no_lower_limit(*value) ? -Limits::none : value;
  }

  std::optional<double> upper_at(const char* key) const {
    const std::optional<double> value = number_at(key);
    return value && no_upper_limit(*value) ? Limits::none : value;
  }

  /// A limit of at least Limits::min_rate.
  std::optional<double> rate_at(const char* key) const {
    const std::optional<double> value = number_at(key);
    if (value && *value > Limits::max_rate) return Limits::none;
    if (!value || *value >= Limits::min_rate) return value;
    refuse(find(key)->line, key,
           "must be at least " + number(Limits::min_rate) + ", not " + number(*value));
  }

  /// |number_at(key)|, at least Limits::min_rate.
  std::optional<double> magnitude_at(const char* key) const {
    const std::optional<double> value = number_at(key);
    if (!value) return std::nullopt;
    if (no_rate_limit(*value)) return Limits::none;
    if (std::abs(*value) >= Limits::min_rate) return std::abs(*value);
    refuse(find(key)->line, key, "must not be " + number(*value));
  }

  /// Whether the key is true; std::nullopt if the key is missing. Takes the truth values of YAML
  /// 1.1.
  std::optional<bool> truth_at(const char* key) const {
    const YamlMember* member = find(key);
    if (member == nullptr) return std::nullopt;
    const auto* text = std::get_if<std::string>(&member->value.value);
    const std::string lower = text == nullptr || member->value.tag == "!" ? "" : lower_case(*text);
    if (lower == "true" || lower == "yes" || lower == "on") return true;
    if (lower == "false" || lower == "no" || lower == "off") return false;
    refuse(member->line, key, "must be true or false");
  }

  [[noreturn]] void refuse(int line, const char* key, const std::string& why) const {
    throw FileError(path_, line, described(key) + " " + why);
  }

  std::string described(const std::string& key) const {
    return (urdf_ ? "" : std::string(joint_limits_key) + ".") + printable(member_.key) +
           (urdf_ ? ".limit" : "") + (key.empty() ? "" : "." + key);
  }

  const YamlMember* find(std::string_view key) const {
    const auto found = std::find_if(members_->begin(), members_->end(),
                                    [&](const YamlMember& known) { return known.key == key; });
    return found == members_->end() ? nullptr : &*found;
  }

  void check_key(const YamlMember& member) const {
    const std::vector<std::string>& known = urdf_ ? urdf_limit_keys : joint_keys;
    if (std::find(known.begin(), known.end(), member.key) != known.end()) return;
    throw FileError(
        path_, member.line,
        described("") + ": " + unknown_name("key", printable(member.key), known).what());
  }

  double in_si_units(double value, const YamlMember& member) const {
    const std::string& tag = member.value.tag;
    const bool plain = tag.empty() || tag == "?" || tag.starts_with("tag:yaml.org,2002:");
    if (plain || tag == "!radians") return value;
    if (tag != "!degrees") {
      refuse(member.line, member.key.c_str(),
             "has the unknown tag " + in_quotes(tag) + "; known are !degrees, !radians");
    }
    if (kind(joint_) == JointKind::prismatic) {
      refuse(member.line, member.key.c_str(), "is in degrees, but the joint is prismatic");
    }
    return to_radians(value, AngleUnit::degrees);
  }

  const std::string& path_;
  const YamlMember& member_;
  const Joint& joint_;
  std::vector<std::string>& notes_;
  const Yaml::Members* members_ = nullptr;
  bool urdf_ = false;  // the keys are urdf_limit_keys
};

}  // namespace

const Yaml::Members* urdf_limits(const YamlMember& joint) {
  const auto* members = std::get_if<Yaml::Members>(&joint.value.value);
  if (members == nullptr || members->size() != 1 || members->front().key != "limit") return nullptr;
  return std::get_if<Yaml::Members>(&members->front().value.value);
}

LimitOverrides limit_overrides_from_yaml(const std::string& path, const YamlMember& member,
                                         const Joint& joint, std::vector<std::string>& notes) {
  return YamlJoint(path, member, joint, notes).read();
}

}  // namespace beeline::internal
