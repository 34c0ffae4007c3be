#include "gain_comparison.h"

#include <fmt/format.h>

#include <beeline/draw/figure.h>
#include <beeline/draw/timing_figure.h>
#include <beeline/error.h>
#include <beeline/io/text/file.h>

#include "format.h"
#include "json_reason.h"

namespace beeline::command {
namespace {

Json document_of(const GainMotion& run) {
  const ControlledMotion& motion = run.motion;
  Json document{{"gain", run.gain},
                {"status", name(motion.status)},
                {"samples", motion.trajectory.size()},
                {"steps", motion.steps},
                {"duration", motion.trajectory.times.back()},
                {"overshoot", motion.overshoot},
                {"error", motion.error},
                {"slowed", motion.slowed}};
  document.add(json_reason(motion.reason));
  return document;
}

std::string row(const std::string& gain, const std::string& samples, const std::string& time,
                const std::string& overshoot, const std::string& error, const std::string& status) {
  return fmt::format("{:>8}  {:>8}  {:>9}  {:>11}  {:>12}  {}\n", gain, samples, time, overshoot,
                     error, status);
}

void draw(const std::vector<GainMotion>& runs, const Configuration& goal,
          const std::string& picture) {
  std::vector<NamedMotion> motions;
  for (const GainMotion& run : runs) {
    motions.push_back({"K_p = " + shown(run.gain), run.motion.trajectory});
  }
  const Picture drawn = step_response_figure(motions, goal, "Proportional gain K_p");
  write_file(picture, render(drawn, format_of(picture)));
}

}  // namespace

Answer compared_gains(const std::vector<GainMotion>& runs, const Configuration& goal,
                      const std::string& picture) {
  Answer answer;
  Json gains = Json::list();
  answer.text = row("gain", "samples", "time", "overshoot", "final error", "");
  std::string status = name(MotionStatus::reached);
  for (const GainMotion& run : runs) {
    const ControlledMotion& motion = run.motion;
    gains.append(document_of(run));
    answer.text += row(shown(run.gain), std::to_string(motion.trajectory.size()),
                       shown(motion.trajectory.times.back()) + " s",
                       fmt::format("{:.3g} %", 100 * motion.overshoot),
                       fmt::format("{:.3g}", motion.error), name(motion.status));
    if (motion || !answer.yes) continue;
    answer.yes = false;
    status = name(motion.status);
    answer.reason = "gain " + shown(run.gain) + ": " + sentence(motion.reason);
  }
  answer.text += "samples and time to reach the goal; final error: of the worst joint, rad or m\n";
  answer.document = {{"status", status}, {"method", "feedback"}, {"gains", gains}};
  answer.units = {{"error", "rad or m"}};
  if (picture.empty()) return answer;
  draw(runs, goal, picture);
  answer.text += fmt::format("picture       {}\n", picture);
  answer.document.add("draw", picture);
  return answer;
}

}  // namespace beeline::command
