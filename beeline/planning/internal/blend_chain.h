#pragma once

#include <optional>
#include <vector>

#include <beeline/planning/internal/blend_refusals.h>
#include <beeline/planning/internal/chain_part.h>
#include <beeline/planning/internal/program_refusal.h>

namespace beeline::internal {

/// A motion of the moves of a chain, from rest to rest.
struct BlendedMotion {
  Trajectory trajectory;
  std::vector<std::size_t> arrivals;  ///< the sample at which each move ends
  std::vector<double> radii;          ///< of the blends between the parts, in order; 0: a stop
};

/// The moves of a program from one stop to the next, whose parts blend with each other: at least
/// one of two neighbours is a joint move. The program is planned with stops before: that motion has
/// the configurations at the waypoints, and along the lines. With a model of the arm in its scene,
/// the motion keeps its clearance.
class BlendChain {
 public:
  /// `largest` are the radii of the largest blends between the parts, above 0. `refusals` counts
  /// the refusals of all chains of a search; each chain is tried once, whatever their number. All
  /// other arguments must outlive the object.
  BlendChain(const PlannedProgram& planned, std::vector<ChainPart> parts,
             std::vector<double> largest, const CollisionModel* model, BlendRefusals& refusals,
             BudgetMeter& budget);

  MoveRange moves() const { return {parts_.front().moves.first, parts_.back().moves.last}; }
  const std::vector<ChainPart>& parts() const { return parts_; }
  const std::vector<double>& largest() const { return largest_; }

  /// Returns a motion that is proved by verify() with blends as large as possible, and quicker than
  /// the motion with stops. None if there is none, or the budget ends.
  std::optional<BlendedMotion> motion();

  /// The part whose motion from stop to stop was refused, if one was: no blend helps.
  std::optional<std::size_t> refused_part() const { return refused_part_; }

 private:
  /// Why a motion is refused.
  struct Refusal {
    std::vector<std::size_t> blends = {};  ///< that may be the cause, in order
    std::size_t part = 0;                  ///< the first part that is not proved
    bool deviates = false;                 ///< whether a line of this part is not followed
  };

  std::vector<double> smaller_at_changes(double fraction) const;
  std::optional<BlendedMotion> proved(std::vector<double> radii);
  std::optional<Refusal> refusal(const std::vector<double>& radii, BlendedMotion& motion);
  std::optional<Refusal> timed(const std::vector<double>& radii, BlendedMotion& motion);
  Refusal refusal_of_section(const std::vector<double>& radii, std::size_t section) const;
  Refusal refusal_outside_limits(const std::vector<double>& radii,
                                 const Trajectory& trajectory) const;
  Refusal refusal_at(const BlendedMotion& motion, std::size_t move, std::size_t sample,
                     bool of_whole_move) const;
  bool make_smaller(const Refusal& refusal, std::vector<double>& radii);
  bool add_samples(const Refusal& refusal);

  const PlannedProgram& planned_;
  std::vector<ChainPart> parts_;
  std::vector<double> largest_;
  const CollisionModel* model_;
  BlendRefusals& refusals_;
  BudgetMeter& budget_;
  Program program_ = {};              ///< of the moves of the chain
  std::vector<double> allowed_ = {};  ///< the radius of each blend that is not refused so far
  std::vector<int> refused_ = {};     ///< how often each blend was
  std::vector<int> additions_ = {};   ///< of grid points to each part
  std::optional<std::size_t> refused_part_ = std::nullopt;
  bool tried_ = false;
};

}  // namespace beeline::internal
