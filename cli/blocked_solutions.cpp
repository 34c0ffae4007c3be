#include "blocked_solutions.h"

#include <algorithm>
#include <fmt/format.h>

#include "format.h"
#include "json_reason.h"

namespace beeline::command {
namespace {

template <class T>
const T& field(const Reason& reason, ReasonField field) {
  return std::get<T>(*reason.find(field));
}

/// "hand and table: 0.0004 m apart, 0.001 m are required"; for a reason that is not of two bodies,
/// its sentence.
std::string pair_text(const Reason& reason) {
  const bool collide = reason.code == ReasonCode::bodies_collide;
  const bool too_close = reason.code == ReasonCode::bodies_too_close;
  const bool not_decided = reason.code == ReasonCode::clearance_not_decided;
  if (!collide && !too_close && !not_decided) return sentence(reason);
  const auto metres = [&](ReasonField length) { return shown(field<double>(reason, length)); };
  BodyDistance bodies{.names = {field<std::string>(reason, ReasonField::body),
                                field<std::string>(reason, ReasonField::other_body)}};
  if (reason.has(ReasonField::point)) bodies.point = field<std::size_t>(reason, ReasonField::point);
  const std::string pair = names_text(bodies);
  if (collide) return fmt::format("{}: {} m deep", pair, metres(ReasonField::depth));
  return fmt::format("{}: {} m apart, {} m are required{}", pair, metres(ReasonField::distance),
                     metres(ReasonField::clearance), not_decided ? ": not decided" : "");
}

}  // namespace

std::function<Reason(const ConfigurationRef&)> blocked_in(const CheckedScene& scene) {
  return [&scene](const ConfigurationRef& q) { return blocked_by(scene.model, q); };
}

std::string blocked_text(const Arm& arm, const std::vector<BlockedSolution>& blocked,
                         const UnitArgument& unit) {
  constexpr std::size_t max_lines = 16;
  std::string text;
  for (std::size_t i = 0; i < std::min(max_lines, blocked.size()); ++i) {
    text += fmt::format("  blocked: {}; {}\n", shown(unit.shown(arm, blocked[i].q)),
                        pair_text(blocked[i].reason));
  }
  if (blocked.size() > max_lines) {
    text += fmt::format("  and {} more blocked ones, which --json prints\n",
                        blocked.size() - max_lines);
  }
  return text;
}

Json json_blocked(const Arm& arm, const std::vector<BlockedSolution>& blocked,
                  const UnitArgument& unit) {
  Json list = Json::list();
  for (const BlockedSolution& solution : blocked) {
    Json one{{"q", unit.shown(arm, solution.q)}};
    one.add(json_reason(solution.reason));
    list.append(one);
  }
  return list;
}

std::string scene_text(const CheckedScene& scene) {
  const char* own = scene.obstacles_have_clearances ? ", or an obstacle's own clearance" : "";
  return fmt::format("pairs         {} of {}, {} m are required{}\n", scene.model.pair_count(),
                     number_of_bodies(scene), shown(scene.clearance), own) +
         lines_text(conditions(scene));
}

Json scene_document(const CheckedScene& scene) {
  Json document{{"clearance", scene.clearance},
                {"pairs", scene.model.pair_count()},
                {"apart_pairs", scene.model.apart_count()},
                {"nothing_checked", scene.checks_nothing()}};
  document.add(conditions_document(scene));
  return document;
}

}  // namespace beeline::command
