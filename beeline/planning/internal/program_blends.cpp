#include <algorithm>

#include <beeline/planning/internal/blend_chain.h>
#include <beeline/planning/internal/program_blends.h>
#include <beeline/planning/internal/program_trajectory.h>

namespace beeline::internal {
namespace {

/// Moves from one stop to the next with their motion, which replaces the planned one.
struct Replacement {
  MoveRange moves;
  BlendedMotion motion;
  std::vector<std::size_t> blends;  ///< moves that blend with joint moves
  std::vector<double> largest;      ///< radii of these blends
};

/// Whether the joints move in a move of the planned motion. They rest at the waypoints of one in
/// which they do not.
bool moves_joints(const PlannedProgram& planned, std::size_t i) {
  constexpr double still = 1e-9;  // radians or metres
  const auto& q = planned.trajectory.positions;
  const PlannedMove& move = planned.moves[i];
  if (!is_joint_motion(planned.program.moves[i].kind)) return move.end > move.begin;
  return (q[move.end] - q[move.begin]).norm() > still;
}

/// The moves from one stop to the next that blend with joint moves.
std::vector<MoveRange> chains_of(const PlannedProgram& planned) {
  std::vector<MoveRange> chains;
  const std::size_t count = planned.program.moves.size();
  for (std::size_t first = 0; first < count; ++first) {
    MoveRange chain{first, first};
    bool joint = false;
    while (is_passed(planned.program, chain.last) && moves_joints(planned, chain.last) &&
           moves_joints(planned, chain.last + 1)) {
      joint = joint || blends_with_joint_move(planned.program, chain.last);
      ++chain.last;
    }
    // Without a start the motion begins at the first waypoint.
    if (joint) chains.push_back(chain);
    first = chain.last;
  }
  return chains;
}

/// The planned motion with other motions of some moves.
class Replaced {
 public:
  Replaced(const PlannedProgram& planned, const std::vector<Replacement>& replacements)
      : planned_(planned), moves_(planned.moves), sample_(planned.trajectory.size()) {
    motion_.begin(planned.arm, planned.trajectory.positions.front(), planned.options.interpolation,
                  planned.options.rate);
    std::size_t k = 0;
    for (const Replacement& replacement : replacements) {
      keep_until(planned.moves[replacement.moves.first].begin, k);
      replace(replacement);
      k = planned.moves[replacement.moves.last].end;
      sample_[k] = motion_.last();
    }
    keep_until(planned.trajectory.size() - 1, k);
    set_moves(replacements);
  }

  BlendedProgram result(const std::vector<Replacement>& replacements) const {
    BlendedProgram program{motion_.finished(), moves_, {}};
    for (PlannedPart part : planned_.planned) {
      const ProgramPart& whole = planned_.parts[part.part];
      const bool replaced =
          std::any_of(replacements.begin(), replacements.end(), [&](const Replacement& one) {
            return one.moves.first <= whole.last && whole.first <= one.moves.last;
          });
      part.begin = sample_[part.begin];
      if (!replaced) program.planned.push_back(std::move(part));
    }
    return program;
  }

 private:
  /// Appends the samples after sample k of the planned motion up to sample `last`.
  void keep_until(std::size_t last, std::size_t k) {
    while (k < last) {
      motion_.append(planned_.trajectory, ++k);
      sample_[k] = motion_.last();
    }
  }

  void replace(const Replacement& replacement) {
    motion_.stop();
    std::vector<std::size_t> samples{motion_.last()};
    const Trajectory& trajectory = replacement.motion.trajectory;
    for (std::size_t k = 1; k < trajectory.size(); ++k) {
      motion_.append(trajectory, k);
      samples.push_back(motion_.last());
    }
    motion_.stop();
    for (const std::size_t arrival : replacement.motion.arrivals) {
      ends_.push_back(samples[arrival]);
    }
    ends_.back() = samples.back();  // verify() may find that the arm is there before
  }

  /// Sets the samples of all moves and what became of their blends.
  void set_moves(const std::vector<Replacement>& replacements) {
    for (PlannedMove& move : moves_) {
      move.begin = sample_[move.begin];
      move.end = sample_[move.end];
    }
    std::size_t next = 0;
    for (const Replacement& replacement : replacements) {
      for (std::size_t i = replacement.moves.first; i <= replacement.moves.last; ++i) {
        moves_[i].end = ends_[next++];
        if (i > replacement.moves.first) moves_[i].begin = moves_[i - 1].end;
      }
      for (std::size_t k = 0; k < replacement.blends.size(); ++k) {
        const double radius = replacement.motion.radii[k];
        if (radius == 0) continue;
        PlannedMove& move = moves_[replacement.blends[k]];
        move.joint_blend_radius = radius;
        if (is_joint_motion(planned_.program.moves[replacement.blends[k]].kind)) {
          move.waypoints = {
              planned_.trajectory.positions[planned_.moves[replacement.blends[k]].end]};
        }
        move.blend = radius < replacement.largest[k] ? BlendOutcome::smaller : BlendOutcome::full;
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

BlendedProgram with_joint_blends(const PlannedProgram& planned, const CollisionModel* model,
                                 BudgetMeter& budget) {
  std::vector<Replacement> replacements;
  std::vector<ProgramScene> scenes;
  if (model != nullptr) {
    std::vector<std::size_t> arrivals;
    for (const PlannedMove& move : planned.moves) arrivals.push_back(move.end);
    scenes = program_scenes(*model, planned.trajectory, planned.program, arrivals);
  }
  for (const MoveRange& moves : chains_of(planned)) {
    if (budget.ended()) break;
    const double begin = planned.trajectory.times[planned.moves[moves.first].begin];
    const auto after =
        std::upper_bound(scenes.begin(), scenes.end(), begin,
                         [](double time, const ProgramScene& scene) { return time < scene.begin; });
    const CollisionModel* const here = after == scenes.begin() ? nullptr : &std::prev(after)->model;
    BlendChain chain(planned, moves, here, budget);
    std::optional<BlendedMotion> motion = chain.motion();
    if (!motion) continue;
    replacements.push_back({moves, std::move(*motion), chain.blends(), chain.largest()});
  }
  return Replaced(planned, replacements).result(replacements);
}

}  // namespace beeline::internal
