#include <algorithm>

#include <beeline/planning/internal/blended_moves.h>
#include <beeline/planning/internal/motion_request.h>
#include <beeline/timing/internal/blended_path.h>

namespace beeline::internal {
namespace {

constexpr double branch_tolerance = 0.9;  // of the tolerance, as move_along() plans
constexpr int max_attempts = 32;

/// The moves of a program from one to another, without what is attached.
Program moves_between(const Program& program, std::size_t first, std::size_t last) {
  Program part;
  part.moves.assign(program.moves.begin() + static_cast<std::ptrdiff_t>(first),
                    program.moves.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  return part;
}

}  // namespace

/// A motion with some blends, sampled.
struct BlendedMoves::Attempt {
  Trajectory trajectory = {};
  std::vector<std::size_t> begins = {}, ends = {};  ///< of each piece; valid where it stops
  std::vector<SampleRange> blends = {};             ///< after each piece but the last
  std::vector<PathSamples> paths = {};
  Verification found = {};
  std::size_t failed = 0;  ///< piece without a motion within limits, for a reason
  Reason reason = {};
};

BlendedMoves::BlendedMoves(const Arm& arm, const Program& program,
                           const std::vector<ProgramPart>& parts, const PathMotionOptions& options,
                           BudgetMeter& budget)
    : arm_(arm), program_(program), parts_(parts), options_(options), budget_(budget) {}

void BlendedMoves::add(std::vector<MovePiece> pieces) {
  for (MovePiece& piece : pieces) {
    if (!pieces_.empty()) {
      const MovePiece& before = pieces_.back();
      const bool blends = before.part != piece.part && blends_after(program_, parts_, before.part);
      blends_.push_back(blends
                            ? largest_piece_blend(arm_, *options_.task,
                                                  program_.moves[before.last_move], before, piece)
                            : PieceBlend{});
    }
    pieces_.push_back(std::move(piece));
  }
}

void BlendedMoves::add_joint_motion(std::size_t part, const Configuration& from,
                                    const Configuration& to) {
  if (pieces_.empty()) start_ = from;
  const double speed = program_.moves[parts_[part].first].speed.value_or(options_.tool_speed);
  add({joint_piece(parts_[part], part, from, to, speed)});
}

bool BlendedMoves::add_path(std::size_t part, const PathMotion& motion) {
  const auto& q = motion.trajectory.positions;
  if (pieces_.empty()) start_ = q.front();
  requests_.push_back({arm_, q.front(), parts_[part].route,
                       branch_options(arm_, options_, branch_tolerance), timing_options(options_),
                       proof_options(options_)});
  std::vector<MovePiece> pieces =
      path_pieces(requests_.back(), parts_[part], part, motion, budget_);
  if (pieces.empty()) return false;
  add(std::move(pieces));
  return true;
}

bool BlendedMoves::has_blends() const {
  return std::any_of(blends_.begin(), blends_.end(),
                     [](const PieceBlend& blend) { return !blend.stops(); });
}

void BlendedMoves::reduce(std::size_t boundary, const Reason& reason) {
  blends_[boundary] = halved(blends_[boundary], pieces_[boundary], pieces_[boundary + 1], reason);
}

/// Reduces the blends beside a piece or, if there are none, all. Returns whether there are some.
bool BlendedMoves::reduce_beside(std::size_t piece, const Reason& reason) {
  if (!has_blends()) return false;
  const auto blends = [&](std::size_t k) { return k < blends_.size() && !blends_[k].stops(); };
  const bool before = piece > 0 && blends(piece - 1), after = blends(piece);
  for (std::size_t k = 0; k < blends_.size(); ++k) {
    const bool beside = (before && k + 1 == piece) || (after && k == piece);
    if (blends(k) && (beside || (!before && !after))) reduce(k, reason);
  }
  return true;
}

/// The motion with the present blends, not verified.
BlendedMoves::Attempt BlendedMoves::timed() const {
  Attempt attempt;
  ProgramTrajectory trajectory;
  trajectory.begin(arm_, start_, options_.interpolation, options_.rate);
  attempt.begins.resize(pieces_.size());
  attempt.ends.resize(pieces_.size());
  attempt.blends.resize(blends_.size());
  for (std::size_t first = 0; first < pieces_.size();) {
    std::size_t last = first;
    while (last < blends_.size() && !blends_[last].stops()) ++last;
    attempt.begins[first] = trajectory.last();
    const PieceRun run(arm_, parts_, pieces_, blends_, first, last, options_, budget_);
    RunSamples samples = run.append_to(trajectory);
    attempt.reason = std::move(samples.reason);
    attempt.failed = first;
    if (attempt.reason || !budget_.complete()) return attempt;
    std::copy(samples.blends.begin(), samples.blends.end(),
              attempt.blends.begin() + static_cast<std::ptrdiff_t>(first));
    std::move(samples.paths.begin(), samples.paths.end(), std::back_inserter(attempt.paths));
    trajectory.stop();
    attempt.ends[last] = trajectory.last();
    trajectory.dwell(program_.moves[pieces_[last].last_move].dwell);
    first = last + 1;
  }
  attempt.trajectory = trajectory.finished();
  return attempt;
}

/// Verifies an attempt as a program; if it is not verified, reduces blends and returns false.
bool BlendedMoves::verified(Attempt& attempt) {
  VerifyOptions options = proof_options(options_);
  options.budget = budget_.part();
  const std::size_t first = first_move();
  attempt.found = verify(arm_, attempt.trajectory,
                         moves_between(program_, first, pieces_.back().last_move), options);
  if (attempt.found) return true;
  const std::vector<std::size_t>& arrivals = attempt.found.arrivals;
  const auto passed = std::upper_bound(arrivals.begin(), arrivals.end(), attempt.found.sample);
  const std::size_t move =
      first + static_cast<std::size_t>(std::distance(arrivals.begin(), passed));
  std::size_t piece = 0;
  while (piece + 1 < pieces_.size() && pieces_[piece].last_move < move) ++piece;
  reduce_beside(piece, attempt.found.reason);
  return false;
}

/// Proves the clearance of the blends; if one is not proved, reduces it and returns false.
bool BlendedMoves::clear(const CurrentScene* given, const Attempt& attempt) {
  if (given == nullptr) return true;
  CurrentScene scene = *given;
  bool all = true;
  for (std::size_t k = 0; k < blends_.size(); ++k) {
    if (blends_[k].stops()) {
      scene.arrive(pieces_[k].last_move + 1, attempt.trajectory.positions[attempt.ends[k]]);
      continue;
    }
    const auto [first, last] = attempt.blends[k];
    const Reason reason =
        prove_clearance(scene.model(), samples_between(attempt.trajectory, first, last),
                        {.budget = budget_.part()})
            .reason;
    if (!reason) continue;
    reduce(k, reason);
    all = false;
  }
  return all;
}

/// The motion with the present blends, or with smaller ones where it is not possible.
BlendedMotion BlendedMoves::attempted(const CurrentScene* scene) {
  for (int i = 0; i < max_attempts && has_blends() && !budget_.ended(); ++i) {
    Attempt attempt = timed();
    if (!budget_.complete()) break;
    if (attempt.reason) {
      reduce_beside(attempt.failed, attempt.reason);
      continue;
    }
    if (verified(attempt) && clear(scene, attempt)) return finished(std::move(attempt));
  }
  return {};
}

BlendedMotion BlendedMoves::finished(Attempt attempt) const {
  BlendedMotion motion;
  const std::vector<PassedWaypoint>& passed = attempt.found.passed;
  const std::size_t first = first_move();
  motion.blends.resize(pieces_.back().last_move - first + 1);
  motion.ends = attempt.found.arrivals;
  motion.begins.assign(motion.ends.size(), 0);
  for (std::size_t m = 1; m < motion.ends.size(); ++m) motion.begins[m] = motion.ends[m - 1];
  for (std::size_t k = 0; k < pieces_.size(); ++k) {
    const std::size_t move = pieces_[k].last_move - first;
    if (k == blends_.size() || blends_[k].stops()) {
      motion.ends[move] = attempt.ends[k];
      if (k < blends_.size()) motion.begins[move + 1] = attempt.begins[k + 1];
    }
    if (k == blends_.size() || !blends_[k].asked_for) continue;
    PlannedBlend& blend = motion.blends[move];
    blend.radius = blends_[k].radius();
    blend.reason = blends_[k].reason;
    const auto zone = std::find_if(passed.begin(), passed.end(),
                                   [&](const PassedWaypoint& one) { return one.move == move; });
    if (blends_[k].stops() || zone == passed.end()) continue;
    blend.begin = attempt.blends[k].first;
    blend.end = attempt.blends[k].last;
    blend.bound = zone->bound;
    blend.q = pieces_[k].path.q.back();
  }
  motion.paths = std::move(attempt.paths);
  motion.trajectory = std::move(attempt.trajectory);
  return motion;
}

std::vector<std::pair<std::size_t, Reason>> BlendedMoves::reasons() const {
  std::vector<std::pair<std::size_t, Reason>> reasons;
  for (std::size_t k = 0; k < blends_.size(); ++k) {
    if (blends_[k].reason) reasons.emplace_back(pieces_[k].last_move, blends_[k].reason);
  }
  return reasons;
}

/// Replaces a blend by a stop, as it is quicker.
void BlendedMoves::stop_at(PieceBlend& blend) {
  blend.reason = {ReasonCode::blend_slower, {{ReasonField::radius, blend.radius()}}};
  blend.before = blend.after = 0;
}

/// Stops at small blends with which two pieces from rest to rest take longer.
void BlendedMoves::stop_where_quicker() {
  const auto duration = [&](std::size_t first, std::size_t last) {
    return PieceRun(arm_, parts_, pieces_, blends_, first, last, options_, budget_)
        .shortest_duration();
  };
  for (std::size_t k = 0; k < blends_.size() && !budget_.ended(); ++k) {
    if (blends_[k].stops() || blends_[k].radius() >= small_blend) continue;
    if (duration(k, k) + duration(k + 1, k + 1) < duration(k, k + 1)) stop_at(blends_[k]);
  }
}

BlendedMotion BlendedMoves::plan(const CurrentScene* scene) {
  if (!has_blends()) return {};
  stop_where_quicker();
  BlendedMotion motion = attempted(scene);
  if (!motion || !budget_.complete()) return {};
  return motion;
}

}  // namespace beeline::internal
