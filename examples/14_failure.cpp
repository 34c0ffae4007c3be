// From failure to cure: plans lines that fail, prints each reason as data, and plans again.
#include <iostream>
#include <variant>

#include <beeline/kinematics/forward.h>
#include <beeline/model/catalog.h>
#include <beeline/planning/move_along.h>

namespace {

using beeline::PathMotion;
using beeline::ReasonCode;
using beeline::ReasonField;

/// Prints a reason with all its fields, and its details: reasons at poses, further joints.
void print(const beeline::Reason& reason, const std::string& indent) {
  std::cout << indent << "code " << name(reason.code) << '\n';
  for (const auto& [field, value] : reason.fields) {
    std::cout << indent << "  " << name(field) << ' ';
    if (const auto* const point = std::get_if<Eigen::Vector3d>(&value)) {
      std::cout << point->transpose() << '\n';
    } else {
      std::visit(
          [](const auto& plain) {
            if constexpr (requires { std::cout << plain; }) std::cout << plain << '\n';
          },
          value);
    }
  }
  for (const beeline::Reason& detail : reason.details) print(detail, indent + "    ");
}

void report(const std::string& title, const PathMotion& motion) {
  std::cout << title << ": ";
  if (motion) {
    std::cout << motion << '\n';
    return;
  }
  std::cout << name(motion.status) << '\n';
  print(motion.reason, "  ");
  for (const beeline::NearbyPath& near : motion.nearby) {
    std::cout << "  would work: " << near.description << '\n';
  }
}

/// Returns the number in a field of a reason, or another one if the reason does not have it.
double value_of(const beeline::Reason& reason, ReasonField field, double otherwise) {
  const beeline::ReasonValue* const value = reason.find(field);
  return value != nullptr ? std::get<double>(*value) : otherwise;
}

}  // namespace

int main() {
  std::cout << std::boolalpha;
  const beeline::Arm rrr = beeline::built_in("rrr");
  const beeline::Configuration start{{0.0, 1.57, 0.0}};
  const beeline::Pose begin = forward_kinematics(rrr, start);
  const auto moved = [&](double x) { return Eigen::Translation3d(x, 0, 0) * begin; };

  // Out of reach: with `suggest`, `nearby` has paths that work.
  report("far", move_in_lines(rrr, start, {moved(2.7)}, {.suggest = true}));

  // A joint limit: the reason names the joint and its limit. Without a start the arm may begin in
  // another configuration, here with its elbow on the other side.
  const beeline::Arm limited = with_limits(rrr, {{"joint2", {.lower = -2.5, .upper = 1.7}}});
  const PathMotion stopped = move_in_lines(limited, start, {moved(-1)});
  report("limited", stopped);
  if (stopped.reason.code == ReasonCode::would_pass_limits) {
    report("other elbow", move_in_lines(limited, {begin, moved(-1)}));
  }

  // Too short a duration: the reason has the shortest one.
  const PathMotion quick = move_in_lines(rrr, start, {moved(1)}, {.duration = 0.1});
  report("quick", quick);
  if (quick.reason.code == ReasonCode::duration_too_short) {
    const double shortest = value_of(quick.reason, ReasonField::shortest_duration, 1);
    report("slower", move_in_lines(rrr, start, {moved(1)}, {.duration = 1.001 * shortest}));
  }
}
