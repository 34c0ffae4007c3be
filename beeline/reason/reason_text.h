#pragma once

#include <beeline/reason.h>

namespace beeline::internal {

/// The values of a reason as they stand in its sentence.
class ReasonText {
 public:
  explicit ReasonText(const Reason& reason) : reason_(reason) {}

  ReasonCode code() const { return reason_.code; }
  const std::vector<Reason>& details() const { return reason_.details; }
  // The details of a reason that must have one. Throws Error without.
  const std::vector<Reason>& required_details() const;
  const Reason& required_detail() const { return required_details().front(); }
  bool has(ReasonField field) const { return reason_.has(field); }
  bool is(ReasonField field) const;  ///< whether the field is true
  double value(ReasonField field) const;
  std::size_t count(ReasonField field) const;
  const std::string& text(ReasonField field) const;
  const Eigen::Vector3d& point(ReasonField field) const;

  std::string number(ReasonField field) const;  ///< "0.3", "12"
  std::string number(ReasonField field, const std::string& unit) const {
    return number(field) + unit;
  }
  std::string angle(ReasonField field) const;  ///< "1.5708 rad (90 deg)"
  /// "joint elbow".
  std::string joint() const;
  /// A value of the joint: "1.5708 rad (90 deg)", "0.2 m".
  std::string joint_value(ReasonField field) const;
  /// A value of the joint in one unit: "1.5708 rad", "0.2 m".
  std::string in_unit(ReasonField field) const;
  /// The fields `distance` and `angle`: "0.1 m and 0.2 rad (11.5 deg)".
  std::string deviation() const;
  /// The same, rounded up: a bound that is proved.
  std::string deviation_bound() const;
  /// "the time limit ended the search", from the field `ending`.
  std::string ended(ReasonField field = ReasonField::ending) const;
  /// "; allow more time"; empty for a search that was cancelled.
  std::string how_to_continue() const;

 private:
  const Reason& reason_;
};

/// " by 1e-08 rad": the excess of the joint's value over its limit, if the digits of both are
/// alike; otherwise empty.
std::string excess_if_alike(const ReasonText& reason);

/// "joint elbow at 3 rad (172 deg) is outside its limits -2 rad (-115 deg) to 2 rad (115 deg)".
std::string outside_text(const ReasonText& reason);

/// The advice of a reason: "; allow a larger tolerance" and the like, or, near a singularity, what
/// helps there.
std::string advice(const ReasonText& reason, const std::string& elsewhere);

/// "(0.1, 0.2, 0.3)". Coordinates that are rounding errors relative to the others are 0.
std::string point_text(const Eigen::Vector3d& p);

// The sentence for a code of each group, without its prefix and suffix; empty for codes of other
// groups.
std::string inverse_sentence(const ReasonText& reason);
std::string path_sentence(const ReasonText& reason);
std::string time_sentence(const ReasonText& reason);
std::string trajectory_sentence(const ReasonText& reason);
std::string clearance_sentence(const ReasonText& reason);
std::string control_sentence(const ReasonText& reason);
std::string reach_sentence(const ReasonText& reason);

/// The speed, rate or ramp with which a replay keeps the limits: "; a speed of 0.8 keeps the
/// limits".
std::string replay_advice(const ReasonText& reason);

}  // namespace beeline::internal
