#pragma once

#include <optional>
#include <vector>

#include <beeline/planning/internal/planned_lines.h>
#include <beeline/planning/internal/program_refusal.h>
#include <beeline/timing/internal/blended_path.h>

namespace beeline::internal {

/// A motion of the moves of a chain, from rest to rest.
struct BlendedMotion {
  Trajectory trajectory;
  std::vector<std::size_t> arrivals;  ///< the sample at which each move ends
  std::vector<double> radii;          ///< of the blends with joint moves, in order; 0: a stop
  Fault fault = Fault::none;          ///< of verify()
};

/// The moves of a program from one stop to the next, of which some blend with joint moves. The
/// program is planned with stops before: that motion has the configurations at the waypoints, and
/// along the lines. With a model of the arm in its scene, the motion keeps its clearance.
class BlendChain {
 public:
  /// All arguments must outlive the object.
  BlendChain(const PlannedProgram& planned, const MoveRange& moves, const CollisionModel* model,
             BudgetMeter& budget);

  /// The moves that blend with joint moves.
  const std::vector<std::size_t>& blends() const { return blends_; }

  /// The radii of the largest blends.
  const std::vector<double>& largest() const { return largest_; }

  /// Returns a motion that is proved by verify() with blends as large as possible, and quicker than
  /// the motion with stops. None if there is none, or the budget ends.
  std::optional<BlendedMotion> motion();

 private:
  /// A joint path of one joint move, or along lines from a joint move or stop to the next.
  struct Piece {
    MoveRange moves;
    LimitedPath limited = {};
    // Of lines: the first and last one, and the parts of the joint path along them.
    std::optional<Line> begin = std::nullopt, end = std::nullopt;
    double begin_length = 0, end_length = 0;
  };

  bool add_piece(const MoveRange& moves);
  bool add_path(Piece& piece) const;
  bool fits(std::size_t corner, double radius) const;
  double largest_radius(std::size_t corner) const;
  std::vector<double> smaller_at_changes(double part) const;
  std::optional<BlendedMotion> proved(std::vector<double> radii);
  Reason timed(const std::vector<double>& radii, BlendedMotion& motion);
  std::optional<std::size_t> faulty_move(BlendedMotion& motion);
  void make_smaller(const std::optional<std::size_t>& move, std::vector<double>& radii) const;
  void add_grid_points();

  const PlannedProgram& planned_;
  MoveRange moves_;
  const CollisionModel* model_;
  BudgetMeter& budget_;
  Program program_;  ///< of the moves of the chain
  std::vector<Piece> pieces_ = {};
  std::vector<std::size_t> blends_ = {};  ///< the last move of each piece but the last
  std::vector<double> largest_ = {};
};

}  // namespace beeline::internal
