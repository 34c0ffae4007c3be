#include "line_report.h"

#include <fmt/core.h>

#include "branch_table.h"

using namespace beeline;

void print_report(const Arm& arm, const LineReport& report, const UnitArgument& unit,
                  const ResultFiles& files) {
  const std::size_t waypoints = report.waypoints;
  const bool reached = report.status == MotionStatus::reached;
  fmt::print("{}: {} waypoint{}, method {}\n", name(report.status), waypoints,
             waypoints == 1 ? "" : "s", report.method);
  for (const NearbyPath& nearby : report.nearby) {
    fmt::print("would work    {}\n", nearby.description);
  }
  if (!reached) {
    if (report.branches) print_branches(arm, *report.branches, unit);
    return;
  }
  fmt::print("samples       {} in {} s\n", report.trajectory.size(),
             shown(report.trajectory.times.back()));
  if (report.method != "exact") {
    fmt::print("control       {} steps, overshoot {} % of a line\n", report.steps,
               shown(100 * report.overshoot));
  }
  print_deviation(report.deviation, unit);
  if (report.method == "exact") {
    print_limits(report.limits);
    fmt::print("margins       {} % of a joint's range to its limits, inverse condition {}\n",
               shown(100 * report.limit_margin), shown(report.dexterity));
  }
  files.print();
  if (report.branches) print_branches(arm, *report.branches, unit);
}

OrderedJson json_report(const Arm& arm, const LineReport& report, const UnitArgument& unit,
                        const ResultFiles& files) {
  const bool reached = report.status == MotionStatus::reached;
  OrderedJson document{
      {"status", name(report.status)}, {"method", report.method}, {"waypoints", report.waypoints}};
  add_deviation(document, reached ? std::optional(report.deviation) : std::nullopt, unit);
  document["samples"] = report.trajectory.size();
  document["duration"] = reached ? json_number(report.trajectory.times.back()) : nullptr;
  document["reason"] = report.reason;
  if (reached && report.method == "exact") {
    document["limits"] = json_limits(report.limits);
    document["limit_margin"] = json_number(report.limit_margin);
    document["dexterity"] = json_number(report.dexterity);
  }
  if (report.method != "exact") {
    document["steps"] = report.steps;
    document["overshoot"] = json_number(report.overshoot);
  }
  for (const NearbyPath& nearby : report.nearby) {
    document["nearby"].push_back({{"description", nearby.description},
                                  {"moved", json_vector(nearby.moved)},
                                  {"turned", json_vector(nearby.turned)}});
  }
  if (report.branches) document["branches"] = json_branches(arm, *report.branches, unit);
  if (reached) files.add_to(document);
  return document;
}
