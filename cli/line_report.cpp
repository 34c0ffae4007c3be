#include "line_report.h"

#include <fmt/core.h>

#include "format.h"

using namespace beeline;

namespace {

std::string motion_text(const LineReport& report, const UnitArgument& unit) {
  std::string text = fmt::format("samples       {} in {} s\n", report.trajectory.size(),
                                 shown(report.trajectory.times.back()));
  if (report.method == "exact") {
    return text + deviation_text(report.deviation, report.trajectory.interpolation(), unit) +
           limits_text(report.limits) +
           fmt::format(
               "margins       {} % of a joint's half range to its limits, inverse "
               "condition number {}\n",
               shown(100 * report.limit_margin), shown(report.inverse_condition));
  }
  return text +
         fmt::format("control       {}, overshoot {} % of a line\n", counted(report.steps, "step"),
                     shown(100 * report.overshoot)) +
         deviation_text(report.deviation, report.trajectory.interpolation(), unit);
}

}  // namespace

std::string report_text(const Arm& arm, const LineReport& report, const UnitArgument& unit,
                        const ResultFiles& files) {
  std::string text =
      fmt::format("{}: {}, method {}\n", name(report.status),
                  counted(static_cast<std::int64_t>(report.waypoints), "waypoint"), report.method);
  for (const NearbyPath& nearby : report.nearby) {
    text += fmt::format("would work    {}\n", nearby.description);
  }
  if (report.status == MotionStatus::reached) text += motion_text(report, unit) + files.text();
  if (report.branches) text += branches_text(arm, *report.branches, unit);
  return text;
}

Json report_document(const Arm& arm, const LineReport& report, const UnitArgument& unit,
                     const ResultFiles& files) {
  const bool reached = report.status == MotionStatus::reached;
  Json document{
      {"status", name(report.status)}, {"method", report.method}, {"waypoints", report.waypoints}};
  document.add(deviation_members(reached ? std::optional(report.deviation) : std::nullopt, unit));
  document.add("samples", report.trajectory.size());
  document.add("duration", reached ? Json(report.trajectory.times.back()) : nullptr);
  document.add("reason", report.reason);
  if (!reached && report.method == "exact") document.add("path_parameter", report.path_parameter);
  if (reached && report.method == "exact") {
    document.add("limits", json_limits(report.limits));
    document.add("limit_margin", report.limit_margin);
    document.add("inverse_condition", report.inverse_condition);
  }
  if (report.method != "exact") {
    document.add("steps", report.steps);
    document.add("overshoot", report.overshoot);
  }
  Json nearby = Json::list();
  for (const NearbyPath& path : report.nearby) {
    nearby.append({{"description", path.description},
                   {"translation", Eigen::VectorXd(path.moved)},
                   {"rotation", Eigen::VectorXd(path.turned * unit.shown(1.0))}});
  }
  if (!report.nearby.empty()) document.add("nearby", nearby);
  if (report.branches) document.add("branches", json_branches(arm, *report.branches, unit));
  if (reached) files.add_to(document);
  return document;
}
