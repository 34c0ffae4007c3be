#include <algorithm>

#include "program_argument.h"
#include "scene_argument.h"

namespace beeline::command {
namespace {

/// Sets the pairs that are too close at the time of a collision.
void set_too_close(const CheckedScene& scene, const Trajectory& motion, ClearanceReport& report) {
  if (report.proof.status != ClearanceStatus::collides) return;
  constexpr std::size_t most_listed = 100;
  report.too_close.push_back(report.proof.pair.names);
  for (const BodyDistance& pair :
       pairs_too_close(scene.model, sample(motion, report.proof.time).position)) {
    const auto& names = pair.names;
    const bool known = std::find(report.too_close.begin(), report.too_close.end(), names) !=
                       report.too_close.end();
    if (!known) report.too_close.push_back(names);
    if (report.too_close.size() == most_listed) break;
  }
}

}  // namespace

ClearanceOptions SceneArgument::proof_options(const Budget& budget) const {
  ClearanceOptions options{.closest = true, .budget = budget};
  if (resolution) options.resolution = *resolution;
  return options;
}

ClearanceReport SceneArgument::prove(const CheckedScene& scene, const Trajectory& motion,
                                     const Budget& budget) const {
  ClearanceReport report{.scene = &scene,
                         .clearance = scene.clearance,
                         .proof = prove_clearance(scene.model, motion, proof_options(budget))};
  warn_if_unchecked(scene);
  set_too_close(scene, motion, report);
  return report;
}

ClearanceReport SceneArgument::prove(const CheckedScene& scene, const Trajectory& motion,
                                     const FollowedProgram& followed, const Budget& budget) const {
  const Program& program = followed.program;
  return at_rows(program, followed.file, [&] {
    ClearanceReport report{
        .scene = &scene,
        .clearance = scene.clearance,
        .proof =
            prove_clearance(scene.model, motion, program, followed.arrivals, proof_options(budget)),
        .attachments = program.attachments,
        .attached = attached_parts(scene.model, motion, program, followed.arrivals)};
    if (report.attached.empty()) {
      warn_if_unchecked(scene);
      set_too_close(scene, motion, report);
    } else if (report.proof.status == ClearanceStatus::collides) {
      report.too_close.push_back(report.proof.pair.names);
    }
    return report;
  });
}

}  // namespace beeline::command
