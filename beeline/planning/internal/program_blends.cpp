#include <algorithm>

#include <beeline/planning/internal/blend_chain.h>
#include <beeline/planning/internal/program_blends.h>
#include <beeline/planning/internal/program_trajectory.h>

namespace beeline::internal {
namespace {

/// Whether the tool stops where move i ends, between two lines: they reverse, or one has no length.
bool stops_between_lines(const PlannedProgram& planned, std::size_t i) {
  const auto part =
      std::lower_bound(planned.parts.begin(), planned.parts.end(), i,
                       [](const ProgramPart& one, std::size_t move) { return one.last < move; });
  return !part->joint && i < part->last && part->route.stops[part->last_segment(i)];
}

/// The joint paths of moves from one stop of the program to the next: one for each joint move, and
/// for the lines between two of them, or between stops. None where there is no joint path. No paths
/// if no joint move blends.
std::vector<std::optional<ChainPart>> parts_between_stops(const PlannedProgram& planned,
                                                          const MoveRange& moves,
                                                          BudgetMeter& budget) {
  std::vector<std::optional<ChainPart>> parts;
  MoveRange part{moves.first, moves.first};
  bool joint = false;
  for (; part.last < moves.last; ++part.last) {
    const bool blends = blends_with_joint_move(planned.program, part.last);
    if (!blends && !stops_between_lines(planned, part.last)) continue;
    joint = joint || blends;
    parts.push_back(chain_part(planned, part, budget));
    part.first = part.last + 1;
  }
  if (!joint) return {};
  parts.push_back(chain_part(planned, part, budget));
  return parts;
}

/// Appends the chains of some parts: those between parts without a joint path and waypoints at
/// which there is no blend.
void add_chains(const PlannedProgram& planned, std::vector<std::optional<ChainPart>> parts,
                const CollisionModel* model, BlendRefusals& refusals, BudgetMeter& budget,
                std::vector<BlendChain>& chains) {
  constexpr int work = 200;  // configurations of a largest radius, at most
  std::vector<ChainPart> chain;
  std::vector<double> largest;
  const auto end = [&] {
    if (!largest.empty()) {
      chains.emplace_back(planned, std::move(chain), std::move(largest), model, refusals, budget);
    }
    chain.clear();
    largest.clear();
  };
  for (std::optional<ChainPart>& part : parts) {
    if (budget.ended(work)) return;
    const double radius = part && !chain.empty() ? largest_radius(planned, chain.back(), *part) : 0;
    if (radius == 0) end();
    if (!part) continue;
    if (!chain.empty()) largest.push_back(radius);
    chain.push_back(std::move(*part));
  }
  end();
}

/// Appends the motions of the chains of some parts. If no blend helps a part, it keeps its stops.
void add_motions(const PlannedProgram& planned, std::vector<std::optional<ChainPart>> parts,
                 const CollisionModel* model, BlendRefusals& refusals, BudgetMeter& budget,
                 std::vector<BlendedMoves>& motions) {
  std::vector<BlendChain> chains;
  add_chains(planned, std::move(parts), model, refusals, budget, chains);
  for (BlendChain& chain : chains) {
    if (budget.ended()) return;
    std::optional<BlendedMotion> motion = chain.motion();
    if (motion) {
      std::vector<std::size_t> blends;
      for (const ChainPart& part : chain.parts()) blends.push_back(part.moves.last);
      blends.pop_back();
      motions.push_back({chain.moves(), std::move(*motion), std::move(blends), chain.largest()});
    } else if (const auto refused = chain.refused_part()) {
      std::vector<std::optional<ChainPart>> others(chain.parts().begin(), chain.parts().end());
      others[*refused].reset();
      add_motions(planned, std::move(others), model, refusals, budget, motions);
    }
  }
}

/// The planned motion with other motions of some moves.
class Replaced {
 public:
  Replaced(const PlannedProgram& planned, const std::vector<BlendedMoves>& motions)
      : planned_(planned), moves_(planned.moves), sample_(planned.trajectory.size()) {
    motion_.begin(planned.arm, planned.trajectory.positions.front(), planned.options.interpolation,
                  planned.options.rate);
    std::size_t k = 0;
    for (const BlendedMoves& blended : motions) {
      keep_until(planned.moves[blended.moves.first].begin, k);
      replace(blended);
      k = planned.moves[blended.moves.last].end;
      sample_[k] = motion_.last();
    }
    keep_until(planned.trajectory.size() - 1, k);
    set_moves(motions);
  }

