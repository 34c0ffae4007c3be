#include <algorithm>
#include <limits>
#include <optional>

#include <beeline/certificate/internal/clearance_recovery.h>
#include <beeline/collision/internal/pair_reason.h>
#include <beeline/internal/budget_meter.h>
#include <beeline/planning/internal/attachments.h>
#include <beeline/planning/internal/carried_parts.h>
#include <beeline/planning/program.h>
#include <beeline/trajectory/internal/append.h>

namespace beeline {

using namespace internal;

namespace {

/// The samples of a trajectory in which the arm carries the same parts.
struct SceneSection {
  std::size_t first = 0, last = 0;
  const CollisionModel& model;
  const std::vector<std::size_t>& changed;  ///< attachments that begin or end at its first sample
  std::size_t moves = 0;                    ///< number of moves before it
};

/// A trajectory of a program, with the arrivals at its waypoints.
class ProgramScenes {
 public:
  ProgramScenes(const CollisionModel& model, const Trajectory& trajectory, const Program& program,
                std::span<const std::size_t> arrivals)
      : model_(model),
        trajectory_(matched_to(model.arm(), trajectory)),
        program_(program),
        arrivals_(arrivals) {
    if (trajectory_.size() == 0) throw Error("the trajectory has no samples");
    check_attachments(program, model);
    const bool in_order = std::is_sorted(arrivals.begin(), arrivals.end());
    const bool within = arrivals.empty() || arrivals.back() < trajectory_.size();
    if (arrivals.size() == program.moves.size() && in_order && within) return;
    throw Error("", "arrivals",
                " must be a sample for each of the " + std::to_string(program.moves.size()) +
                    " moves, in order");
  }

  const Trajectory& trajectory() const { return trajectory_; }
  const Program& program() const { return program_; }

  /// Calls `visit` with each section in the order of time until it returns false.
  template <class Visit>
  void for_each_section(const Visit& visit) const {
    CarriedParts parts(model_, program_);
    std::optional<CollisionModel> changed;
    std::size_t first = 0, since = 0;
    const auto section_to = [&](std::size_t last) {
      return SceneSection{first, last, changed ? *changed : model_, parts.changed(), since};
    };
    for (std::size_t moves = 0; moves <= program_.moves.size(); ++moves) {
      if (!has_change(program_, moves)) continue;
      const std::size_t at = sample_after(moves);
      if (moves > 0 && !visit(section_to(at))) return;
      parts.change(moves, trajectory_.positions[at]);
      changed.emplace(parts.model());
      first = at;
      since = moves;
    }
    visit(section_to(trajectory_.size() - 1));
  }

  /// Returns the attachments with their times and poses.
  std::vector<AttachedPart> attached() const {
    std::vector<AttachedPart> attached;
    for (const Attachment& attachment : program_.attachments) {
      attached.push_back({.part = attachment.part, .touch = attachment.touch});
    }
    for_each_change([&](std::size_t moves, std::size_t at, const CarriedParts& parts) {
      for (const std::size_t i : parts.changed()) {
        if (program_.attachments[i].after != moves) {
          attached[i].detached = trajectory_.times[at];
          continue;
        }
        attached[i].attached = trajectory_.times[at];
        attached[i].tool_T_part = parts.pose_in_tool(i);
      }
    });
    return attached;
  }

  std::vector<ProgramScene> scenes() const {
    std::vector<ProgramScene> scenes;
    const auto add = [&](std::size_t at, const CarriedParts& parts) {
      scenes.push_back({trajectory_.times[at], parts.model()});
    };
    if (!has_change(program_, 0)) add(0, CarriedParts(model_, program_));
    for_each_change(
        [&](std::size_t, std::size_t at, const CarriedParts& parts) { add(at, parts); });
    return scenes;
  }

  /// Adds the move at a time to the reason of a pair.
  void add_place(Reason& reason, double time) const {
    std::size_t move = 0;
    while (move + 1 < arrivals_.size() && trajectory_.times[arrivals_[move]] < time) ++move;
    reason.set(ReasonField::move, move + 1);
    reason.set(ReasonField::move_name, move_name(program_, move));
  }

 private:
  std::size_t sample_after(std::size_t moves) const {
    return moves == 0 ? 0 : arrivals_[moves - 1];
  }

  /// Calls `visit` with the number of moves before each change, its sample and the parts after it.
  template <class Visit>
  void for_each_change(const Visit& visit) const {
    CarriedParts parts(model_, program_);
    for (std::size_t moves = 0; moves <= program_.moves.size(); ++moves) {
      if (!has_change(program_, moves)) continue;
      const std::size_t at = sample_after(moves);
      parts.change(moves, trajectory_.positions[at]);
      visit(moves, at, parts);
    }
  }

