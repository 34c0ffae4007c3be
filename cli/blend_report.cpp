#include "blend_report.h"

#include <fmt/format.h>

#include <beeline/error.h>

#include "json_reason.h"

namespace beeline::command {
namespace {

/// "samples 12 to 31 deviate from the line by at most 0.03 m and 1.2 deg, proved".
std::string deviation_text(std::size_t begin, std::size_t end, const Deviation& bound,
                           const UnitArgument& unit) {
  std::string text = fmt::format("samples {} to {}", begin + 1, end + 1);
  if (bound.position == 0) return text + ", between joint moves";
  return text + fmt::format(" deviate from the line by at most {:.2e} m   {:.2e} {}",
                            rounded_up(bound.position, 3),
                            rounded_up(unit.shown(bound.orientation), 3), unit.name());
}

}  // namespace

std::string blend_text(const PlannedBlend& blend, const UnitArgument& unit) {
  std::string text;
  if (blend.radius > 0) {
    text += fmt::format("        blend     {}\n",
                        deviation_text(blend.begin, blend.end, blend.bound, unit));
  }
  if (blend.reason) text += fmt::format("        blend     {}\n", sentence(blend.reason));
  return text;
}

Json blend_document(const PlannedBlend& blend, const UnitArgument& unit) {
  if (blend.radius == 0 && !blend.reason) return {};
  const bool passes = blend.radius > 0;
  Json document{{"radius", blend.radius},
                {"begin", passes ? Json(blend.begin + 1) : Json()},
                {"end", passes ? Json(blend.end + 1) : Json()},
                {"deviation_bound", passes ? Json(blend.bound.position) : Json()},
                {"orientation_bound", passes ? Json(unit.shown(blend.bound.orientation)) : Json()}};
  document.add(json_reason(blend.reason));
  return document;
}

std::string passed_text(const Verification& verification, const Program& program,
                        const UnitArgument& unit) {
  std::string text;
  for (const PassedWaypoint& passed : verification.passed) {
    if (passed.begin == passed.end) continue;
    text += fmt::format("blend         {}: {}\n", move_name(program, passed.move),
                        deviation_text(passed.begin, passed.end, passed.bound, unit));
  }
  return text;
}

Json arrival_members(const Verification& verification, const UnitArgument& unit) {
  Json members{};
  Json arrivals = Json::list(), blends = Json::list();
  for (const std::size_t arrival : verification.arrivals) arrivals.append(arrival + 1);
  for (const PassedWaypoint& passed : verification.passed) {
    blends.append({{"move", passed.move + 1},
                   {"begin", passed.begin + 1},
                   {"end", passed.end + 1},
                   {"deviation_bound", passed.bound.position},
                   {"orientation_bound", unit.shown(passed.bound.orientation)}});
  }
  if (!verification.arrivals.empty()) members.add("arrivals", arrivals);
  if (!verification.passed.empty()) members.add("blends", blends);
  return members;
}

}  // namespace beeline::command
