#include "retimed_answer.h"

#include <algorithm>
#include <fmt/format.h>
#include <iterator>

#include "format.h"
#include "json_reason.h"
#include "motion_report.h"
#include "recording_argument.h"
#include "recover_argument.h"

namespace beeline::command {
namespace {

/// The number of the positions that are passed in blends, and the sizes of these.
std::string blends_text(const std::vector<double>& blends) {
  std::vector<double> radii;
  std::copy_if(blends.begin(), blends.end(), std::back_inserter(radii),
               [](double radius) { return radius > 0; });
  std::string text = "blends        " + counted(static_cast<std::int64_t>(radii.size()), "blend");
  if (!radii.empty()) {
    const auto [least, largest] = std::minmax_element(radii.begin(), radii.end());
    text += " of radius " + shown(*least);
    if (*least != *largest) text += " to " + shown(*largest);
  }
  return text + "\n";
}

std::string retimed_text(const Arm& arm, const Retimed& retimed,
                         const std::optional<double>& duration_before) {
  if (!retimed) return "";
  const std::string before =
      duration_before ? fmt::format(", before {} s", shown(*duration_before)) : "";
  const std::string stops =
      retimed.sections > 1 ? fmt::format(", with {} between", counted(retimed.sections - 1, "stop"))
                           : "";
  return fmt::format("retimed       {} samples of {}, profile {}\n", retimed.trajectory.size(),
                     arm.name(), name(retimed.profile)) +
         fmt::format("duration      {} s{}{}\n", shown(retimed.trajectory.times.back()), before,
                     stops) +
         (retimed.blends.empty() ? "" : blends_text(retimed.blends)) + limits_text(retimed.limits) +
         fmt::format("tool speed    at most {} m/s\n", shown(retimed.tool_speed));
}

std::string retimed_status(const Retimed& retimed) {
  if (retimed.ending != Ending::complete) return name(retimed.ending);
  return retimed ? "reached" : "outside_limits";
}

}  // namespace

Answer RetimedResult::answer(const Arm& arm, const Retimed& retimed,
                             const std::optional<double>& duration_before) const {
  std::optional<ClearanceReport> clearance;
  if (scene && retimed) {
    clearance = scene_argument.prove(*scene, retimed.trajectory, budget.next());
    files.draw_refusal(*clearance);
  }
  const bool refused = clearance && !clearance->proof;
  const bool found = retimed && !refused;
  if (found) {
    files.write(arm, retimed.trajectory, waypoints, {}, std::nullopt,
                scene ? &scene->model : nullptr);
  }
  Answer answer{
      .text =
          retimed_text(arm, retimed, duration_before) + recovery_text(arm, retimed.recovery, unit),
      .document = {{"status", refused ? name(clearance->refusal()) : retimed_status(retimed)},
                   {"profile", name(retimed.profile)},
                   {"samples", retimed.trajectory.size()},
                   {"duration", found ? Json(retimed.trajectory.times.back()) : Json()},
                   {"duration_before", duration_before},
                   {"sections", retimed.sections},
                   {"unwrapped", json_unwrapped(retimed.unwrapped)},
                   {"limits", json_limits(retimed.limits)},
                   {"recovery", json_recovery(arm, retimed.recovery, unit)},
                   {"tool_speed", retimed.tool_speed}},
      .yes = found,
      .reason = refused ? clearance->reason_text() : sentence(retimed.reason)};
  answer.document.add(json_reason(refused ? clearance->proof.reason : retimed.reason));
  if (!retimed.blends.empty()) answer.document.add("blends", json_blends(retimed.blends));
  if (clearance) {
    answer.text += clearance->text();
    answer.document.add("clearance", clearance->document());
  }
  if (!found) return answer;
  answer.text += files.text();
  files.add_to(answer.document);
  return answer;
}

}  // namespace beeline::command
