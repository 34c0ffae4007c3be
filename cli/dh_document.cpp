#include "dh_document.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <vector>

#include <beeline/io/text/numbers.h>

#include "format.h"

namespace beeline::command {
namespace {

/// Exact numbers, for tables that are copied.
std::string table_of(const Arm& arm, const DhTable& table, const UnitArgument& unit) {
  const bool standard = table.convention == DhConvention::standard;
  std::vector<std::array<std::string, 5>> lines{
      standard ? std::array<std::string, 5>{"", "theta", "d", "a", "alpha"}
               : std::array<std::string, 5>{"", "a", "alpha", "theta", "d"}};
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const DhRow& row = table.rows[i];
    const bool slides = row.kind == JointKind::prismatic;
    const std::string theta = exact(unit.shown(row.theta)) + (slides ? "" : " + q");
    const std::string d = exact(row.d) + (slides ? " + q" : "");
    const std::string a = exact(row.a), alpha = exact(unit.shown(row.alpha));
    const std::string& name = arm.joints()[i].name;
    lines.push_back(standard ? std::array{name, theta, d, a, alpha}
                             : std::array{name, a, alpha, theta, d});
  }
  std::array<std::size_t, 5> widths{};
  for (const auto& line : lines) {
    for (std::size_t k = 0; k < 5; ++k) widths[k] = std::max(widths[k], line[k].size());
  }
  std::string text;
  for (const auto& line : lines) {
    text += fmt::format("  {:<{}}", line[0], widths[0]);
    for (std::size_t k = 1; k < 5; ++k) text += fmt::format("  {:>{}}", line[k], widths[k]);
    text += "\n";
  }
  return text;
}

/// The rows of a pose, as exact.
std::string pose_text(const Pose& pose) {
  std::array<std::size_t, 4> widths{};
  for (int row = 0; row < 4; ++row) {
    for (int k = 0; k < 4; ++k) {
      widths[k] = std::max(widths[k], exact(pose.matrix()(row, k)).size());
    }
  }
  std::string text;
  for (int row = 0; row < 4; ++row) {
    for (int k = 0; k < 4; ++k) {
      text += fmt::format("  {:>{}}", exact(pose.matrix()(row, k)), widths[k]);
    }
    text += "\n";
  }
  return text;
}

/// What the axes leave open of a frame.
std::string open_text(DhFreedom freedom, std::size_t frame, std::size_t n) {
  switch (freedom) {
    case DhFreedom::none:
      return "";
    case DhFreedom::along_axis:
      return "its origin along the axis, as the two axes are parallel";
    case DhFreedom::on_axis:
      return "its origin along the axis and its angle, as the two axes coincide";
    case DhFreedom::line:
      return "the place of a prismatic joint's axis";
    case DhFreedom::end:
      return frame == 0 ? "all but the axis of the first joint"
                        : fmt::format("all but the axis of joint {}", n);
  }
  return "";
}

std::string choices_text(const DhTable& table) {
  std::string text;
  for (std::size_t i = 0; i < table.freedom.size(); ++i) {
    const std::string open = open_text(table.freedom[i], i, table.rows.size());
    if (!open.empty()) text += fmt::format("  frame {}: {}\n", i, open);
  }
  return text;
}

std::string couplings_text(const Arm& arm) {
  std::string text;
  for (const Joint& joint : arm.joints()) {
    if (!joint.mimic) continue;
    text +=
        fmt::format("  q of {} = {} * q of {} + {}\n", joint.name, exact(joint.mimic->multiplier),
                    joint.mimic->leader, exact(joint.mimic->offset));
  }
  return text;
}

Json row_document(const Joint& joint, const DhRow& row, const UnitArgument& unit) {
  return {{"name", joint.name}, {"type", name(row.kind)},
          {"a", row.a},         {"alpha", unit.shown(row.alpha)},
          {"d", row.d},         {"theta", unit.shown(row.theta)}};
}

std::string convention_name(DhConvention convention) {
  return convention == DhConvention::standard ? "standard" : "modified";
}

}  // namespace

std::string dh_text(const Arm& arm, const DhTable& table, const UnitArgument& unit) {
  const std::string convention = convention_name(table.convention);
  if (!table) {
    std::string text = fmt::format("\nno table of {} DH parameters\n", convention);
    for (const DhMisfit& misfit : table.misfits) text += "  " + sentence(misfit) + "\n";
    return text;
  }
  std::string text = fmt::format("\n{} DH parameters ({}, m): {}\n", convention, unit.name(),
                                 table.convention == DhConvention::standard
                                     ? "A = Rz(theta) Tz(d) Tx(a) Rx(alpha)"
                                     : "A = Tx(a) Rx(alpha) Rz(theta) Tz(d)");
  text += table_of(arm, table, unit) + couplings_text(arm);
  text += "\nbase: frame 0 in the world\n" + pose_text(table.base);
  text += "\ntool: the tool in frame " + std::to_string(table.rows.size()) + "\n" +
          pose_text(table.tool);
  return text +
         "\nleft open by the axes, and chosen nearest to the frames of the arm's own links\n" +
         choices_text(table);
}

Json dh_document(const Arm& arm, const DhTable& table, const UnitArgument& unit) {
  Json document{{"convention", convention_name(table.convention)}};
  if (!table) {
    Json misfits = Json::list();
    for (const DhMisfit& misfit : table.misfits) {
      misfits.append(Json{
          {"joint", misfit.joint}, {"helical", misfit.helical}, {"distance", misfit.distance}});
    }
    document.add("misfits", misfits);
    return document;
  }
  Json rows = Json::list(), freedom = Json::list();
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    rows.append(row_document(arm.joints()[i], table.rows[i], unit));
  }
  for (const DhFreedom of_frame : table.freedom) freedom.append(name(of_frame));
  document.add("rows", rows);
  document.add("base", json_matrix(table.base.matrix()));
  document.add("tool", json_matrix(table.tool.matrix()));
  document.add("freedom", freedom);
  return document;
}

}  // namespace beeline::command
