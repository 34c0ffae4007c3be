#include <algorithm>
#include <fmt/format.h>

#include "format.h"
#include "program_argument.h"
#include "scene_argument.h"

namespace beeline::command {
namespace {

/// Sets the configuration at which a motion is refused.
void set_configuration(const CheckedScene& scene, const Trajectory& motion,
                       ClearanceReport& report) {
  const ClearanceProof& proof = report.proof;
  if (proof || proof.pair.names[0].empty()) return;
  report.q = sample(matched_to(scene.model.arm(), motion), proof.time).position;
}

/// Sets the pairs that are too close at the time of a collision.
void set_too_close(const CheckedScene& scene, ClearanceReport& report) {
  if (report.proof.status != ClearanceStatus::collides) return;
  constexpr std::size_t most_listed = 100;
  report.too_close.push_back(report.proof.pair.names);
  for (const BodyDistance& pair : pairs_too_close(scene.model, report.q)) {
    const auto& names = pair.names;
    const bool known = std::find(report.too_close.begin(), report.too_close.end(), names) !=
                       report.too_close.end();
    if (!known) report.too_close.push_back(names);
    if (report.too_close.size() == most_listed) break;
  }
}

constexpr double rounding = 1e-9;  // m, see ClearanceOptions::recover_clearance

std::string accepting_clause(double depth) {
  return fmt::format("; --recover-clearance {} accepts a motion that leads out", shown(depth));
}

/// The clause for a motion that is not decided because a pair is at its clearance at the start.
std::string clause_at_clearance(const CheckedScene& scene, const Configuration& start) {
  const std::vector<BodyDistance> pairs = pairs_too_close(scene.model, start);
  if (pairs.empty()) return "";
  return fmt::format("; at the start, {} are at the clearance{}", names_text(pairs.front()),
                     accepting_clause(rounding));
}

/// Whether a motion may be refused because of its start: nothing is proved before, or the refusal
/// is in its recovery.
bool may_be_of_start(const ClearanceProof& proof, const Trajectory& motion) {
  if (proof.status != ClearanceStatus::collides && proof.status != ClearanceStatus::not_decided)
    return false;
  return proof.recovery ? proof.time <= proof.recovery->time : proof.begin <= motion.times.front();
}

}  // namespace

ClearanceOptions SceneArgument::proof_options(const Budget& budget) const {
  ClearanceOptions options{.closest = true, .budget = budget};
  if (resolution) options.resolution = *resolution;
  options.recover_clearance = recover_clearance.value_or(0);
  return options;
}

std::string SceneArgument::start_clause(const CheckedScene& scene, const Configuration& start,
                                        std::string_view accepted) const {
  const std::vector<BodyDistance> pairs = pairs_too_close(scene.model, start);
  if (pairs.empty()) return "";
  const BodyDistance& deepest = pairs.front();
  const double depth = deepest.clearance - deepest.lower;
  if (depth <= rounding) return "";
  std::string at_start = fmt::format("; at the start, {} are {} m closer than the clearance",
                                     names_text(deepest), shown(depth));
  if (depth > max_recover_clearance + rounding) {
    return at_start + fmt::format(", more than the {} m from which a motion may lead out",
                                  shown(max_recover_clearance));
  }
  if (recover_clearance.value_or(0) > 0 && depth <= *recover_clearance + rounding) {
    return at_start.append(accepted);
  }
  return at_start + accepting_clause(std::max(rounding, rounded_up(depth - rounding, 3)));
}

std::string SceneArgument::clause_of_refusal(const CheckedScene& scene, const Configuration& start,
                                             const ClearanceProof& proof) const {
  const std::string clause = start_clause(
      scene, start, "; the motion must lead out of it, and no pair may come closer before");
  const bool undecided = proof.status == ClearanceStatus::not_decided;
  return clause.empty() && undecided && recover_clearance.value_or(0) == 0
             ? clause_at_clearance(scene, start)
             : clause;
}

ClearanceReport SceneArgument::prove(const CheckedScene& scene, const Trajectory& motion,
                                     const Budget& budget) const {
  const Trajectory first{motion.joint_names, {0}, {motion.positions.front()}, {}, {}};
  return prove_from(matched_to(scene.model.arm(), first).positions.front(), scene, motion, budget);
}

ClearanceReport SceneArgument::prove_from(const std::optional<Configuration>& start,
                                          const CheckedScene& scene, const Trajectory& motion,
                                          const Budget& budget) const {
  ClearanceReport report{.scene = &scene,
                         .clearance = scene.clearance,
                         .proof = prove_clearance(scene.model, motion, proof_options(budget))};
  warn_if_unchecked(scene);
  set_configuration(scene, motion, report);
  set_too_close(scene, report);
  if (start && may_be_of_start(report.proof, motion)) {
    report.start_clause = clause_of_refusal(scene, *start, report.proof);
  }
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
    set_configuration(scene, motion, report);
    if (report.attached.empty()) {
      if (may_be_of_start(report.proof, motion)) {
        report.start_clause = clause_of_refusal(scene, motion.positions.front(), report.proof);
      }
      warn_if_unchecked(scene);
      set_too_close(scene, report);
    } else if (report.proof.status == ClearanceStatus::collides) {
      report.too_close.push_back(report.proof.pair.names);
    }
    return report;
  });
}

}  // namespace beeline::command