  const CollisionModel& model_;
  Trajectory trajectory_;
  const Program& program_;
  std::span<const std::size_t> arrivals_;
};

/// "attach box (pick.csv:5)" or "detach box (pick.csv:9)".
std::string change_name(const Program& program, const SceneSection& section, std::size_t i) {
  const Attachment& attachment = program.attachments[i];
  if (attachment.after == section.moves) return attachment_name(program, i);
  const std::string& place = attachment.detach_place;
  return "detach " + attachment.part + (place.empty() ? "" : " (" + place + ")");
}

/// The refusal of a part that is too close to a body where it is attached or detached.
std::optional<ClearanceProof> refused_change(const ProgramScenes& scenes,
                                             const SceneSection& section) {
  if (section.changed.empty()) return std::nullopt;
  const Trajectory& trajectory = scenes.trajectory();
  for (const BodyDistance& pair :
       pairs_too_close(section.model, trajectory.positions[section.first])) {
    if (pair.upper >= pair.clearance) continue;
    for (const std::size_t i : section.changed) {
      const std::string& part = scenes.program().attachments[i].part;
      if (pair.names[0] != part && pair.names[1] != part) continue;
      const double time = trajectory.times[section.first];
      ClearanceProof proof{.status = ClearanceStatus::collides,
                           .reason = too_close_reason(pair, section.model.links()),
                           .pair = pair,
                           .time = time,
                           .begin = time,
                           .pairs = section.model.pair_count()};
      proof.reason.set(ReasonField::time, time)
          .set(ReasonField::move, std::max<std::size_t>(section.moves, 1))
          .set(ReasonField::move_name, change_name(scenes.program(), section, i));
      return proof;
    }
  }
  return std::nullopt;
}

ClearanceProof proof_of(const ProgramScenes& scenes, const SceneSection& section,
                        const ClearanceOptions& options) {
  if (std::optional<ClearanceProof> refused = refused_change(scenes, section)) return *refused;
  const Trajectory motion = samples_between(scenes.trajectory(), section.first, section.last);
  ClearanceProof proof = prove_clearance(section.model, motion, options);
  // One sample is proved as a rest of a second.
  for (double* const time : {&proof.time, &proof.begin, &proof.end}) {
    *time = std::min(*time, motion.times.back());
  }
  if (proof.reason.has(ReasonField::body)) {
    proof.reason.set(ReasonField::time, proof.time);
    scenes.add_place(proof.reason, proof.time);
  }
  return proof;
}

/// Adds the proof of the next section. The first place that is not decided counts, unless a
/// collision follows.
void add(ClearanceProof next, ClearanceProof& whole) {
  const std::size_t parts = whole.parts + next.parts, pairs = std::max(whole.pairs, next.pairs);
  std::optional<ClearanceRecovery> recovery =
      whole.recovery ? std::move(whole.recovery) : std::move(next.recovery);
  const auto excess = [](const ClearanceProof& proof) {
    const bool has_pair = !proof.pair.names[0].empty();
    return has_pair ? proof.pair.upper - proof.pair.clearance
                    : std::numeric_limits<double>::infinity();
  };
  if (whole && next) {
    const double least = std::min(whole.least_distance, next.least_distance);
    if (excess(next) < excess(whole)) whole = std::move(next);
    whole.least_distance = least;
  } else if (!next && (whole || next.status != ClearanceStatus::not_decided)) {
    if (!whole) next.begin = whole.begin;
    whole = std::move(next);
  }
  whole.recovery = std::move(recovery);
  whole.parts = parts;
  whole.pairs = pairs;
}

/// Adds what was found of the next section. Returns whether it has parts.
bool add(const ClearanceOverTime& next, ClearanceOverTime& whole) {
  whole.ending = next.ending;
  if (next.proved.empty()) return false;
  if (whole.times.empty()) {
    whole.clearance = next.clearance;
    whole.times.push_back(next.times.front());
  }
  if (whole.clearance != next.clearance) whole.clearance.reset();
  const auto append = [](const auto& from, std::size_t first, auto& to) {
    to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(first), from.end());
  };
  append(next.times, 1, whole.times);
  append(next.proved, 0, whole.proved);
  append(next.sample_times, 0, whole.sample_times);
  append(next.sampled, 0, whole.sampled);
  return true;
}

}  // namespace

std::vector<AttachedPart> attached_parts(const CollisionModel& model, const Trajectory& trajectory,
                                         const Program& program,
                                         std::span<const std::size_t> arrivals) {
  return ProgramScenes(model, trajectory, program, arrivals).attached();
}

std::vector<ProgramScene> program_scenes(const CollisionModel& model, const Trajectory& trajectory,
                                         const Program& program,
                                         std::span<const std::size_t> arrivals) {
  return ProgramScenes(model, trajectory, program, arrivals).scenes();
}

ClearanceProof prove_clearance(const CollisionModel& model, const Trajectory& trajectory,
                               const Program& program, std::span<const std::size_t> arrivals,
                               const ClearanceOptions& options) {
  check_recover_clearance(options.recover_clearance);
  const ProgramScenes scenes(model, trajectory, program, arrivals);
  BudgetMeter budget(options.budget);
  ClearanceProof whole{.status = ClearanceStatus::clear,
                       .least_distance = std::numeric_limits<double>::infinity()};
  scenes.for_each_section([&](const SceneSection& section) {
    ClearanceOptions of_section = options;
    of_section.budget = budget.part();
    if (section.first > 0) of_section.recover_clearance = 0;
    add(proof_of(scenes, section, of_section), whole);
    return whole.status == ClearanceStatus::clear || whole.status == ClearanceStatus::not_decided;
  });
  return whole;
}

ClearanceOverTime clearance_over_time(const CollisionModel& model, const Trajectory& trajectory,
                                      const Program& program, std::span<const std::size_t> arrivals,
                                      const Budget& budget) {
  const ProgramScenes scenes(model, trajectory, program, arrivals);
  BudgetMeter meter(budget);
  ClearanceOverTime whole;
  scenes.for_each_section([&](const SceneSection& section) {
    if (section.first == section.last) return true;  // no time
    const Trajectory motion = samples_between(scenes.trajectory(), section.first, section.last);
    const bool has_parts = add(clearance_over_time(section.model, motion, meter.part()), whole);
    if (!has_parts && whole.ending == Ending::complete) whole = {};
    return has_parts && whole.ending == Ending::complete;
  });
  return whole;
}

}  // namespace beeline