  BlendedProgram result() const { return {motion_.finished(), moves_}; }

 private:
  /// Appends the samples after sample k of the planned motion up to sample `last`.
  void keep_until(std::size_t last, std::size_t k) {
    while (k < last) {
      motion_.append(planned_.trajectory, ++k);
      sample_[k] = motion_.last();
    }
  }

  void replace(const BlendedMoves& blended) {
    motion_.stop();
    std::vector<std::size_t> samples{motion_.last()};
    const Trajectory& trajectory = blended.motion.trajectory;
    for (std::size_t k = 1; k < trajectory.size(); ++k) {
      motion_.append(trajectory, k);
      samples.push_back(motion_.last());
    }
    motion_.stop();
    for (const std::size_t arrival : blended.motion.arrivals) {
      ends_.push_back(samples[arrival]);
    }
    ends_.back() = samples.back();  // verify() may find that the arm is there before
  }

  /// Sets the samples of all moves and what became of their blends.
  void set_moves(const std::vector<BlendedMoves>& motions) {
    for (PlannedMove& move : moves_) {
      move.begin = sample_[move.begin];
      move.end = sample_[move.end];
    }
    std::size_t next = 0;
    for (const BlendedMoves& blended : motions) {
      for (std::size_t i = blended.moves.first; i <= blended.moves.last; ++i) {
        moves_[i].end = ends_[next++];
        if (i > blended.moves.first) moves_[i].begin = moves_[i - 1].end;
      }
      for (std::size_t k = 0; k < blended.blends.size(); ++k) {
        const double radius = blended.motion.radii[k];
        if (radius == 0) continue;
        PlannedMove& move = moves_[blended.blends[k]];
        move.joint_blend_radius = radius;
        if (is_joint_motion(planned_.program.moves[blended.blends[k]].kind)) {
          move.waypoints = {planned_.trajectory.positions[planned_.moves[blended.blends[k]].end]};
        }
        move.blend = radius < blended.largest[k] ? BlendOutcome::smaller : BlendOutcome::full;
      }
    }
  }

  const PlannedProgram& planned_;
  ProgramTrajectory motion_;
  std::vector<PlannedMove> moves_;
  std::vector<std::size_t> sample_;     ///< of each sample of the planned motion that is kept
  std::vector<std::size_t> ends_ = {};  ///< of the moves that are replaced
};

}  // namespace

bool has_joint_blends(const Program& program) {
  for (std::size_t i = 0; i < program.moves.size(); ++i) {
    if (blends_with_joint_move(program, i)) return true;
  }
  return false;
}

void set_stops(const Program& program, std::vector<PlannedMove>& moves) {
  for (std::size_t i = 0; i < moves.size(); ++i) {
    if (blends_with_joint_move(program, i)) moves[i].blend = BlendOutcome::stop;
  }
}

std::vector<BlendedMoves> blended_moves(const PlannedProgram& planned, const CollisionModel* model,
                                        BudgetMeter& budget) {
  std::vector<BlendedMoves> motions;
  std::vector<ProgramScene> scenes;
  if (model != nullptr) {
    std::vector<std::size_t> arrivals;
    for (const PlannedMove& move : planned.moves) arrivals.push_back(move.end);
    scenes = program_scenes(*model, planned.trajectory, planned.program, arrivals);
  }
  const std::size_t count = planned.program.moves.size();
  for (MoveRange moves; moves.first < count && !budget.ended(); moves.first = moves.last + 1) {
    moves.last = moves.first;
    while (is_passed(planned.program, moves.last)) ++moves.last;
    const double begin = planned.trajectory.times[planned.moves[moves.first].begin];
    const auto after =
        std::upper_bound(scenes.begin(), scenes.end(), begin,
                         [](double time, const ProgramScene& scene) { return time < scene.begin; });
    const CollisionModel* const here = after == scenes.begin() ? nullptr : &std::prev(after)->model;
    std::vector<std::optional<ChainPart>> parts = parts_between_stops(planned, moves, budget);
    const auto lines = std::count_if(parts.begin(), parts.end(),
                                     [](const auto& part) { return part && !part->joint; });
    BlendRefusals refusals(static_cast<std::size_t>(lines));
    add_motions(planned, std::move(parts), here, refusals, budget, motions);
  }
  return motions;
}

BlendedProgram with_blends(const PlannedProgram& planned,
                           const std::vector<BlendedMoves>& motions) {
  return Replaced(planned, motions).result();
}

}  // namespace beeline::internal
