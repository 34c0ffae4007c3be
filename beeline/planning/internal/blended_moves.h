#pragma once

#include <deque>
#include <optional>
#include <vector>

#include <beeline/certificate/verify.h>
#include <beeline/planning/internal/current_scene.h>
#include <beeline/planning/internal/piece_run.h>
#include <beeline/planning/internal/program_trajectory.h>

namespace beeline::internal {

/// The motion of some moves, verified. Empty if there is none.
struct BlendedMotion {
  Trajectory trajectory = {};
  std::vector<std::size_t> ends = {};     ///< sample at which each of the moves ends
  std::vector<std::size_t> begins = {};   ///< sample at which each move begins
  std::vector<PlannedBlend> blends = {};  ///< of each move
  std::vector<PathSamples> paths = {};

  explicit operator bool() const { return trajectory.size() > 0; }
  double duration() const { return trajectory.duration(); }
};

/// Consecutive parts of a program, joint motions and paths, each of which blends into the next. It
/// is timed from stop to stop, and verified as a program of its own.
class BlendedMoves {
 public:
  /// Keeps references to all arguments.
  BlendedMoves(const Arm& arm, const Program& program, const std::vector<ProgramPart>& parts,
               const PathMotionOptions& options, BudgetMeter& budget);

  /// Adds the next part: a straight joint motion.
  void add_joint_motion(std::size_t part, const Configuration& from, const Configuration& to);

  /// Adds the next part: a path whose motion is sampled without a rate. Returns whether the moves
  /// can be timed.
  bool add_path(std::size_t part, const PathMotion& motion);

  /// Plans the motion with the largest blends for which it is verified and, in a scene, clear where
  /// it blends. Where a stop is quicker than a small blend, the arm stops. No motion where no blend
  /// is possible.
  BlendedMotion plan(const CurrentScene* scene);

  /// Why blends are smaller than asked for, or stops: the move before each, with its reason.
  std::vector<std::pair<std::size_t, Reason>> reasons() const;

 private:
  struct Attempt;

  void add(std::vector<MovePiece> pieces);

  std::size_t first_move() const { return parts_[pieces_.front().part].first; }
  bool has_blends() const;
  static void stop_at(PieceBlend& blend);
  void stop_where_quicker();
  void reduce(std::size_t boundary, const Reason& reason);
  bool reduce_beside(std::size_t piece, const Reason& reason);
  Attempt timed() const;
  bool verified(Attempt& attempt);
  bool clear(const CurrentScene* scene, const Attempt& attempt);
  BlendedMotion attempted(const CurrentScene* scene);
  BlendedMotion finished(Attempt attempt) const;

  const Arm& arm_;
  const Program& program_;
  const std::vector<ProgramPart>& parts_;
  const PathMotionOptions& options_;
  BudgetMeter& budget_;
  std::deque<MotionRequest> requests_ = {};
  Configuration start_ = {};
  std::vector<MovePiece> pieces_ = {};
  std::vector<PieceBlend> blends_ = {};  ///< after each piece but the last
};

}  // namespace beeline::internal
