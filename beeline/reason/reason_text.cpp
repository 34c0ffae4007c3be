#include <cmath>
#include <numbers>

#include <beeline/error.h>
#include <beeline/reason/reason_text.h>

namespace beeline::internal {
namespace {

/// The value of a field that the reason must have.
template <class Value>
const Value& required(const Reason& reason, ReasonField field) {
  const ReasonValue* found = reason.find(field);
  if (found != nullptr && std::holds_alternative<Value>(*found)) return std::get<Value>(*found);
  throw Error("a reason with code " + name(reason.code) + " needs the field " + name(field));
}

}  // namespace

const std::vector<Reason>& ReasonText::required_details() const {
  if (!details().empty()) return details();
  throw Error("a reason with code " + name(code()) + " needs details");
}

bool ReasonText::is(ReasonField field) const {
  return has(field) && required<bool>(reason_, field);
}

double ReasonText::value(ReasonField field) const { return required<double>(reason_, field); }

std::size_t ReasonText::count(ReasonField field) const {
  return required<std::size_t>(reason_, field);
}

const std::string& ReasonText::text(ReasonField field) const {
  return required<std::string>(reason_, field);
}

const Eigen::Vector3d& ReasonText::point(ReasonField field) const {
  return required<Eigen::Vector3d>(reason_, field);
}

std::string ReasonText::number(ReasonField field) const {
  const ReasonValue* found = reason_.find(field);
  if (found != nullptr && std::holds_alternative<std::size_t>(*found)) {
    return std::to_string(std::get<std::size_t>(*found));
  }
  return beeline::number(value(field));
}

std::string ReasonText::angle(ReasonField field) const { return beeline::angle(value(field)); }

std::string ReasonText::joint() const { return "joint " + text(ReasonField::joint); }

std::string ReasonText::joint_value(ReasonField field) const {
  return text(ReasonField::unit) == "rad" ? angle(field) : in_unit(field);
}

std::string ReasonText::in_unit(ReasonField field) const {
  return number(field) + " " + text(ReasonField::unit);
}

std::string ReasonText::deviation() const {
  return number(ReasonField::distance) + " m and " + angle(ReasonField::angle);
}

std::string ReasonText::deviation_bound() const {
  const double radians = value(ReasonField::angle);
  return number_at_least(value(ReasonField::distance)) + " m and " + number_at_least(radians) +
         " rad (" + number_at_least(radians * 180 / std::numbers::pi) + " deg)";
}

std::string ReasonText::ended(ReasonField field) const {
  switch (required<Ending>(reason_, field)) {
    case Ending::time_limit:
      return "the time limit ended the search";
    case Ending::work_limit:
      return "the limit of work ended the search";
    default:
      return "the search was cancelled";
  }
}

std::string ReasonText::how_to_continue() const {
  switch (required<Ending>(reason_, ReasonField::ending)) {
    case Ending::time_limit:
      return "; allow more time";
    case Ending::work_limit:
      return "; allow more work";
    default:
      return "";
  }
}

std::string excess_if_alike(const ReasonText& reason) {
  using enum ReasonField;
  const double q = reason.value(value);
  const double passed = q > reason.value(upper) ? reason.value(upper) : reason.value(lower);
  if (number(q) != number(passed)) return "";
  return " by " + number(std::abs(q - passed)) + " " + reason.text(unit);
}

std::string outside_text(const ReasonText& reason) {
  using enum ReasonField;
  return reason.joint() + " at " + reason.joint_value(value) + " is outside its limits " +
         reason.joint_value(lower) + " to " + reason.joint_value(upper) + excess_if_alike(reason);
}

std::string advice(const ReasonText& reason, const std::string& elsewhere) {
  return reason.is(ReasonField::near_singular)
             ? "; the arm passes near a singularity, where another tolerance rarely helps: begin "
               "in another configuration, move the path away from it, or use a task that leaves "
               "rotations free"
             : "; " + elsewhere;
}

std::string point_text(const Eigen::Vector3d& exact) {
  const double noise = 1e-9 * exact.cwiseAbs().maxCoeff();
  const Eigen::Vector3d p = (exact.array().abs() < noise).select(0, exact);
  return "(" + beeline::number(p.x()) + ", " + beeline::number(p.y()) + ", " +
         beeline::number(p.z()) + ")";
}

}  // namespace beeline::internal
